#include "image/code_range.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "image/colour.h"
#include "math/floor_of.h"
#include "math/half.h"
#include "math/unorm.h"

namespace rainref::enclosed {
namespace {

constexpr std::int64_t half_infinity = 0x7c00, half_max = 0x7bff, least_normal_half = 0x0400;

std::int64_t signed_magnitude(std::uint32_t bits, std::uint32_t sign) {
  return bits & sign ? -static_cast<std::int64_t>(bits & (sign - 1)) : static_cast<std::int64_t>(bits);
}

// The largest code that a store of x may write; the smallest is that of -x, negated.
std::int64_t highest_half(float x, const StoreRules& rules) {
  const std::int64_t toward_zero = signed_magnitude(to_half(x, Rounding::rtz).bits, 0x8000u);
  std::int64_t code = toward_zero;
  if (rules.half == StoreRounding::rne) code = signed_magnitude(to_half(x).bits, 0x8000u);
  if (rules.half == StoreRounding::either && to_float(to_half(x, Rounding::rtz)) < x) ++code;
  // Truncation never reaches infinity; 2^16 is where the half after the largest would be.
  if (rules.half == StoreRounding::rtz && x >= 0x1p16f) code = half_infinity;
  if (rules.half == StoreRounding::rtz && x <= -0x1p16f) code = -half_infinity;
  if (code >= half_infinity) return rules.half_overflow == StoreOverflow::max ? half_max : half_infinity;
  if (x <= -0x1p16f || code <= -half_infinity) return rules.half_overflow == StoreOverflow::inf ? -half_infinity : -half_max;
  return code;
}

double ceil_of(double x) { return -floor_of(-x); }

// Codes within ulp of the reals [low, high]; from half a code on at most the neighbours.
CodeRange codes_near(double low, double high, double ulp) {
  const double first = std::max(ceil_of(low - ulp), floor_of(low)), last = std::min(floor_of(high + ulp), ceil_of(high));
  return {static_cast<std::int64_t>(std::clamp(first, 0.0, 255.0)), static_cast<std::int64_t>(std::clamp(last, 0.0, 255.0))};
}

float held(float x) { return x < 0 ? 0.0f : 1 < x ? 1.0f : x; }

// 255 x, or the integer itself if x is the float nearest to code / 255.
double scaled_unorm(float x) {
  const double scaled = 255.0 * x, nearest = floor_of(scaled + 0.5);
  return to_float(Unorm8{static_cast<std::uint8_t>(nearest)}) == x ? nearest : scaled;
}

CodeRange unorm_range(const Enclosure& v, const StoreRules& rules) {
  const float low = held(v.lo), high = held(v.hi);
  if (rules.unorm == Rounding::rtz) {
    const CodeRange cut{to_unorm8(low, Rounding::rtz).code, to_unorm8(high, Rounding::rtz).code};
    // The reference rounds 255 x to a float first; a device may truncate the exact product, or the float above it.
    return rules.unorm_ulp == 0 ? cut
                                : CodeRange{static_cast<std::int64_t>(255.0 * low), static_cast<std::int64_t>(float_above(255.0 * high))};
  }
  CodeRange out{to_unorm8(low).code, to_unorm8(high).code};
  if (rules.unorm_ulp > 0) {
    const CodeRange near = codes_near(scaled_unorm(low), scaled_unorm(high), rules.unorm_ulp);
    out = {std::min(out.lo, near.lo), std::max(out.hi, near.hi)};
  }
  return out;
}

CodeRange srgb_range(const Enclosure& v, const StoreRules& rules) {
  const double low = 255 * encode_srgb(held(v.lo)), high = 255 * encode_srgb(held(v.hi));
  const auto nearest = [](double s) { return static_cast<std::int64_t>((s + 0x1p52) - 0x1p52); };
  const CodeRange out{nearest(low), nearest(high)};
  // The two pieces of the curve agree to 1e-5 of a code.
  return rules.srgb_ulp == 0 ? out : codes_near(std::max(low - 1e-5, 0.0), high + 1e-5, rules.srgb_ulp);
}

}  // namespace

StoreRules store_rules(const Profile& p, Rounding unorm) {
  return {p.half_store, p.half_overflow, unorm, p.unorm_store_ulp, p.srgb_store_ulp, p.half_store_flush};
}

CodeRange code_range(FormatInfo::Kind kind, const Enclosure& v, const StoreRules& rules) {
  if (v.is_vacuous()) return CodeRange::vacuous();
  switch (kind) {
    case FormatInfo::float32: {
      const auto code = [](float x) { return signed_magnitude(std::bit_cast<std::uint32_t>(x), 0x80000000u); };
      return {code(v.lo), code(v.hi)};
    }
    case FormatInfo::float16: {
      CodeRange out{-highest_half(-v.lo, rules), highest_half(v.hi, rules)};
      if (rules.half_flush && 0 < out.lo && out.lo < least_normal_half) out.lo = 0;
      if (rules.half_flush && -least_normal_half < out.hi && out.hi < 0) out.hi = 0;
      return out;
    }
    case FormatInfo::unorm8:
      return unorm_range(v, rules);
    case FormatInfo::srgb8:
      return srgb_range(v, rules);
    case FormatInfo::uint32: {
      const auto code = [](float x) { return static_cast<std::int64_t>(std::clamp<double>(x, 0, 4294967295.0)); };
      return {code(v.lo), code(v.hi)};
    }
  }
  return CodeRange::vacuous();
}

std::int64_t ordered_code(FormatInfo::Kind kind, const std::byte* stored) {
  const auto byte = [&](int i) { return std::to_integer<std::uint32_t>(stored[i]); };
  switch (kind) {
    case FormatInfo::float32:
      return signed_magnitude(byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24, 0x80000000u);
    case FormatInfo::float16:
      return signed_magnitude(byte(0) | byte(1) << 8, 0x8000u);
    case FormatInfo::unorm8:
    case FormatInfo::srgb8:
      return byte(0);
    case FormatInfo::uint32:
      return static_cast<std::int64_t>(byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24);
  }
  return INT64_MAX;
}

std::uint32_t code_bits(FormatInfo::Kind kind, std::int64_t code) {
  const auto magnitude = static_cast<std::uint32_t>(code < 0 ? -code : code);
  if (kind == FormatInfo::float32) return magnitude | (code < 0 ? 0x80000000u : 0u);
  if (kind == FormatInfo::float16) return magnitude | (code < 0 ? 0x8000u : 0u);
  return magnitude;
}
double code_value(FormatInfo::Kind kind, std::int64_t code) {
  const std::uint32_t bits = code_bits(kind, code);
  switch (kind) {
    case FormatInfo::float32:
      return std::bit_cast<float>(bits);
    case FormatInfo::float16:
      return to_float(Half{static_cast<std::uint16_t>(bits)});
    case FormatInfo::unorm8:
      return static_cast<double>(bits) / 255;
    case FormatInfo::srgb8:
      return decode_srgb(static_cast<double>(bits) / 255);
    case FormatInfo::uint32:
      return bits;
  }
  return 0;
}
std::string code_text(FormatInfo::Kind kind, std::int64_t code) {
  const std::uint32_t bits = code_bits(kind, code);
  switch (kind) {
    case FormatInfo::float32:
      return fmt::format("{:.9g} (0x{:08x})", code_value(kind, code), bits);
    case FormatInfo::float16:
      return fmt::format("{:.6g} (0x{:04x})", code_value(kind, code), bits);
    case FormatInfo::unorm8:
    case FormatInfo::srgb8:
      return fmt::format("{:.5g} (0x{:02x})", code_value(kind, code), bits);
    case FormatInfo::uint32:
      return fmt::format("{} (0x{:x})", bits, bits);
  }
  return "";
}

}  // namespace rainref::enclosed
