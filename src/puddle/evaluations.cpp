#include "puddle/evaluations.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "pass/model.h"
#include "puddle/bounds.h"
#include "puddle/every_evaluation.h"
#include "puddle/kernels.h"
#include "puddle/rainfall.h"
#include "rainref/error.h"

namespace rainref::puddle {
namespace {

using capture::BoundTexture;
using capture::PassCase;
using capture::PassModel;

Boundary boundary_of(Address address) {
  return address == Address::repeat ? Boundary::periodic : address == Address::border ? Boundary::fixed : Boundary::reflecting;
}

// ---- wave_step -----------------------------------------------------------------------------------------------------
/// One channel of the wave with its ghosts, as the kernel has it.
Image plane_of(const capture::CaseInput& wave, int channel, Format format, Boundary boundary, float rest) {
  const capture::Array& a = wave.array;
  const std::vector<float> all = capture::decoded(a);
  const int channels = info(a.format).channels;
  std::vector<float> one(static_cast<std::size_t>(a.width) * a.height);
  for (std::size_t i = 0; i < one.size(); ++i) one[i] = all[i * static_cast<std::size_t>(channels) + static_cast<std::size_t>(channel)];
  Image plane(format, a.width, a.height);
  encode_rows(one.data(), plane, boundary, rest, Rounding::rne);  // exact: these values were stored like this
  return plane;
}

template <class Storage>
struct WaveStep {
  int width, height, values;
  WaveStepUniforms uniforms;
  bool corrected;
  Boundary boundary;
  Image newest, previous, rest_row;
  BoundTexture shore;
  bool has_shore;
  std::vector<Drop> drops;

  const Storage* row(const Image& plane, int y) const {
    if (y >= 0 && y < height) return plane.row<Storage>(y);
    if (boundary == Boundary::fixed) return rest_row.row<Storage>(0);
    return plane.row<Storage>(boundary == Boundary::periodic ? (y % height + height) % height : std::clamp(y, 0, height - 1));
  }
  template <class N>
  void operator()(int x, int y, N* out) const {
    every::WaveRows<Storage> rows;
    const int reach = corrected ? 1 : static_cast<int>(uniforms.step);
    rows.reach = reach;
    rows.fraction = corrected ? 0.0f : uniforms.step - static_cast<float>(reach);
    rows.here = row(newest, y);
    rows.below = row(newest, y - reach);
    rows.above = row(newest, y + reach);
    rows.below_next = row(newest, y - reach - 1);
    rows.above_next = row(newest, y + reach + 1);
    rows.previous = row(previous, y);
    rows.shore = has_shore ? shore.view().texels + static_cast<std::ptrdiff_t>(y) * width : nullptr;
    // Drops that surely add nothing here are left out, as the kernel does.
    std::vector<Drop> near;
    const float cx = static_cast<float>(x) + 0.5f, cy = static_cast<float>(y) + 0.5f;
    for (const Drop& d : drops) {
      const float reach_of_drop = (corrected ? d.radius : 4.0f) + 1.5f;
      if (std::abs(d.x - cx) < reach_of_drop && std::abs(d.y - cy) < reach_of_drop) near.push_back(d);
    }
    const int count = static_cast<int>(near.size());
    for (int c = 2; c < values; ++c) out[c] = N(0.0f);
    if (corrected) {
      out[0] = every::wave_step_corrected<N>(uniforms, rows, near.data(), count, x, y);
      out[1] = count == 0 ? N::load(rows.here + x) : every::wave_previous_corrected<N>(rows.here, rows.shore, near.data(), count, x, y);
    } else {
      out[0] = every::wave_step_as_published<N>(uniforms, rows, near.data(), count, x, y);
      out[1] = N::load(rows.here + x);
    }
  }
};

template <class Storage>
std::unique_ptr<PassModel> bind_wave_of(const PassCase& c, Format plane_format) {
  const capture::CaseInput& wave = capture::image_input(c, "wave");
  WaveStep<Storage> m;
  m.width = wave.array.width;
  m.height = wave.array.height;
  m.values = info(wave.array.format).channels;
  m.uniforms = capture::uniforms_of<WaveStepUniforms>(c);
  m.corrected = c.corrected();
  m.boundary = boundary_of(wave.address_u);
  m.newest = plane_of(wave, 0, plane_format, m.boundary, m.uniforms.rest);
  m.previous = plane_of(wave, 1, plane_format, m.boundary, m.uniforms.rest);
  m.rest_row = Image(plane_format, m.width, 1);
  encode_rows(std::vector<float>(static_cast<std::size_t>(m.width), m.uniforms.rest).data(), m.rest_row, m.boundary, m.uniforms.rest,
              Rounding::rne);
  m.has_shore = c.input("shore") != nullptr;
  if (m.has_shore) m.shore = BoundTexture(capture::image_input(c, "shore"));
  m.drops = capture::records_of<Drop>(capture::record_input(c, "drops"));
  return capture::model_of(std::move(m));
}
std::unique_ptr<PassModel> bind_wave_step(const PassCase& c) {
  switch (info(capture::image_input(c, "wave").array.format).kind) {
    case FormatInfo::float16:
      return bind_wave_of<Half>(c, Format::r16f);
    case FormatInfo::float32:
      return bind_wave_of<float>(c, Format::r32f);
    default:
      return bind_wave_of<Unorm8>(c, Format::r8);
  }
}

// ---- shade ---------------------------------------------------------------------------------------------------------
std::unique_ptr<PassModel> bind_shade(const PassCase& c) {
  auto m = pass::bound<ShadePass, every::ShadePassText>(c);
  const Texture& around = m.captured.environment.texture;
  if (m.uniforms.environment_is_cube != 0 && around.height[0] != 6 * around.width[0]) {
    throw Error(ExitCode::port_files,
                fmt::format("{}: uniform environment_is_cube is {}, but in.environment is {}x{}: six faces below each other were expected",
                            c.folder(), m.uniforms.environment_is_cube, around.width[0], around.height[0]));
  }
  return capture::model_of(std::move(m));
}

// ---- raindrops, corrected --------------------------------------------------------------------------------------------
std::vector<capture::Array> recompute_raindrops(const PassCase& c) {
  std::vector<std::uint32_t> thresholds;
  for (const CountThreshold& t : capture::records_of<CountThreshold>(capture::record_input(c, "count_thresholds")))
    thresholds.push_back(t.threshold);
  const std::vector<Drop> craters = capture::records_of<Drop>(capture::record_input(c, "craters"));
  const std::vector<Drop> drops = drops_of(capture::uniforms_of<RainfallUniforms>(c), craters, thresholds);
  capture::Array out = c.outputs.front().array;
  out.width = static_cast<int>(drops.size());
  const auto bytes = std::as_bytes(std::span(drops));
  out.levels = {{bytes.begin(), bytes.end()}};
  return {out};
}

}  // namespace

const std::vector<capture::PassEvaluations>& evaluations() {
  static const std::vector<capture::PassEvaluations> all{{"raindrops", nullptr, recompute_raindrops},
                                                         {"wave_step", bind_wave_step},
                                                         {"surface_hit", bind_surface_hit, nullptr, doubt_bounds},
                                                         {"shade", bind_shade},
                                                         {"display", pass::bind<DisplayPass, every::DisplayPassText>}};
  return all;
}

}  // namespace rainref::puddle
