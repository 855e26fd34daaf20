#include "math/rearranged.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rainref::enclosed {
namespace {

constexpr double infinite = __builtin_inf();
/// For numbers without a lowest bit: an interval, a quotient.
constexpr int no_quantum = -100000;
/// For zero, which is a multiple of everything.
constexpr int any_quantum = 100000;
/// Largest number of terms that can be bounded; if products of sums are not multiplied out, largest number of roundings.
constexpr float most_terms = 0x1p22f;
constexpr double most_roundings = 1024;

double gamma(double k, double u) { return k * u / (1 - k * u); }

int lowest_bit(float x) {
  if (x == 0) return any_quantum;
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t exponent = bits >> 23 & 0xff, fraction = bits & 0x7fffff;
  return exponent == 0 ? std::countr_zero(fraction) - 149 : static_cast<int>(exponent) - 150 + std::countr_zero(fraction | 0x800000);
}

/// Largest error of one operation, relative to its result.
double unit() { return profile().basic == BasicRounding::nearest ? 0x1p-24 : 0x1p-23; }

/// 2^n, |n| at most 1022.
double power_of_two(int n) { return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + n) << 52); }

double largest(double a, double b) { return std::max(std::abs(a), std::abs(b)); }

}  // namespace

Rearranged::Rearranged(const Enclosure& leaf) {
  const Enclosure e = leaf.unrounded();
  if (e.is_vacuous()) {
    lo_ = -infinite;
    hi_ = size_ = padded_ = infinite;
    return;
  }
  lo_ = e.lo;
  hi_ = e.hi;
  size_ = e.magnitude();
  padded_ = std::max(1.0, size_);
  terms_ = size_ > 0 ? 1 : 0;
  degree_ = 1;
  quantum_ = e.is_point() ? lowest_bit(e.lo) : no_quantum;
}

bool Rearranged::is_on_grid() const { return quantum_ >= -126 && size_ <= power_of_two(24 + std::min(quantum_, 200)); }

double Rearranged::error() const {
  if (is_leaf_ || size_ == 0) return 0;
  if (is_on_grid()) return 0;
  const double k = std::max(1.0, static_cast<double>(terms_) + degree_ - 1);
  if (terms_ > most_terms || !(k * unit() < 0.5) || (is_factored_ && k > most_roundings)) return infinite;
  const double g = gamma(k, unit());
  if (!((1 + g) * padded_ <= largest_finite)) return infinite;
  // The ends themselves were computed in double.
  return (g + 0x1p-50) * size_ + 2 * (static_cast<double>(terms_) + degree_) * 0x1p-126 * padded_;
}

Enclosure Rearranged::settled() const {
  if (is_vacuous()) return Enclosure::vacuous();
  const double e = error();
  if (!(e < infinite)) return Enclosure::vacuous();
  return Enclosure::checked(float_below(lo_ - e), float_above(hi_ + e));
}
Enclosure Rearranged::not_below_zero() const {
  const Enclosure e = settled();
  return e.is_vacuous() || lo_ < 0 || e.lo >= 0 ? e : Enclosure(0.0f, e.hi);
}

bool Rearranged::is_power_of_two() const {
  // A leaf's ends are floats, which are normal numbers in double.
  return is_leaf_ && lo_ == hi_ && lo_ != 0 && (std::bit_cast<std::uint64_t>(lo_) << 12) == 0;
}
Rearranged Rearranged::scaled(double power) const {
  Rearranged out = *this;
  out.lo_ = std::min(lo_ * power, hi_ * power);
  out.hi_ = std::max(lo_ * power, hi_ * power);
  out.size_ *= std::abs(power);
  out.padded_ *= std::max(1.0, std::abs(power));
  if (std::abs(quantum_) < any_quantum) out.quantum_ += std::ilogb(power);
  out.is_leaf_ = false;
  return out;
}

