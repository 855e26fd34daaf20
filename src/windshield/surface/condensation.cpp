#include "windshield/surface/surface.h"

#include <algorithm>
#include <cmath>

#include "math/constants.h"
#include "math/real64.h"

namespace rainref::windshield {
namespace {

constexpr int taps_on_ring = 8, mist_tap_count = 1 + taps_on_ring;

}  // namespace

CondenseUniforms condense_uniforms(const CondensationSettings& s, const SurfaceSettings& surface, int frame) {
  CondenseUniforms u{};
  u.dt = whole_step(surface.fps, frame, wiped_grid(s.tau));
  u.inverse_tau = static_cast<float>(1 / s.tau);
  u.limit = wiped_limit(s.tau);
  u.wiped_limit = wiped_limit(surface.mask_tau);
  u.most = static_cast<float>(s.most);
  u.inverse_water = static_cast<float>(1 / s.water);
  return u;
}

MistUniforms mist_uniforms(const CondensationSettings& s, const CompositeUniforms& seen) {
  MistUniforms u{};
  std::copy_n(seen.u_row, 3, u.u_row);
  std::copy_n(seen.v_row, 3, u.v_row);
  std::copy_n(seen.w_row, 3, u.w_row);
  std::copy_n(seen.pixel, 2, u.pixel);
  std::copy_n(seen.half_size, 2, u.half_size);
  std::copy_n(seen.scene_scale, 2, u.scene_scale);
  u.glass_distance = seen.glass_distance;
  // A whole level, looked up without the next: four texels of it are the disc's radius, and its spread reaches from tap to tap.
  u.lod = static_cast<float>(std::max(std::floor(s.blur_lod - 2 + 0.5), 0.0));
  u.weight = static_cast<float>(1.0 / mist_tap_count);
  u.tap_count = mist_tap_count;
  u.veil = static_cast<float>(s.veil);
  return u;
}

std::vector<Tap> mist_taps(const CondensationSettings& s, int scene_width, int scene_height) {
  const double ring = 0.75 * exp2_real(Real64(s.blur_lod)).v;
  std::vector<Tap> taps{{0, 0, 0, 0}};
  for (int k = 0; k < taps_on_ring; ++k) {
    const Real64 angle(2 * pi * k / taps_on_ring);
    taps.push_back(
        {static_cast<float>(ring * cos_real(angle).v / scene_width), static_cast<float>(ring * sin_real(angle).v / scene_height), 0, 0});
  }
  return taps;
}

Image make_clear_time(const CondensationSettings& s, const SurfaceSettings& surface) {
  Image time(Format::r32f, surface.width, surface.height);
  for (int y = 0; y < surface.height; ++y) std::fill_n(time.row<float>(y), surface.width, wiped_limit(s.tau));
  return time;
}

}  // namespace rainref::windshield
