// What splat takes besides images and drops. The size is a multiple of 16 bytes and nothing straddles a 16-byte row, so
// the bytes serve every GPU language.
#pragma once

#include <cstdint>

namespace rainref::drops {

/// How the height of a drop falls from its centre, over q = distance / radius < 1.
enum class SplatKernel : std::int32_t {
  paraboloid,  ///< 1 - q^2
  quartic,     ///< (1 - q^2)^2
  smoothstep,  ///< 1 - q^2 (3 - 2 q)
  hemisphere,  ///< sqrt(1 - q^2)
  disc         ///< 1
};
/// How drops join in a texel.
enum class SplatBlend : std::int32_t {
  add,
  max,
  add_in_half  ///< add, and round to half after each drop. Of halves rounded one by one the largest is what max gives anyway.
};

struct SplatUniforms {
  float size[2], radius_scale, height_scale;
  float frame[3], smallest_radius;
  std::int32_t kernel, blend, drop_count;
  float film_scale;
  // corrected: how drops lean, that hysteresis holds on their line.
  float gravity[2];  ///< pull of gravity and inertia on a drop of mass 1, in axes of the plane, over what holds it; with mass^(2/3)
  float wind[2];     ///< the same of the wind; with mass^(1/3)
  float longer, taper, skew, moment;
};
/// Whether drops are anything but round.
inline bool leans(const SplatUniforms& u) { return u.longer != 0 || u.taper != 0 || u.skew != 0; }
/// No drop reaches further than this many of its radii.
inline float lean_reach(const SplatUniforms& u) { return 1 + (u.longer > u.taper ? u.longer : u.taper); }

/// Of drops that are two: the neck between footprints that touch is this many times as wide, over twice the smaller one's radius, squared.
constexpr float neck_width = 1.2f;
/// Parts of such a drop's length in which its volume is summed.
constexpr int neck_parts = 16;
/// No drop that is two reaches further than this many of its radii: apart by 2^(2/3) at most, the smaller one ends at 1.8.
constexpr float neck_reach = 2;

static_assert(sizeof(SplatUniforms) == 80);

}  // namespace rainref::drops