Rearranged operator+(const Rearranged& a, const Rearranged& b) {
  if (a.is_vacuous() || b.is_vacuous()) return Rearranged::vacuous();
  if (a.size_ == 0) return b;
  if (b.size_ == 0) return a;
  Rearranged out;
  out.lo_ = a.lo_ + b.lo_;
  out.hi_ = a.hi_ + b.hi_;
  out.size_ = a.size_ + b.size_;
  out.padded_ = a.padded_ + b.padded_;
  out.terms_ = a.terms_ + b.terms_;
  out.degree_ = std::max(a.degree_, b.degree_);
  out.quantum_ = std::min(a.quantum_, b.quantum_);
  out.is_sum_ = true;
  out.is_leaf_ = false;
  out.is_factored_ = a.is_factored_ || b.is_factored_;
  return out;
}
Rearranged operator-(Rearranged a) {
  a.lo_ = -a.lo_;
  a.hi_ = -a.hi_;
  std::swap(a.lo_, a.hi_);
  return a;
}

Rearranged operator*(const Rearranged& a, const Rearranged& b) {
  if (a.is_vacuous() || b.is_vacuous()) return Rearranged::vacuous();
  if (a.size_ == 0 || b.size_ == 0) return Rearranged();
  if (a.is_power_of_two()) return b.scaled(a.lo_);
  if (b.is_power_of_two()) return a.scaled(b.lo_);
  const Rearrangement how = profile().rearrangement;
  if (how == Rearrangement::reassociated && (a.is_sum_ || b.is_sum_)) return (a.is_sum_ ? a.as_leaf() : a) * (b.is_sum_ ? b.as_leaf() : b);
  Rearranged out;
  const auto [low, high] = std::minmax({a.lo_ * b.lo_, a.lo_ * b.hi_, a.hi_ * b.lo_, a.hi_ * b.hi_});
  out.lo_ = low;
  out.hi_ = high;
  out.size_ = a.size_ * b.size_;
  out.terms_ = a.terms_ * b.terms_;
  out.padded_ = a.padded_ * b.padded_;
  out.degree_ = a.degree_ + b.degree_;
  out.quantum_ = std::max(no_quantum, a.quantum_ + b.quantum_);
  out.is_factored_ = a.is_factored_ || b.is_factored_;
  if (a.is_sum_ && b.is_sum_ && how == Rearrangement::distributed && !out.is_on_grid()) {
    // Not multiplied out: the error of each side times the other, and both errors, of at most most_roundings each.
    const double x = largest(a.lo_, a.hi_), y = largest(b.lo_, b.hi_);
    out.size_ = a.size_ * y + x * b.size_ + gamma(most_roundings, unit()) * a.size_ * b.size_;
    out.terms_ = a.terms_ + b.terms_;
    out.quantum_ = no_quantum;
    out.is_factored_ = true;
  }
  out.is_sum_ = a.is_sum_ || b.is_sum_;
  out.is_leaf_ = false;
  return out;
}

Rearranged square(const Rearranged& a) {
  Rearranged out = a * a;
  if (out.is_vacuous() || out.size_ == 0) return out;
  const double least = a.lo_ > 0 ? a.lo_ : a.hi_ < 0 ? -a.hi_ : 0, most = largest(a.lo_, a.hi_);
  out.lo_ = std::max(out.lo_, least * least);
  out.hi_ = std::min(out.hi_, most * most);
  return out;
}

