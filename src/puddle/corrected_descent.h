// The possible ends of the march of surface_hit, corrected.
//
// It stops at the first visited point where the gap is under epsilon, and does not step over a crossing. The stretches of the ray where it
// may stop are the alternatives; within one, the pass's own text makes the last step. If the ray meets the plane, intervals of t and d do
// not know that their errors cancel, so that point has its own enclosure. The number of march steps is not checked, because it depends on
// every decision on the way.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "puddle/descent_members.h"
#include "puddle/scalar.h"

namespace rainref::puddle {

/// The arguments must outlive it.
class CorrectedDescent {
  using Enclosure = enclosed::Enclosure;
  using Vector = scalar::Vec3<Enclosure>;
  using Hit = scalar::SurfaceHit<Enclosure>;

 public:
  CorrectedDescent(const SurfaceHitUniforms& u, const Texture& wave)
      : u_(u), wave_(fixed_texture<Address::clamp, Address::clamp, 1>(wave)) {}

  Hit hit(const Texture& bounds, int px, int py, const float* port) const {
    const scalar::Descent<Enclosure> ray = scalar::descent<Enclosure>(u_, px, py);
    if (!ray.down) return scalar::surface_missed(ray);
    const scalar::Stretch<Enclosure> over = scalar::stretch(u_, ray, bounds_of(bounds, ray));
    if (!over.enters) return on_plane(ray, over, ray.t_plane, px, py);
    const std::vector<Landing> landings = landings_of(ray, over);
    if (landings.empty() || landings.size() > static_cast<std::size_t>(enclosed::PathEnumeration::max_runs)) {
      enclosed::give_up();
      return Hit();
    }
    const Landing& chosen =
        landings[landings.size() == 1 ? 0 : static_cast<std::size_t>(enclosed::choose(static_cast<int>(landings.size())))];
    if (chosen.leaves) return on_plane(ray, over, chosen.t, px, py);
    return hit_near(ray, over, port, chosen, beside_reference(bounds, px, py));
  }
  /// Results between some that every device may give: a part of the result of hit_beside_reference().
  Hit between_members(const Texture& bounds, int px, int py) const { return DescentMembers(u_, wave_, bounds, px, py).box(); }
  /// The ends of a march that ends as the reference's does, or within some roundings of it: a part of the result of hit().
  std::optional<Hit> hit_beside_reference(const Texture& bounds, int px, int py, const float* port) const {
    const scalar::Descent<Enclosure> ray = scalar::descent<Enclosure>(u_, px, py);
    if (!ray.down) return scalar::surface_missed(ray);
    const scalar::Stretch<Enclosure> over = scalar::stretch(u_, ray, bounds_of(bounds, ray));
    if (!over.enters) return on_plane(ray, over, ray.t_plane, px, py);
    const std::optional<Enclosure> t = beside_reference(bounds, px, py);
    if (!t) return on_plane(ray, over, leaving(ray, over), px, py);
    bool is_settled = true;
    const std::optional<Hit> end = end_near(ray, over, port, *t, is_settled);
    return is_settled ? end : std::nullopt;
  }

