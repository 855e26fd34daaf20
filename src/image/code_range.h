// The codes that a conforming store may write for a value: a closed range of ordered codes.
//
// An ordered code counts the values that a storage kind can hold: neighbouring ones differ by 1, and -0 and +0 have the same code, 0. For
// floats it is the bits of the magnitude, with the sign; for unorm8, srgb8 and uint32 it is the stored integer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "math/enclosure.h"
#include "rainref/image.h"

namespace rainref::enclosed {

/// How a store rounds and overflows. A profile declares it; a vote over a device's results may narrow it.
struct StoreRules {
  StoreRounding half = StoreRounding::rne;
  StoreOverflow half_overflow = StoreOverflow::inf;
  Rounding unorm = Rounding::rne;      ///< the pass's requirement for its unorm8 outputs
  double unorm_ulp = 0, srgb_ulp = 0;  ///< see Profile::unorm_store_ulp and srgb_store_ulp
  bool half_flush = false;             ///< see Profile::half_store_flush
};
/// The rules of a profile, for an output whose unorm8 codes are rounded in this way.
StoreRules store_rules(const Profile& profile, Rounding unorm = Rounding::rne);

/// Codes lo to hi, both included. NaN has codes that only a vacuous range holds, which holds everything.
struct CodeRange {
  std::int64_t lo, hi;
  bool contains(std::int64_t code) const { return lo <= code && code <= hi; }
  bool is_vacuous() const { return lo == INT64_MIN; }
  static CodeRange vacuous() { return {INT64_MIN, INT64_MAX}; }
};
/// Codes that a store may write for a value; vacuous if the value is. The enclosure flushes subnormal floats, not this function.
///   float16  rne and rtz round each end; if either is allowed, from the half at or below lo to the half at or above hi.
///            Beyond the largest half: that half or infinity, as the rules say. Extended to 0 if a subnormal may be flushed.
///   unorm8   rne: codes within unorm_ulp of 255 x, x clamped to [0, 1]; the float nearest to code / 255 gives that code.
///            rtz: 255 x truncated. The reference's own code (math/unorm.h) is always included; if unorm_ulp is 0 it is the only one.
///   srgb8    codes within srgb_ulp of 255 encode(x), x clamped to [0, 1]; 0 rounds to nearest even.
///   uint32   x truncated, clamped to [0, 2^32 - 1].
CodeRange code_range(FormatInfo::Kind kind, const Enclosure& value, const StoreRules& rules);

/// The ordered code of a stored value, little endian, FormatInfo::channel_bytes bytes. NaN: beyond the infinity of its sign.
std::int64_t ordered_code(FormatInfo::Kind kind, const std::byte* stored);

/// The stored bits of an ordered code; code 0 of a float is +0.
std::uint32_t code_bits(FormatInfo::Kind kind, std::int64_t code);
/// The value that a shader reads: floats and integers unchanged, unorm8 code / 255, srgb8 linear.
double code_value(FormatInfo::Kind kind, std::int64_t code);
/// Value and bits: "0.146729 (0x30b2)".
std::string code_text(FormatInfo::Kind kind, std::int64_t code);

}  // namespace rainref::enclosed
