#include "screen_drops/evaluations.h"

#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "pass/display.h"
#include "pass/model.h"
#include "rainref/error.h"
#include "screen_drops/cells.h"
#include "screen_drops/flow_info.h"
#include "screen_drops/plain.h"

namespace rainref::screen_drops {
namespace {

using capture::PassCase;
using capture::PassModel;

const capture::Array& output_of(const PassCase& c, const char* name) {
  const capture::CaseOutput* out = c.output(name);
  if (out == nullptr) throw Error(ExitCode::port_files, fmt::format("{}: expected an output {}", c.folder(), name));
  return out->array;
}
// ---- cells -----------------------------------------------------------------------------------------------------------
struct Cells {
  int width, height, values = 4;
  CellsUniforms uniforms;

  template <class N>
  void operator()(int x, int y, N* out) const {
    const CellState s = CellLine(uniforms, y).at(x);
    const auto share = [](std::uint32_t of_65536) { return N(static_cast<float>(of_65536) * 0x1p-16f); };
    const N none(0.0f);
    const auto d = s.holds_drop ? scalar::cell_drop<N>(uniforms, share(s.size), share(s.x), share(s.y), share(s.phase))
                                : scalar::CellDrop<N>{none, none, none, none};
    out[0] = d.x;
    out[1] = d.y;
    out[2] = d.radius;
    out[3] = d.phase;
  }
};
std::unique_ptr<PassModel> bind_cells(const PassCase& c) {
  Cells m;
  m.width = output_of(c, "cells").width;
  m.height = output_of(c, "cells").height;
  m.uniforms = capture::uniforms_of<CellsUniforms>(c);
  if (m.uniforms.shortest == 0)
    throw Error(ExitCode::port_files, fmt::format("{}: shortest: expected a cycle of 1 ms or more, found 0", c.folder()));
  return capture::model_of(std::move(m));
}

std::unique_ptr<PassModel> bind_drops(const PassCase& c) {
  return c.corrected() ? pass::bind<DropsPass, scalar::DropsPassText>(c)
                       : pass::bind<PublishedDropsPass, scalar::PublishedDropsPassText>(c);
}

}  // namespace

const std::vector<capture::PassEvaluations>& evaluations() {
  static const std::vector<capture::PassEvaluations> all = [] {
    std::vector<capture::PassEvaluations> passes = flow_evaluations();
    for (const capture::PassEvaluations& own :
         {capture::PassEvaluations{"background", pass::bind<BackgroundPass, scalar::BackgroundPassText>},
          {"cells", bind_cells},
          {"drops", bind_drops},
          {"display", pass::bind_display}})
      passes.push_back(own);
    return passes;
  }();
  return all;
}

}  // namespace rainref::screen_drops