 private:
  /// Position of the port's hit along the ray: the interval of t that any coordinate allows.
  static Enclosure along(const Vector& origin, const Vector& d, const float* port) {
    double low = -1e30, high = 1e30;
    const Enclosure o[3] = {origin.x, origin.y, origin.z}, dir[3] = {d.x, d.y, d.z};
    for (int k = 0; k < 3; ++k) {
      if (dir[k].lo <= 0 && dir[k].hi >= 0) continue;
      const double error = 0x1p-22 * (std::abs(static_cast<double>(port[k])) + std::abs(static_cast<double>(o[k].hi)));
      const double n[2] = {port[k] - error - o[k].hi, port[k] + error - o[k].lo};
      const double q[4] = {n[0] / dir[k].lo, n[0] / dir[k].hi, n[1] / dir[k].lo, n[1] / dir[k].hi};
      low = std::max(low, *std::min_element(q, q + 4));
      high = std::min(high, *std::max_element(q, q + 4));
    }
    if (!(low <= high)) return Enclosure::vacuous();
    return enclosed::rounded_outward(low, high);
  }
  /// The interval around the reference's stop on the water; nothing if its ray meets the plane.
  std::optional<Enclosure> beside_reference(const Texture& bounds, int px, int py) const {
    const std::optional<double> t = DescentMembers(u_, wave_, bounds, px, py).stop();
    if (!t) return std::nullopt;
    return enclosed::rounded_outward(*t * (1 - DescentMembers::roundings), *t * (1 + DescentMembers::roundings));
  }
  /// Position of a ray that has passed the water.
  static Enclosure leaving(const scalar::Descent<Enclosure>& ray, const scalar::Stretch<Enclosure>& over) {
    return Enclosure(over.t_out.hi, std::max(over.t_out.hi, ray.t_plane.hi) + 1);
  }
  /// The hit of a ray that meets the plane: without a march, or after a march to t.
  Hit on_plane(const scalar::Descent<Enclosure>& ray, const scalar::Stretch<Enclosure>& over, Enclosure t, int px, int py) const {
    const Enclosure zero(0.0f);
    Hit out = scalar::landed(u_, wave_, ray, over, {t, zero, zero, zero});
    out.position = common_part(out.position, plane_point(px, py, ray));
    return out;
  }

  /// The point where the ray meets y = 0: o + (o_y / f) d with f = -d_y. So o_y / f d_y is -o_y except for the roundings of a division and
  /// two products. d_x / f = v_x / -v_y for v the ray before normalization, except for the roundings of two components.
  Vector plane_point(int px, int py, const scalar::Descent<Enclosure>& ray) const {
    const enclosed::Profile& p = enclosed::profile();
    const double unit = p.basic == enclosed::BasicRounding::nearest ? 0x1p-24 : 0x1p-23;
    const double division = std::max(unit, p.division.ulp * 0x1p-23 + p.division.relative), many = 1 + 1e-6;
    const double of_t = (division + 2 * unit) * many, of_ratio = (division + 2 * unit + 2 * std::max(unit, division)) * many;
    const Vector v = scalar::to_image_plane(u_.camera, Enclosure::index(px), Enclosure(static_cast<float>(py)));
    const double height = ray.origin.y.lo;
    // o + height * ratio (1 + e), |e| <= error.
    const auto coordinate = [&](Enclosure o, double low, double high, double error) {
      const double a = height * low, b = height * high, slack = 0x1p-48 * (std::abs(a) + std::abs(b) + o.magnitude()) + 0x1p-120;
      const double from = o.lo + (a - error * std::abs(a) - slack), to = o.hi + (b + error * std::abs(b) + slack);
      return p.basic == enclosed::BasicRounding::nearest ? Enclosure(static_cast<float>(from), static_cast<float>(to))
                                                         : enclosed::rounded_outward(from, to);
    };
    const auto sideways = [&](Enclosure o, Enclosure side) {
      const double q[4] = {-side.lo / static_cast<double>(v.y.lo), -side.lo / static_cast<double>(v.y.hi),
                           -side.hi / static_cast<double>(v.y.lo), -side.hi / static_cast<double>(v.y.hi)};
      return coordinate(o, *std::min_element(q, q + 4), *std::max_element(q, q + 4), of_ratio);
    };
    if (!(v.y.hi < 0) || !(height >= 0)) return Vector(Enclosure::vacuous(), Enclosure::vacuous(), Enclosure::vacuous());
    return Vector(sideways(ray.origin.x, v.x), coordinate(ray.origin.y, -1, -1, of_t), sideways(ray.origin.z, v.z));
  }
  static Vector common_part(const Vector& a, const Vector& b) {
    const auto of = [](Enclosure x, Enclosure y) { return Enclosure(std::max(x.lo, y.lo), std::min(x.hi, y.hi)); };
    return Vector(of(a.x, b.x), of(a.y, b.y), of(a.z, b.z));
  }

