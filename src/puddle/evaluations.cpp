#include "puddle/info.h"

#include <span>

#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "capture/other_angles_model.h"
#include "pass/model.h"
#include "puddle/bounds.h"
#include "puddle/rainfall.h"
#include "puddle/scalar.h"
#include "rainref/error.h"
#include "random/draws.h"

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
  const std::vector<Drop> drops =
      drops_of<random::PerturbedWords>(capture::uniforms_of<RainfallUniforms>(c), {craters, thresholds, shelter, objects});
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
      {"ground_noise", pass::bind<GroundNoisePass, scalar::GroundNoisePassText>},
      {"shade",
       pass::bind<ShadePass, scalar::ShadePassText>,
       nullptr,
       nullptr,
       {capture::by_other_angles<pass::bind<ShadePass, scalar::ShadePassText>>()}},
      {"display", pass::bind<DisplayPass, scalar::DisplayPassText>}};
  return all;
}

namespace {

struct DropByDrop {
  RaindropsUniforms uniforms;
  int width = uniforms.drop_count, height = 1, values = 4;

  template <class N>
  void operator()(int i, int, N* out) const {
    const scalar::Vec3<N> drop = scalar::raindrop_as_published<N>(uniforms, i);
    out[0] = drop.x;
    out[1] = drop.y;
    out[2] = drop.z;
    out[3] = N(raindrop_radius);
  }
};

class Raindrops : public capture::ModelOf<DropByDrop> {
 public:
  explicit Raindrops(const RaindropsUniforms& u) : ModelOf({u}) {}
  /// A drop lies somewhere on the wave, and its strength is at most the scene's.
  std::optional<double> extent(int value) const override {
    const RaindropsUniforms& u = pass().uniforms;
    const double extents[] = {static_cast<double>(u.width), static_cast<double>(u.height), u.drop_intensity, raindrop_radius};
    return extents[value];
  }
};

}  // namespace

std::unique_ptr<capture::PassModel> bind_raindrops(const capture::PassCase& c) {
  const auto u = capture::uniforms_of<RaindropsUniforms>(c);
  if (const int found = c.outputs.front().array.width; found != u.drop_count)
    throw Error(ExitCode::port_files, fmt::format("{}/out.{}: expected {} records, as drop_count says, found {}", c.folder(),
                                                  c.outputs.front().name, u.drop_count, found));
  return std::make_unique<Raindrops>(u);
}

}  // namespace rainref::puddle
