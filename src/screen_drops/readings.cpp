#include "screen_drops/readings.h"

#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "capture/display.h"
#include "rainref/error.h"
#include "screen_drops/cells.h"
#include "screen_drops/flow_info.h"
#include "screen_drops/plain.h"

namespace rainref::screen_drops {
namespace {

using capture::BoundTexture;
using capture::PassCase;
using capture::PassModel;

/// An input image of these channels, of this size unless width is 0.
BoundTexture image_of(const PassCase& c, const char* name, int channels, int width = 0, int height = 0) {
  const capture::CaseInput& input = capture::image_input(c, name);
  const capture::Array& a = input.array;
  if (info(a.format).channels == channels && (width == 0 || (a.width == width && a.height == height))) return BoundTexture(input);
  throw Error(ExitCode::port_files, fmt::format("{}: in.{}: expected {} channels{}, found {} {}x{}", c.folder(), name, channels, width == 0 ? "" : fmt::format(" of {}x{}", width, height),
                                                info(a.format).name, a.width, a.height));
}
const capture::Array& output_of(const PassCase& c, const char* name) {
  const capture::CaseOutput* out = c.output(name);
  if (out == nullptr) throw Error(ExitCode::port_files, fmt::format("{}: expected an output {}", c.folder(), name));
  return out->array;
}
template <class N>
plain::Vec3<N> colour_at(const BoundTexture& image, int x, int y) {
  const Texture t = image.view();
  const float* in = t.texels + 4 * (static_cast<std::ptrdiff_t>(y) * t.width[0] + x);
  return plain::Vec3<N>(N::load(in), N::load(in + 1), N::load(in + 2));
}
template <class N>
void put(const plain::Vec3<N>& colour, N* out) {
  out[0] = colour.x;
  out[1] = colour.y;
  out[2] = colour.z;
  out[3] = N(1.0f);
}

// ---- background ------------------------------------------------------------------------------------------------------
struct Background {
  int width, height, values = 4;
  bool corrected;
  BackgroundUniforms uniforms;
  BoundTexture scene;
  std::vector<Tap> taps;

  template <class N>
  void operator()(int x, int y, N* out) const {
    put(corrected ? scalar::background_corrected<N>(uniforms, scene.view(), taps.data(), x, y) : scalar::background_as_published<N>(uniforms, scene.view(), x, y), out);
  }
};
std::unique_ptr<PassModel> bind_background(const PassCase& c) {
  Background m;
  m.width = output_of(c, "background").width;
  m.height = output_of(c, "background").height;
  m.corrected = c.corrected();
  m.uniforms = capture::uniforms_of<BackgroundUniforms>(c);
  m.scene = image_of(c, "scene", 4);
  if (m.corrected) {
    m.taps = capture::records_of<Tap>(capture::record_input(c, "taps"));
    if (m.uniforms.tap_count < 0 || static_cast<std::size_t>(m.uniforms.tap_count) > m.taps.size()) {
      throw Error(ExitCode::port_files, fmt::format("{}: tap_count: expected at most {}, as many as in.taps has, found {}", c.folder(), m.taps.size(), m.uniforms.tap_count));
    }
  }
  return capture::model_of(std::move(m));
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
    const auto d = s.holds_drop ? scalar::cell_drop<N>(uniforms, share(s.size), share(s.x), share(s.y), share(s.phase)) : scalar::CellDrop<N>{none, none, none, none};
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
  if (m.uniforms.shortest == 0) throw Error(ExitCode::port_files, fmt::format("{}: shortest: expected a cycle of 1 ms or more, found 0", c.folder()));
  return capture::model_of(std::move(m));
}

// ---- drops -----------------------------------------------------------------------------------------------------------
struct Drops {
  int width, height, values = 5;
  bool corrected;
  PublishedDropsUniforms published;
  DropsUniforms uniforms;
  BoundTexture background, scene, noise, cells, flow;

  template <class N>
  void operator()(int x, int y, N* out) const {
    const plain::Vec3<N> below = colour_at<N>(background, x, y);
    const auto w = corrected ? scalar::drops_corrected<N>(uniforms, scene.view(), cells.view(), flow.view(), below, x, y)
                             : scalar::drops_as_published<N>(published, scene.view(), noise.view(), below, x, y);
    out[0] = w.water;
    put(w.colour, out + 1);
  }
};
std::unique_ptr<PassModel> bind_drops(const PassCase& c) {
  Drops m;
  const capture::Array& background = capture::image_input(c, "background").array;
  m.width = background.width;
  m.height = background.height;
  m.corrected = c.corrected();
  m.background = image_of(c, "background", 4);
  m.scene = image_of(c, "scene", 4);
  if (m.corrected) {
    m.uniforms = capture::uniforms_of<DropsUniforms>(c);
    m.cells = image_of(c, "cells", 4);
    m.flow = image_of(c, "height", 1);
  } else {
    m.published = capture::uniforms_of<PublishedDropsUniforms>(c);
    m.noise = image_of(c, "noise", 4);
  }
  return capture::model_of(std::move(m));
}

}  // namespace

const std::vector<capture::PassReadings>& readings() {
  static const std::vector<capture::PassReadings> all = [] {
    std::vector<capture::PassReadings> passes = flow_readings();
    for (const capture::PassReadings& own : {capture::PassReadings{"background", bind_background}, {"cells", bind_cells}, {"drops", bind_drops}, {"display", capture::bind_display}}) passes.push_back(own);
    return passes;
  }();
  return all;
}

}  // namespace rainref::screen_drops
