#include "puddle/info.h"

#include <span>

#include "capture/bound_texture.h"
#include "capture/other_angles_model.h"
#include "pass/model.h"
#include "puddle/bounds.h"
#include "puddle/scalar.h"
#include "puddle/rainfall.h"

namespace rainref::puddle {
namespace {

using capture::PassCase;

// ---- raindrops, corrected --------------------------------------------------------------------------------------------
std::vector<capture::Array> recompute_raindrops(const PassCase& c) {
  std::vector<std::uint32_t> thresholds;
  for (const CountThreshold& t : capture::records_of<CountThreshold>(capture::record_input(c, "count_thresholds")))
    thresholds.push_back(t.threshold);
  const std::vector<Drop> craters = capture::records_of<Drop>(capture::record_input(c, "craters"));
  const std::vector<ShelterCell> shelter = capture::records_of<ShelterCell>(capture::record_input(c, "shelter"));
  const std::vector<Drop> objects = capture::records_of<Drop>(capture::record_input(c, "objects"));
  const std::vector<Drop> drops = drops_of(capture::uniforms_of<RainfallUniforms>(c), {craters, thresholds, shelter, objects});
  capture::Array out = c.outputs.front().array;
  out.width = static_cast<int>(drops.size());
  const auto bytes = std::as_bytes(std::span(drops));
  out.levels = {{bytes.begin(), bytes.end()}};
  return {out};
}

}  // namespace

const std::vector<capture::PassEvaluations>& evaluations() {
  static const std::vector<capture::PassEvaluations> all{
      {"raindrops", bind_raindrops, recompute_raindrops},
      {"wave_step", pass::bind<WaveStepPass, scalar::WaveStepPassText>},
      {"surface_hit", bind_surface_hit, nullptr, doubt_bounds, {}, {"bounds", "surface_top", "surface_slope"}},
      {"shade",
       pass::bind<ShadePass, scalar::ShadePassText>,
       nullptr,
       nullptr,
       {capture::by_other_angles<pass::bind<ShadePass, scalar::ShadePassText>>()}},
      {"display", pass::bind<DisplayPass, scalar::DisplayPassText>}};
  return all;
}

}  // namespace rainref::puddle
