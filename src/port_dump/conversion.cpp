#include "port_dump/conversion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "image/code_range.h"
#include "math/directed.h"
#include "math/half.h"
#include "math/unorm.h"

namespace rainref::port_dump {
namespace {

using Kind = FormatInfo::Kind;

/// The largest distance of a code from what it is stored for: what every API asks of a store to 8 bits.
constexpr double code_reach = 0.6;
/// Four units in the last place of a float.
constexpr double arithmetic = 0x1p-21;

struct Interval {
  double low, high;
};

constexpr std::int64_t infinite_half = 0x7c00;

/// The value of a half's ordered code. The one after the largest is where a half would follow.
double half_at(std::int64_t code) {
  if (code >= infinite_half) return 0x1p16;
  if (code <= -infinite_half) return -0x1p16;
  return enclosed::code_value(Kind::float16, code);
}
/// The distance from a half to the next one away from zero.
double step_of_half(std::int64_t code) { return half_at(std::abs(code) + 1) - half_at(std::abs(code)); }

/// What a store rounds to the half of this code.
Interval before_store(std::int64_t code, std::optional<Rounding> half_store) {
  const double value = half_at(code), down = half_at(code - 1), up = half_at(code + 1);
  if (half_store == Rounding::rne) return {(value + down) / 2, (value + up) / 2};
  if (half_store == Rounding::rtz) return {code > 0 ? value : down, code < 0 ? value : up};
  return {down, up};
}

Interval times(double scale, Interval x) {
  return scale < 0 ? Interval{scale * x.high, scale * x.low} : Interval{scale * x.low, scale * x.high};
}

bool is_power_of_two(double x) {
  int exponent = 0;
  return std::abs(std::frexp(x, &exponent)) == 0.5;
}

/// True if a product with a power of two has the port's own bits: nothing was rounded, or as the buffer rounds.
bool keeps_bits(const ChannelSource& source, const StoredValue& stored, double product, Kind to) {
  if (source.terms.size() != 1 || source.bias != 0 || !is_power_of_two(source.terms[0].scale)) return false;
  if (stored.kind == Kind::float32) return true;
  if (stored.kind != Kind::float16 || to != Kind::float16) return false;
  const Half half = to_half(static_cast<float>(product));
  if (static_cast<double>(to_float(half)) != product) return false;
  const auto code = static_cast<std::int64_t>(half.bits & 0x7fffu);
  return step_of_half(code) == std::abs(source.terms[0].scale) * step_of_half(enclosed::ordered_code(Kind::float16, stored.at));
}

/// The value that the buffer's format stores for x.
float stored_as(Kind to, double x) {
  const float nearest = static_cast<float>(x) + 0.0f;  // stored zeros are positive
  if (to == Kind::float16) return to_float(to_half(nearest)) + 0.0f;
  return to == Kind::unorm8 ? to_float(to_unorm8(nearest)) : nearest;
}

}  // namespace

Converted convert(const ChannelSource& source, std::span<const StoredValue> stored, Kind to, std::optional<Rounding> half_store) {
  double sum = source.bias, size = std::abs(source.bias);
  Interval had{source.bias, source.bias};
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const std::int64_t code = enclosed::ordered_code(stored[i].kind, stored[i].at);
    const double scale = source.terms[i].scale, value = enclosed::code_value(stored[i].kind, code);
    sum += scale * value;
    size += std::abs(scale * value);
    Interval own{value, value};
    if (stored[i].kind == Kind::float16) own = before_store(code, half_store);
    if (stored[i].kind == Kind::unorm8) own = {value - code_reach / 255, value + code_reach / 255};
    const Interval product = times(scale, own);
    had = {had.low + product.low, had.high + product.high};
  }
  Converted out{stored_as(to, sum)};
  if (!std::isfinite(sum) || !std::isfinite(out.value)) return out;
  if (keeps_bits(source, stored[0], sum, to))
    had = {sum, sum};
  else
    had = {had.low - arithmetic * size, had.high + arithmetic * size};
  if (to == Kind::unorm8) had = {std::clamp(had.low, 0.0, 1.0), std::clamp(had.high, 0.0, 1.0)};  // as its store does
  const double value = out.value;
  out.below = enclosed::float_above(std::max(0.0, value - had.low));
  out.above = enclosed::float_above(std::max(0.0, had.high - value));
  return out;
}

}  // namespace rainref::port_dump
