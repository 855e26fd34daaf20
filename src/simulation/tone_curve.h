// Tone curve for light above white.
#pragma once

#include <algorithm>
#include <array>

namespace rainref::simulation {

using Light = std::array<double, 3>;  ///< linear RGB; 1 is white

/// Light below the shoulder s = `shoulder` is unchanged. Above it the largest channel p becomes p' = 1 - (1 - s)^2 / (p + 1 - 2 s), which
/// continues with slope 1 and approaches 1. The other channels scale with it. Compressed colours fade to white: they are mixed with p' by 1
/// - 1 / (desaturation (p - p') + 1). Khronos PBR Neutral tone mapper (Khronos Group 2024, github.com/KhronosGroup/ToneMapping), which has
/// s = 0.76 and desaturation 0.15. Its F90 is left out; it subtracts from dark tones the light that Fresnel reflection adds in a studio. s
/// = 1: each channel is clamped to 1, as in the pass display. Channels must be finite and >= 0; s in [0, 1].
inline Light shown(const Light& c, double shoulder, double desaturation) {
  if (shoulder >= 1) return {std::min(c[0], 1.0), std::min(c[1], 1.0), std::min(c[2], 1.0)};
  const double p = std::max({c[0], c[1], c[2]});
  if (p <= shoulder) return c;
  const double room = 1 - shoulder, peak = 1 - room * room / (p + room - shoulder), scale = peak / p;
  const double white = 1 - 1 / (desaturation * (p - peak) + 1);
  Light out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = scale * c[k] + white * (peak - scale * c[k]);
  return out;
}

}  // namespace rainref::simulation
