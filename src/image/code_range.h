// What a conforming store may leave of a value: a closed range of ordered codes.
//
// An ordered code counts the values that a storage kind can hold: neighbouring ones differ by 1, and -0 and +0 have the
// same code, 0. Of floats it is the bits of the magnitude, with the sign; of unorm8, srgb8 and uint32 the stored
// integer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "math/enclosure.h"
#include "rainref/image.h"

namespace rainref::enclosed {

/// How a store rounds and overflows; a profile declares it, a vote over a device's results may narrow it.
struct StoreRules {
  StoreRounding half = StoreRounding::rne;
  StoreOverflow half_overflow = StoreOverflow::inf;
  Rounding unorm = Rounding::rne;      ///< what the pass asks of its unorm8 outputs
  double unorm_ulp = 0, srgb_ulp = 0;  ///< as Profile::unorm_store_ulp and srgb_store_ulp
  bool half_flush = false;             ///< as Profile::half_store_flush
};
/// What a profile declares, for an output whose unorm8 codes are rounded like this.
StoreRules store_rules(const Profile& profile, Rounding unorm = Rounding::rne);

/// Codes lo to hi, both included. Not a number has codes that no range holds, but a vacuous one, which holds
/// everything.
struct CodeRange {
  std::int64_t lo, hi;
  bool contains(std::int64_t code) const { return lo <= code && code <= hi; }
  bool is_vacuous() const { return lo == INT64_MIN; }
  static CodeRange vacuous() { return {INT64_MIN, INT64_MAX}; }
};
/// Vacuous of a vacuous value. Subnormal floats that may be flushed are flushed in the enclosure, not here.
///   float16  rne or rtz round each end; either takes the half at or below lo and the one at or above hi. Beyond the
///            largest half: that, or infinity, as the rules say. Up to 0 where a subnormal one may be flushed.
///   unorm8   rne: codes within unorm_ulp of 255 x, x held in [0, 1]; the float nearest to code / 255 gives that code.
///   rtz:
///            255 x cut toward zero. The reference's own code (math/unorm.h) always counts, and with unorm_ulp 0 alone.
///   srgb8    codes within srgb_ulp of 255 encode(x), x held in [0, 1]; 0 rounds to nearest even.
///   uint32   x cut toward zero, held in [0, 2^32 - 1].
CodeRange code_range(FormatInfo::Kind kind, const Enclosure& value, const StoreRules& rules);

/// The ordered code of a stored value, little endian, FormatInfo::channel_bytes of it. NaN: beyond the infinity of its
/// sign.
std::int64_t ordered_code(FormatInfo::Kind kind, const std::byte* stored);

/// The bits of an ordered code, as they are stored; code 0 of a float is +0.
std::uint32_t code_bits(FormatInfo::Kind kind, std::int64_t code);
/// What a shader reads: floats and integers as they are, unorm8 code / 255, srgb8 linear.
double code_value(FormatInfo::Kind kind, std::int64_t code);
/// Value and bits: "0.146729 (0x30b2)".
std::string code_text(FormatInfo::Kind kind, std::int64_t code);

}  // namespace rainref::enclosed
