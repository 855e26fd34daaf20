#include "windshield/surface/smear.h"

#include <algorithm>
#include <cmath>

#include "math/constants.h"
#include "math/half.h"
#include "math/real64.h"
#include "math/smooth_step.h"
#include "random/counter.h"

namespace rainref::windshield {
namespace {

constexpr int columns = 256;                     // of the profile: 2 mm of an ordinary blade
constexpr int each_side = 16;                    // deflections
constexpr double water = 0.02;                   // height that takes all of the film up [mm]
constexpr double end_share = 0.08;               // of the blade's length, from either end
constexpr double least_streaks = 5, more = 40;   // of a new blade, and of a ragged one besides
constexpr double narrowest = 0.8, widest = 2.4;  // half their width [columns]

}  // namespace

SmearUniforms smear_uniforms(const SmearSettings& s, const SurfaceSettings& surface) {
  const WipeTextureUniforms wipe = wipe_texture_uniforms(surface, 0);
  SmearUniforms u{};
  std::copy_n(wipe.frame, 3, u.frame);
  u.edge_width = wipe.edge_width;
  u.inverse_water = static_cast<float>(1 / water);
  u.drying = static_cast<float>(1 / s.drying);
  return u;
}

std::vector<Deflection> deflections(const SmearSettings& s) {
  const Real64 angle(s.spread_deg * degree);
  const double tangent = (sin_real(angle) / cos_real(angle)).v;
  const auto weight = [](int k) {
    const double left = 1 - std::abs(k) / (each_side + 1.0);
    return left * left;
  };
  double sum = 0;
  for (int k = -each_side; k <= each_side; ++k) sum += weight(k);
  std::vector<Deflection> all;
  for (int k = -each_side; k <= each_side; ++k)
    all.push_back({static_cast<float>(tangent * k / each_side), static_cast<float>(weight(k) / sum), 0, 0});
  return all;
}

SoftenUniforms soften_uniforms(const SmearSettings& s, const CompositeUniforms& seen, int scene_width) {
  SoftenUniforms u{};
  std::copy_n(seen.u_row, 3, u.u_row);
  std::copy_n(seen.v_row, 3, u.v_row);
  std::copy_n(seen.w_row, 3, u.w_row);
  std::copy_n(seen.plane_x, 3, u.plane_x);
  std::copy_n(seen.plane_y, 3, u.plane_y);
  std::copy_n(seen.pixel, 2, u.pixel);
  std::copy_n(seen.half_size, 2, u.half_size);
  std::copy_n(seen.scene_scale, 2, u.scene_scale);
  u.glass_distance = seen.glass_distance;
  u.most = static_cast<float>(s.most);
  u.deflection_count = 2 * each_side + 1;
  // The whole level whose texels are about as far apart as the lookups.
  const Real64 angle(s.spread_deg * degree);
  const double apart = (sin_real(angle) / cos_real(angle)).v / each_side * seen.scene_scale[0] * scene_width;
  for (double texel = 1.5; texel <= apart; texel *= 2) u.lod += 1;
  return u;
}

Image smear_profile(const SmearSettings& s, std::uint64_t seed) {
  const auto word = [&](int of, int k) {
    return random::block(seed, random::Purpose::wiper_smear, static_cast<std::uint32_t>(of), static_cast<std::uint32_t>(k));
  };
  std::vector<double> film(columns);
  for (int k = 0; k < columns; ++k) {
    const double grain = 0.5 + random::uniform(word(0, k)[0]), end = std::min(k + 0.5, columns - k - 0.5) / columns;
    film[static_cast<std::size_t>(k)] = (0.12 + 0.16 * s.wear) * grain + (0.2 + 0.4 * s.wear) * (1 - smooth_step(end / end_share)) * grain;
  }
  const int streaks = static_cast<int>(least_streaks + more * s.wear);
  for (int i = 0; i < streaks; ++i) {
    const random::Block r = word(1, i);
    const double at = columns * random::uniform(r[0]), half = narrowest + (widest - narrowest) * random::uniform(r[1]);
    const double high = 0.3 + 0.7 * random::uniform(r[2]);
    for (int k = 0; k < columns; ++k) {
      double& here = film[static_cast<std::size_t>(k)];
      here = std::max(here, high * (1 - smooth_step(std::abs(k + 0.5 - at) / (2 * half))));
    }
  }
  Image profile(Format::r16f, columns, 1);
  for (int k = 0; k < columns; ++k) profile.row<Half>(0)[k] = to_half(static_cast<float>(std::min(film[static_cast<std::size_t>(k)], 1.0)));
  return profile;
}

Image make_laid(const SurfaceSettings& surface) { return Image(Format::rgba16f, surface.width, surface.height); }

}  // namespace rainref::windshield