Rearranged operator/(const Rearranged& a, const Rearranged& b) {
  const Enclosure by = b.settled();
  if (a.is_vacuous() || by.is_vacuous() || (by.lo <= 0 && 0 <= by.hi)) return Rearranged::vacuous();
  const double nearest = std::min(std::abs(by.lo), std::abs(by.hi)), furthest = std::max(std::abs(by.lo), std::abs(by.hi));
  if (nearest < 0x1p-126 || furthest > 0x1p126) return Rearranged::vacuous();
  if (a.size_ == 0) return Rearranged();
  if (b.is_power_of_two()) return a.scaled(1 / b.lo_);
  // 1 / b as the device computes it. Products with it count four roundings, which covers a separate quotient for each term.
  const Accuracy& division = profile().division;
  const double relative = std::max(3.5 * unit(), (division.ulp + 1) * 0x1p-23 + division.relative);
  const double one = 1 / static_cast<double>(by.hi), other = 1 / static_cast<double>(by.lo);
  Rearranged r;
  r.lo_ = one - std::abs(one) * relative;
  r.hi_ = other + std::abs(other) * relative;
  r.size_ = largest(r.lo_, r.hi_);
  r.padded_ = std::max(1.0, r.size_);
  r.terms_ = 1;
  r.degree_ = 4;
  r.quantum_ = no_quantum;
  r.is_leaf_ = false;
  return a * r;
}

Rearranged mix(const Rearranged& a, const Rearranged& b, const Rearranged& t) {
  const Rearranged published = a * (Rearranged(1.0f) - t) + b * t, other = a + (b - a) * t;
  if (published.is_vacuous() || other.is_vacuous()) return Rearranged::vacuous();
  Rearranged out = published.size_ < other.size_ ? other : published;
  out.terms_ = std::max(published.terms_, other.terms_);
  out.degree_ = std::max(published.degree_, other.degree_);
  out.padded_ = std::max(published.padded_, other.padded_);
  out.is_factored_ = published.is_factored_ || other.is_factored_;
  out.quantum_ = std::min(published.quantum_, other.quantum_);
  out.is_sum_ = true;
  out.is_leaf_ = false;
  // Linear in each argument, so the extrema are at corners.
  out.lo_ = infinite;
  out.hi_ = -infinite;
  for (const double s : {t.lo_, t.hi_})
    for (const double x : {a.lo_, a.hi_})
      for (const double y : {b.lo_, b.hi_}) {
        out.lo_ = std::min(out.lo_, x * (1 - s) + y * s);
        out.hi_ = std::max(out.hi_, x * (1 - s) + y * s);
      }
  return out;
}

Rearranged abs(const Rearranged& a) {
  const Enclosure e = a.settled();
  if (e.is_vacuous()) return Rearranged::vacuous();
  if (e.lo >= 0) return a;
  if (e.hi <= 0) return -a;
  return Rearranged(abs(e));
}

Rearranged fract(const Rearranged& a) {
  const Enclosure cell = floor(a.settled());
  if (cell.is_vacuous()) return Rearranged::vacuous();
  if (!cell.is_point()) return Rearranged(Enclosure(0.0f, 1.0f));
  return a - Rearranged(cell);
}

Rearranged smoothstep(float edge0, float edge1, const Rearranged& x) {
  const Rearranged ramp = (x - Rearranged(edge0)) / (Rearranged(edge1) - Rearranged(edge0));
  const Enclosure t = scalar::saturate(ramp.settled());
  if (t.is_vacuous()) return Rearranged::vacuous();
  if (t.is_point() && (t.lo == 0 || t.lo == 1)) return Rearranged(t);
  // It grows with t. Five roundings, relative to 3 t t + 2 t t t.
  const auto cubic = [](double s) { return s * s * (3 - 2 * s); };
  const auto error = [](double s) { return (5 * unit() / (1 - 5 * unit()) + 0x1p-50) * (3 * s * s + 2 * s * s * s) + 0x1p-120; };
  const double low = cubic(t.lo) - error(t.hi), high = cubic(t.hi) + error(t.hi);
  return Rearranged(Enclosure::checked(float_below(std::max(low, 0.0)), float_above(high)));
}

scalar::Vec3<Rearranged> normalize(const scalar::Vec3<Rearranged>& a) {
  const scalar::Vec3<Enclosure> n = normalize(scalar::Vec3<Enclosure>(a.x.settled(), a.y.settled(), a.z.settled()));
  return {Rearranged(n.x), Rearranged(n.y), Rearranged(n.z)};
}

}  // namespace rainref::enclosed
