#include "windshield/condensation.h"

#include <algorithm>

namespace rainref::windshield {

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
  u.lod = static_cast<float>(s.blur_lod);
  u.veil = static_cast<float>(s.veil);
  return u;
}

Image make_clear_time(const CondensationSettings& s, const SurfaceSettings& surface) {
  Image time(Format::r32f, surface.width, surface.height);
  for (int y = 0; y < surface.height; ++y) std::fill_n(time.row<float>(y), surface.width, wiped_limit(s.tau));
  return time;
}

}  // namespace rainref::windshield
