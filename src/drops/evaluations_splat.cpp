// splat bound to captured cases.
#include <cmath>

#include <fmt/format.h>

#include "drops/framed.h"
#include "drops/half_sum.h"
#include "drops/evaluations.h"
#include "drops/splat_scalar.h"
#include "rainref/error.h"

namespace rainref::drops {
namespace {

struct Splat {
  int width, height, values = 1;
  SplatUniforms uniforms;
  bool corrected;
  Rounding rounding;
  std::vector<Drop> drops;
  std::vector<scalar::Stamp<scalar::Scalar<float>>> stamps;  // of each drop
  Framed film;

  bool rounds_each() const { return static_cast<SplatBlend>(uniforms.blend) == SplatBlend::add_in_half; }
  template <class N>
  scalar::Stamp<N> stamp(const Drop& d) const {
    return scalar::splat_stamp<N>(uniforms, N::load(&d.position[0]), N::load(&d.position[1]), N::load(&d.mass), N::load(&d.life));
  }
  /// Drops whose stamps end a texel and a fiftieth of their radius short of this one surely add nothing, as the kernel knows.
  template <class N>
  std::vector<scalar::Stamp<N>> near(int x, int y) const {
    std::vector<scalar::Stamp<N>> out;
    const float* frame = uniforms.frame;
    for (std::size_t i = 0; i < static_cast<std::size_t>(uniforms.drop_count); ++i) {
      const auto& s = stamps[i];
      const float column = static_cast<float>(x) + 0.5f - s.x.v, row = static_cast<float>(y) + 0.5f - s.y.v;
      const float plane_x = frame[0] * column + frame[1] * row, plane_y = frame[2] * row;
      const float reach = 1.02f * s.radius.v + std::abs(frame[0]) + std::abs(frame[1]) + std::abs(frame[2]);
      if (s.height.v > 0 && plane_x * plane_x + plane_y * plane_y < reach * reach) out.push_back(stamp<N>(drops[i]));
    }
    return out;
  }
  template <class N>
  void operator()(int x, int y, N* out) const {
    const std::vector<scalar::Stamp<N>> some = near<N>(x, y);
    SplatUniforms u = uniforms;
    u.drop_count = static_cast<std::int32_t>(some.size());
    out[0] = scalar::splat_drops<N>(u, some.data(), x, y, [&](N sum) { return rounds_each() ? half_of(sum, rounding) : sum; });
    if (corrected) out[0] = scalar::film_height<N>(u, film.row(y - 1), film.row(y), film.row(y + 1), x) + out[0];
  }
};

class SplatModel : public capture::ModelOf<Splat> {
 public:
  using ModelOf::ModelOf;
  bool rounds_inside() const override { return pass().rounds_each(); }
};

}  // namespace

const capture::CaseInput& sized_input(const capture::PassCase& c, const char* name) {
  const capture::CaseInput& input = capture::image_input(c, name);
  const capture::Array &a = input.array, &out = c.outputs.front().array;
  if (a.width != out.width || a.height != out.height) {
    throw Error(ExitCode::port_files, fmt::format("{}: in.{} is {}x{}, expected {}x{} as out.{}", c.folder(), name, a.width, a.height,
                                                  out.width, out.height, c.outputs.front().name));
  }
  return input;
}

std::unique_ptr<capture::PassModel> bind_splat(const capture::PassCase& c) {
  const capture::CaseOutput& out = c.outputs.front();
  Splat m;
  m.width = out.array.width;
  m.height = out.array.height;
  m.uniforms = capture::uniforms_of<SplatUniforms>(c);
  m.corrected = c.corrected();
  m.rounding = out.store_rounding;
  m.drops = capture::records_of<Drop>(capture::record_input(c, "drops"));
  // As many as the uniform says, but no more than there are.
  const auto most = static_cast<std::int32_t>(m.drops.size());
  if (m.uniforms.drop_count < 0 || m.uniforms.drop_count > most) m.uniforms.drop_count = most;
  for (const Drop& d : m.drops) m.stamps.push_back(m.stamp<scalar::Scalar<float>>(d));
  if (m.corrected) m.film = Framed(sized_input(c, "film"));
  return std::make_unique<SplatModel>(std::move(m));
}

}  // namespace rainref::drops