  /// A stretch of the ray in which the march may stop.
  struct Landing {
    Enclosure t, above;
    bool leaves;  ///< past the water: the ray meets the plane
  };

  /// Top and slope, from every texel of `bounds` that may be read and from the uniforms if they may apply instead.
  scalar::WaterBounds<Enclosure> bounds_of(const Texture& bounds, const scalar::Descent<Enclosure>& ray) const {
    enclosed::PathEnumeration paths;
    scalar::WaterBounds<Enclosure> all{Enclosure(u_.surface_top), Enclosure(u_.surface_slope)};
    bool first = true;
    const bool settled = paths.for_each_alternative([&] {
      const scalar::WaterBounds<Enclosure> one = scalar::water_bounds(u_, bounds, ray);
      all = first ? one : scalar::WaterBounds<Enclosure>{hull(all.top, one.top), hull(all.slope, one.slope)};
      first = false;
    });
    if (!settled) return {Enclosure(0.0f, u_.surface_top), Enclosure(0.0f, u_.surface_slope)};
    return all;
  }

  std::vector<Landing> landings_of(const scalar::Descent<Enclosure>& ray, const scalar::Stretch<Enclosure>& over) const {
    std::vector<Landing> found;
    // Steps of a quarter of a cell: within one the gap is nearly linear.
    const double run = std::max(1e-6, static_cast<double>(ray.run.hi));
    const double cell =
        1 / std::max(static_cast<double>(wave_.width[0]) * u_.inverse_size[0], static_cast<double>(wave_.height[0]) * u_.inverse_size[1]);
    const double begin = over.t_in.lo, end = over.t_out.hi;
    const double step = std::max({0.25 * cell / run, (end - begin) / 20000, 0x1p-20 * std::abs(end)});
    bool crossed = false;
    for (double t = begin; t < end && !crossed; t += step) {
      const Enclosure piece = enclosed::rounded_outward(t, std::min(t + step, end));
      const Enclosure gap = scalar::gap_above(u_, wave_, ray, piece);
      if (gap.is_vacuous()) return {};
      if (gap.lo < u_.epsilon) {
        // Once it is certainly under the water, no march gets further, except by the steps whose proof allows for rounding.
        const Enclosure after = scalar::gap_above(u_, wave_, ray, Enclosure(piece.hi));
        crossed = after.hi < -std::min(0.5 * u_.epsilon, 4 * enclosed::width_of(after) + 1e-5 * u_.surface_top);
        if (!found.empty() && found.back().t.hi >= piece.lo) {
          found.back().t = hull(found.back().t, piece);
          found.back().above = hull(found.back().above, gap);
        } else {
          found.push_back({piece, gap, false});
        }
      }
    }
    if (!crossed) found.push_back({leaving(ray, over), Enclosure(0.0f), true});
    for (Landing& l : found)
      if (!l.leaves) refine(ray, l);
    return found;
  }
  /// Cuts off the ends of a stretch where no march stops: too high above, or certainly under the water.
  void refine(const scalar::Descent<Enclosure>& ray, Landing& l) const {
    constexpr int pieces = 32;
    const double begin = l.t.lo, step = enclosed::width_of(l.t) / pieces;
    double low = l.t.hi, high = l.t.lo;
    Enclosure above = Enclosure::vacuous();
    for (int k = 0; k < pieces; ++k) {
      const Enclosure piece = enclosed::rounded_outward(begin + k * step, begin + (k + 1) * step),
                      gap = scalar::gap_above(u_, wave_, ray, piece);
      if (gap.lo >= u_.epsilon || gap.hi < -0.5 * u_.epsilon) continue;
      above = above.is_vacuous() ? gap : hull(above, gap);
      low = std::min(low, static_cast<double>(piece.lo));
      high = std::max(high, static_cast<double>(piece.hi));
    }
    if (low > high) return;  // the coarse pieces were too wide, nothing remains
    l.t = enclosed::rounded_outward(low, high);
    l.above = above;
  }
  /// The hit of a march that stopped in this stretch. It covers those pieces whose last step may end at the port's position, each one
  /// separately, because t and the gap depend on each other. If no piece does, it covers the whole stretch.
  Hit hit_near(const scalar::Descent<Enclosure>& ray, const scalar::Stretch<Enclosure>& over, const float* port, const Landing& stretch,
               const std::optional<Enclosure>& reference) const {
    const Enclosure zero(0.0f), own = along(ray.origin, ray.d, port);
    const double longest = 2 * static_cast<double>(over.stride.hi) * std::max(0.0f, std::min(stretch.above.hi, u_.epsilon));
    double low = stretch.t.lo, high = stretch.t.hi;
    if (!own.is_vacuous()) {
      low = std::max<double>(low, own.lo - longest);
      high = std::min<double>(high, own.hi);
    }
    bool is_settled = true;
    const auto end_of = [&](const Enclosure& t) { return end_near(ray, over, port, t, is_settled); };
    const auto piece = [&](int k, int pieces) {
      const double step = (high - low) / pieces;
      return enclosed::rounded_outward(low + k * step, low + (k + 1) * step);
    };
    // First the outermost coarse pieces that may contain the port's end, then all fine pieces between them.
    constexpr int coarse = 16, fine = 48;
    std::optional<Hit> all;
    if (low <= high) {
      int first = 0, last = coarse - 1;
      while (first < coarse && !end_of(piece(first, coarse))) ++first;
      while (last > first && !end_of(piece(last, coarse))) --last;
      if (first < coarse && is_settled) {
        const double from = piece(first, coarse).lo;
        high = piece(last, coarse).hi;
        low = from;
        for (int k = 0; k < fine && is_settled; ++k)
          if (const std::optional<Hit> end = end_of(piece(k, fine))) all = all ? hull_of(*all, *end) : *end;
      }
    }
    const Hit ends =
        all && is_settled ? *all : scalar::landed(u_, wave_, ray, over, {stretch.t, min(stretch.above, stopping()), zero, zero});
    // The result of hit_beside_reference() is a part of this.
    if (!reference || reference->hi < stretch.t.lo || stretch.t.hi < reference->lo) return ends;
    const std::optional<Hit> beside = end_of(*reference);
    return beside ? hull_of(ends, *beside) : ends;
  }
  /// The possible ends of a march that stopped at t, if they contain the port's end; otherwise nothing. Clears `is_settled` if too much is
  /// open.
  std::optional<Hit> end_near(const scalar::Descent<Enclosure>& ray, const scalar::Stretch<Enclosure>& over, const float* port,
                              const Enclosure& t, bool& is_settled) const {
    std::optional<Hit> out;
    const Enclosure gap = scalar::gap_above(u_, wave_, ray, t), zero(0.0f);
    if (gap.lo >= u_.epsilon) return out;
    const scalar::DescentState<Enclosure> part{t, min(gap, stopping()), zero, zero};
    enclosed::PathEnumeration paths;
    is_settled &= paths.for_each_alternative([&] {
      const Hit end = scalar::landed(u_, wave_, ray, over, part);
      if (!(end.position.x.contains(port[0]) && end.position.y.contains(port[1]) && end.position.z.contains(port[2]))) return;
      out = out ? hull_of(*out, end) : end;
    });
    return out;
  }
  static Hit hull_of(Hit a, const Hit& b) {
    const auto add = [](Vector& to, const Vector& v) { to = Vector(hull(to.x, v.x), hull(to.y, v.y), hull(to.z, v.z)); };
    add(a.position, b.position);
    add(a.normal, b.normal);
    return a;
  }

  /// The largest gap at which a march stops.
  Enclosure stopping() const { return Enclosure(std::nextafterf(u_.epsilon, 0.0f)); }

  const SurfaceHitUniforms& u_;
  FixedTexture<Address::clamp, Address::clamp, 1> wave_;
};

}  // namespace rainref::puddle
