// Rounding of a number to half, for passes that round between their operations.
#pragma once

#include "image/code_range.h"
#include "math/half.h"
#include "math/numbers.h"

namespace rainref::drops {

/// The value of the half that stores a number. `own`: the reference's rounding.
template <class T>
scalar::Scalar<T> half_of(scalar::Scalar<T> x, Rounding own) {
  return scalar::Scalar<T>(to_float(to_half(static_cast<float>(x.v), own)));
}
/// By the profile's store rules.
inline enclosed::Enclosure half_of(enclosed::Enclosure x, Rounding own) {
  using enclosed::Enclosure;
  if (x.is_vacuous()) return x;
  const enclosed::Profile& p = enclosed::profile();
  if (p.reference) return Enclosure::checked(to_float(to_half(x.lo, own)), to_float(to_half(x.hi, own)));
  const enclosed::CodeRange codes = enclosed::code_range(FormatInfo::float16, x, enclosed::store_rules(p));
  const auto value = [](std::int64_t code) { return static_cast<float>(enclosed::code_value(FormatInfo::float16, code)); };
  return Enclosure::checked(value(codes.lo), value(codes.hi));
}
inline enclosed::Rearranged half_of(const enclosed::Rearranged& x, Rounding own) { return enclosed::Rearranged(half_of(x.settled(), own)); }
/// As the variations' profile stores; if it leaves the rounding open, a random neighbour.
inline perturbed::Perturbed half_of(perturbed::Perturbed x, Rounding own) {
  perturbed::Behaviour& b = perturbed::behaviour();
  const auto coin = [&] {
    b.random += 0x9e3779b97f4a7c15u;
    return (b.random * 0xbf58476d1ce4e5b9u) >> 63 != 0;
  };
  const auto by = [&](Rounding r) { return to_float(to_half(x.v, r)); };
  if (!b.variations || b.variations->rules.reference) return perturbed::Perturbed::of(by(own));
  const enclosed::Profile& rules = b.variations->rules;
  float stored = by(rules.half_store == enclosed::StoreRounding::rne ? Rounding::rne : Rounding::rtz);
  if (rules.half_store == enclosed::StoreRounding::either && coin() && stored != x.v)
    stored = to_float(Half{static_cast<std::uint16_t>(to_half(x.v, Rounding::rtz).bits + 1)});
  if (rules.half_store_flush && stored < 0x1p-14f && stored > -0x1p-14f && coin()) stored = 0;
  return perturbed::Perturbed::of(stored);
}

}  // namespace rainref::drops
