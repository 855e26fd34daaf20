// A lookup with variations.
#include <algorithm>

#include "math/fixed_point_filter.h"
#include "math/perturbed_draws.h"

namespace rainref::perturbed {

Sampler::Sampler()
    : is_used(behaviour().variations && behaviour().variations->rules.subtexel_bits > 0 && coin()),
      is_fixed_point(behaviour().filter == Filter::fixed_point) {}
float Sampler::coordinate(float u) const {
  if (!is_used || behaviour().variations->rules.coordinate_bits == 0) return u;
  // 0.9 leaves room for the rounding of the sum.
  return static_cast<float>(u + 0.9 * swing() * u * power_of_two(-behaviour().variations->rules.coordinate_bits));
}
namespace {
/// x in fixed point: truncated, rounded, or anything between.
float snapped(float x, int bits) {
  const double steps = power_of_two(bits), offset = std::min(0.5 + 0.5 * swing(), 1 - 0x1p-20);
  return static_cast<float>(floor(scalar::Scalar<double>(scalar::Scalar<double>(x * steps + offset))).v / steps);
}
}  // namespace
float Sampler::texel(float x) const { return is_used ? snapped(x, behaviour().variations->rules.subtexel_bits) : x; }
float Sampler::level(float lod) const {
  if (is_fixed_point) return fixed_point::level(lod);
  return behaviour().variations && behaviour().variations->rules.lod_bits > 0 ? snapped(lod, behaviour().variations->rules.lod_bits) : lod;
}

float Sampler::blend(float in_float, float a, float b, float c, float d, bool inside_cell, int bits) const {
  if (!is_used) return in_float;
  const double twist = inside_cell ? magnitude(static_cast<double>(a) - b - c + d) : 0;  // weights of 0 stay 0
  const double value = in_float + swing() * power_of_two(-behaviour().variations->rules.subtexel_bits) * twist;
  const auto [least, greatest] = std::minmax({a, b, c, d});
  return std::clamp(stored(static_cast<float>(value), bits), least, greatest);
}
float Sampler::stored(float in_float, int bits) const {
  if (is_fixed_point) return bits == 11 ? fixed_point::to_nearest_half(in_float) : in_float;
  double value = in_float;
  const bool up = behaviour().lean != 0 && (draw() & 7) != 0 ? behaviour().lean > 0 : coin();
  if (bits == 0) {
    value = floor(scalar::Scalar<double>(scalar::Scalar<double>(value * 255 + (up ? 1 - 0x1p-20 : 0)))).v / 255;
  } else if (bits == 11) {
    const float x = static_cast<float>(value);
    const Half cut = to_half(x, Rounding::rtz);
    const bool away = to_float(cut) != x && up == (x > 0);
    value = to_float(Half{static_cast<std::uint16_t>(cut.bits + (away ? 1 : 0))});
  }
  return static_cast<float>(value);
}
bool Sampler::rounds_jointly() const { return is_fixed_point || (is_used && coin()); }
bool Sampler::takes_x_first() const { return is_fixed_point || coin(); }
Share& share() {
  thread_local Share current_share;
  return current_share;
}
float Sampler::weighted(float a, float b, float c, float d, float fx, float fy, float share, bool x_first) const {
  if (is_fixed_point) return fixed_point::weighted(a, b, c, d, fx, fy, share);
  if (!x_first) {
    std::swap(b, c);
    std::swap(fx, fy);
  }
  const double steps = power_of_two(behaviour().variations->rules.subtexel_bits), whole = steps * static_cast<double>(share);
  // To the nearest; ties go either way.
  const auto rounded = [](double x) {
    const double down = floor(scalar::Scalar<double>(scalar::Scalar<double>(x))).v, rest = x - down;
    return rest > 0.5 || (rest == 0.5 && coin()) ? down + 1 : down;
  };
  const double right = rounded(whole * static_cast<double>(fx)), left = whole - right;
  const double right_above = rounded(right * static_cast<double>(fy)), left_above = rounded(left * static_cast<double>(fy));
  return static_cast<float>(((left - left_above) * a + (right - right_above) * b + left_above * c + right_above * d) / steps);
}

}  // namespace rainref::perturbed
