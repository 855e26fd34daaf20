// The possible ends of the march of surface_hit as published.
//
// t' = t + f(t) along the ray, with f the distance to the box. An error e of t becomes |1 + f'| e. So both ends of the interval of t are
// marched, and moved apart by the possible excess of f' below -1. Each round in which f may be under epsilon is a possible end; the port's
// own count of rounds selects one. A ray that has left the box for good misses, however uncertain its t has become.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/whole.h"
#include "puddle/scalar.h"

namespace rainref::puddle {

/// The arguments must outlive it.
class PublishedMarch {
  using Enclosure = enclosed::Enclosure;
  using Vector = scalar::Vec3<Enclosure>;

 public:
  PublishedMarch(const SurfaceHitUniforms& u, const Texture& wave, float lowest, int px, int py)
      : u_(u),
        wave_(wave),
        origin_(u.camera.position),
        d_(scalar::camera_ray(u.camera, Enclosure::index(px), Enclosure(static_cast<float>(py)))),
        lowest_(lowest - 1e-5 * std::max(1.0f, -lowest)) {}

  /// A possible end of the march. If there is none, a port cannot be checked.
  struct End {
    Enclosure t;
    int rounds;
    bool hit;
  };
  std::vector<End> ends() const {
    std::vector<End> found;
    const int limit = u_.max_steps;
    double low = 0, high = 0;
    for (int round = 0; round < limit; ++round) {
      const double off = off_ray(round, high);
      if (passed_for_good(low, off)) {
        found.push_back({Enclosure(), limit - 1, false});
        return found;
      }
      const Enclosure f_low = distance(low, low, off), f_high = low == high ? f_low : distance(high, high, off);
      const Enclosure f = low == high ? f_low : distance(low, high, off);
      if (f.is_vacuous()) return {};
      const bool may_stop = f.lo < u_.epsilon, must_stop = f.hi < u_.epsilon;
      if (may_stop) found.push_back({enclosed::rounded_outward(low, high), round, true});
      if (must_stop) return found;
      if (f.lo >= 1000) {
        found.push_back({Enclosure(), limit - 1, false});
        return found;
      }
      // g(t) = t + f(t) falls by at most `back` between low and high.
      const double back = std::max(0.0, -1 - steepest_fall(low, high, off)) * (high - low);
      // A march that continues has found a distance of at least epsilon.
      const double next_low = std::max(low + f_low.lo - back, low + u_.epsilon), next_high = high + f_high.hi + back;
      low = std::min(next_low, next_high);
      high = std::max(next_low, next_high);
      if (high - low > 0.5) return {};
    }
    found.push_back({Enclosure(), limit - 1, false});
    return found;
  }

  /// The end with the port's number of rounds, or the nearest to it.
  static const End& nearest(const std::vector<End>& ends, const float* port) {
    return *std::min_element(ends.begin(), ends.end(), [port](const End& a, const End& b) {
      const auto far = [port](const End& e) {
        return std::abs(static_cast<double>(e.rounds) - port[3]) + (e.hit == (port[7] > 0.5f) ? 0.0 : 0.5);
      };
      return far(a) < far(b);
    });
  }
  scalar::SurfaceHit<Enclosure> at(const End& end, const float* port) const {
    scalar::SurfaceHit<Enclosure> out;
    out.position = origin_;
    if (end.hit) {
      const double off = off_ray(end.rounds, end.t.hi);
      out.position = point(end.t.lo, end.t.hi, off);
    }
    out.iterations = Enclosure(static_cast<float>(end.rounds));
    out.flag = Enclosure(end.hit ? 1.0f : 0.0f);
    // The normal is evaluated at the port's own position, which is stored without rounding.
    const bool own = out.position.x.contains(port[0]) && out.position.y.contains(port[1]) && out.position.z.contains(port[2]);
    out.normal = scalar::normal_as_published(u_, wave_, own ? Vector(port[0], port[1], port[2]) : out.position);
    return out;
  }

 private:
  /// Bound of the distance of a coordinate from the ray, due to the rounding of each step: for each sum an ULP, or half of one, of a
  /// position between the eye and t; for each product that of its step. The steps add up to t.
  double off_ray(int rounds, double t) const {
    const double unit = enclosed::profile().basic == enclosed::BasicRounding::nearest ? 0x1p-24 : 0x1p-23;
    double far = 0;
    const Enclosure o[3] = {origin_.x, origin_.y, origin_.z}, d[3] = {d_.x, d_.y, d_.z};
    for (int k = 0; k < 3; ++k) far = std::max({far, o[k].magnitude(), std::abs(o[k].lo + t * d[k].lo), std::abs(o[k].hi + t * d[k].hi)});
    return 1.01 * unit * (rounds * far + t);
  }
  Vector point(double low, double high, double off) const {
    const auto coordinate = [&](Enclosure o, Enclosure d) {
      const double p[4] = {low * d.lo, low * d.hi, high * d.lo, high * d.hi};
      return enclosed::rounded_outward(o.lo + *std::min_element(p, p + 4) - off, o.hi + *std::max_element(p, p + 4) + off);
    };
    return Vector(coordinate(origin_.x, d_.x), coordinate(origin_.y, d_.y), coordinate(origin_.z, d_.z));
  }
  Enclosure distance(double low, double high, double off) const { return scalar::scene_distance(u_, wave_, point(low, high, off)); }

