// Uniform block of splat. The size is a multiple of 16 bytes and no member crosses a 16-byte row, so the bytes are valid in every GPU
// language.
#pragma once

#include <cstdint>

namespace rainref::drops {

/// Profile of a drop from its centre, as a function of q = distance / radius < 1.
enum class SplatKernel : std::int32_t {
  paraboloid,  ///< 1 - q^2
  quartic,     ///< (1 - q^2)^2
  smoothstep,  ///< 1 - q^2 (3 - 2 q)
  hemisphere,  ///< sqrt(1 - q^2)
  disc         ///< 1
};
/// How drops combine in a texel.
enum class SplatBlend : std::int32_t {
  add,
  max,
  add_in_half  ///< add, and round to half after each drop. For `max`, rounding each drop gives the same result as rounding once
};

struct SplatUniforms {
  float size[2], radius_scale, height_scale;
  float frame[3], smallest_radius;
  std::int32_t kernel, blend, drop_count;
  float film_scale;
  // corrected: the lean of drops that hysteresis holds by their contact line.
  float gravity[2];  ///< pull of gravity and inertia on a drop of mass 1, in axes of the plane, divided by what holds it; scales with
                     ///< mass^(2/3)
  float wind[2];     ///< the same for the wind; scales with mass^(1/3)
  float longer, taper, skew, moment;
};
/// True if drops may be other than round.
inline bool leans(const SplatUniforms& u) { return u.longer != 0 || u.taper != 0 || u.skew != 0; }
/// Largest extent of a drop, in its radii.
inline float lean_reach(const SplatUniforms& u) { return 1 + (u.longer > u.taper ? u.longer : u.taper); }

/// For drops that are two: width of the neck between footprints that touch, divided by twice the smaller radius, squared.
constexpr float neck_width = 1.2f;
/// Number of parts of such a drop's length over which its volume is summed.
constexpr int neck_parts = 16;
/// Largest extent of a drop that is two, in its radii: the distance is at most 2^(2/3), and the smaller disc ends at 1.8.
constexpr float neck_reach = 2;

static_assert(sizeof(SplatUniforms) == 80);

}  // namespace rainref::drops
