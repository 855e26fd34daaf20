// Colour codes on the host, with the curves of the passes, for images that are read once.
#pragma once

#include "math/real64.h"

namespace rainref {

/// sRGB code value in [0, 1] to linear (IEC 61966-2-1), in double.
inline double decode_srgb(double code) { return code <= 0.04045 ? code / 12.92 : pow_real(Real64((code + 0.055) / 1.055), Real64(2.4)).v; }
/// Linear to sRGB code value (IEC 61966-2-1), in double; x in [0, 1].
inline double encode_srgb(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * pow_real(Real64(x), Real64(1 / 2.4)).v - 0.055; }
/// x^(1 / 2.2) of x >= 0, for a shader that decodes by the power 2.2.
inline double encode_gamma22(double x) { return x <= 0 ? 0.0 : pow_real(Real64(x), Real64(1 / 2.2)).v; }

/// Its inverse.
inline double decode_gamma22(double code) { return code <= 0 ? 0.0 : pow_real(Real64(code), Real64(2.2)).v; }

}  // namespace rainref