  /// True if f stays at epsilon or more from t = low on: the ray is beside a face of the box and moves away from it.
  bool passed_for_good(double low, double off) const {
    const Vector p = point(low, low, off);
    const auto beside = [&](Enclosure c, Enclosure d, int k) {
      const double gap = d.lo >= 0   ? static_cast<double>(c.lo) - u_.half_size[k]
                         : d.hi <= 0 ? -static_cast<double>(c.hi) - u_.half_size[k]
                                     : 0;
      return gap > 2 * u_.epsilon;
    };
    const bool above = d_.y.lo >= 0 && p.y.lo + lowest_ - u_.half_size[1] > 2 * u_.epsilon;
    return above || beside(p.x, d_.x, 0) || beside(p.z, d_.z, 2);
  }

  /// A lower bound of f' on [low, high]. Above the box f is the gap to the displaced top, |y + h(x, z)| - b_y. Beside it f is a length of
  /// three parts, whose slope is bounded by the slopes of all of them together.
  double steepest_fall(double low, double high, double off) const {
    const Vector p = point(low, high, off);
    const Range sx = slopes(p, true), sz = slopes(p, false);
    const auto times = [](Range r, Enclosure d) {
      const double q[4] = {r.low * d.lo, r.low * d.hi, r.high * d.lo, r.high * d.hi};
      return Range{*std::min_element(q, q + 4), *std::max_element(q, q + 4)};
    };
    const Range x = times(sx, d_.x), z = times(sz, d_.z);
    const double rise_low = d_.y.lo + x.low + z.low, rise_high = d_.y.hi + x.high + z.high;
    const bool over_box = abs(p.x).hi <= u_.half_size[0] && abs(p.z).hi <= u_.half_size[2];
    if (over_box && p.y.lo + lowest_ > 0) return std::min(rise_low, 0.0);
    const double vertical = std::max(std::abs(rise_low), std::abs(rise_high)), dx = d_.x.magnitude(), dz = d_.z.magnitude();
    return -std::sqrt(dx * dx + vertical * vertical + dz * dz);
  }
  struct Range {
    double low, high;
  };
  /// Slopes of the sampled wave along one axis, per unit of length, in every cell that the box of points touches.
  Range slopes(const Vector& p, bool along_x) const {
    const int size[2] = {wave_.width[0], wave_.height[0]};
    const Enclosure at[2] = {p.x, p.z};
    const float half[2] = {u_.half_size[0], u_.half_size[2]};
    int first[2], last[2];
    for (int k = 0; k < 2; ++k) {
      const auto texel = [&](float x, double slack) {
        return whole_within(std::floor((x / half[k] + 1.0) * 0.5 * size[k] - 0.5 + slack), -1'000'000'000, 1'000'000'000);
      };
      if (!(std::abs(at[k].lo) < 1e6f && std::abs(at[k].hi) < 1e6f)) return {-1e9, 1e9};
      first[k] = texel(at[k].lo, -0.01);
      last[k] = texel(at[k].hi, 0.01);
      if (last[k] - first[k] >= size[k]) last[k] = first[k] + size[k] - 1;
    }
    const auto value = [&](int x, int y) {
      const auto held = [](int i, int n, Address a) { return a == Address::repeat ? ((i % n) + n) % n : std::clamp(i, 0, n - 1); };
      return static_cast<double>(
          wave_.texels[static_cast<std::ptrdiff_t>(held(y, size[1], wave_.address_v)) * size[0] + held(x, size[0], wave_.address_u)]);
    };
    const double scale = along_x ? size[0] / (2.0 * half[0]) : size[1] / (2.0 * half[1]);
    Range r{1e30, -1e30};
    for (int y = first[1]; y <= last[1] + (along_x ? 1 : 0); ++y) {
      for (int x = first[0]; x <= last[0] + (along_x ? 0 : 1); ++x) {
        const double slope = (along_x ? value(x + 1, y) - value(x, y) : value(x, y + 1) - value(x, y)) * scale;
        r.low = std::min(r.low, slope);
        r.high = std::max(r.high, slope);
      }
    }
    // At the clamped edge, and between the roundings of two filters, the slope may also be zero.
    return {std::min(r.low, 0.0), std::max(r.high, 0.0)};
  }

  const SurfaceHitUniforms& u_;
  const Texture& wave_;
  Vector origin_, d_;
  double lowest_;  ///< no filtered height is below this
};

}  // namespace rainref::puddle
