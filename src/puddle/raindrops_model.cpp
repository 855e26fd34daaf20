// raindrops as published, as conformance takes it: a row of invocations, one for each drop.
//
// fract jumps, and its arguments are hashes: near an integer a drop has two places, which are two alternatives.
#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "puddle/info.h"
#include "puddle/scalar.h"
#include "rainref/error.h"

namespace rainref::puddle {
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
  /// A drop lies somewhere on the wave, and is at most as strong as the scene says.
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
