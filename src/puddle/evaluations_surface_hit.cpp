// surface_hit as conformance takes it. A march repeats rounding errors until an interval says nothing, so that its end
// is enclosed instead, by what every march must satisfy.
//
// as-published: t' = t + f(t) along the ray, f the distance to the box. An error e of t becomes |1 + f'| e: the two
// ends of the interval of t are marched, and drawn apart by what f' may be below -1. Each round in which f may be under
// epsilon is a possible end; which of them is the port's, its own count of rounds says. A ray that has passed the box
// for good misses, however uncertain its t has become. corrected: the march stops at the first place that it visits
// where the gap is under epsilon, and passes no crossing. The stretches of the ray where that may be are the
// alternatives; within one the pass's own text makes the last step. Where the ray meets the plane, intervals of t and d
// lose that their errors cancel: that place has an enclosure of its own. March steps of corrected are free: they depend
// on every decision on the way.
#include <algorithm>
#include <cmath>
#include <optional>

#include "capture/bound_texture.h"
#include "math/whole.h"
#include "puddle/scalar.h"
#include "puddle/info.h"

namespace rainref::puddle {
namespace {

using capture::BoundTexture;
using capture::PassCase;
using enclosed::Enclosure;
using Vector = scalar::Vec3<Enclosure>;

struct MarchedPass {
  int width, height, values = 8;
  SurfaceHitUniforms uniforms;
  bool corrected;
  BoundTexture wave, bounds;
  float lowest;  ///< texel of the wave

  template <class N>
  void operator()(int x, int y, N* out) const {
    write(corrected ? scalar::surface_hit_corrected<N>(uniforms, wave.view(), bounds.view(), x, y)
                    : scalar::surface_hit_as_published<N>(uniforms, wave.view(), x, y),
          out);
  }
  template <class N>
  static void write(const scalar::SurfaceHit<N>& hit, N* out) {
    const N all[8] = {hit.position.x, hit.position.y, hit.position.z, hit.iterations, hit.normal.x, hit.normal.y, hit.normal.z, hit.flag};
    std::copy(all, all + 8, out);
  }
};

/// An interval that holds x for sure: the ends rounded outward from double.
Enclosure around(double low, double high) {
  const auto beside = [](double x, float toward) {
    const float f = static_cast<float>(x);
    const bool outside = toward < 0 ? f <= x : f >= x;
    return outside ? f : std::nextafterf(f, toward);
  };
  return Enclosure(beside(low, -INFINITY), beside(high, INFINITY));
}
double width_of(Enclosure a) { return static_cast<double>(a.hi) - a.lo; }

/// Where the port's position lies along the ray: the interval of t that any coordinate allows.
Enclosure along(const Vector& origin, const Vector& d, const float* port) {
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
  return around(low, high);
}

// ---- as published --------------------------------------------------------------------------------------------------
class PublishedMarch {
 public:
  PublishedMarch(const SurfaceHitUniforms& u, const Texture& wave, float lowest, int px, int py)
      : u_(u),
        wave_(wave),
        origin_(u.camera.position),
        d_(scalar::camera_ray(u.camera, Enclosure::index(px), Enclosure(static_cast<float>(py)))),
        lowest_(lowest - 1e-5 * std::max(1.0f, -lowest)) {}

  /// The ends that the march may have; empty: more than a port can be held to.
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
      if (may_stop) found.push_back({around(low, high), round, true});
      if (must_stop) return found;
      if (f.lo >= 1000) {
        found.push_back({Enclosure(), limit - 1, false});
        return found;
      }
      // g(t) = t + f(t) falls by at most `back` between low and high.
      const double back = std::max(0.0, -1 - steepest_fall(low, high, off)) * (high - low);
      // A march that goes on has seen epsilon or more.
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
    // The normal is taken at the port's own position, which is stored without rounding.
    const bool own = out.position.x.contains(port[0]) && out.position.y.contains(port[1]) && out.position.z.contains(port[2]);
    out.normal = scalar::normal_as_published(u_, wave_, own ? Vector(port[0], port[1], port[2]) : out.position);
    return out;
  }

 private:
  /// By how much rounding in each step may have moved a coordinate off the ray: each sum by an ULP, or half of one, of
  /// a place between the eye and t, each product by that of its step; the steps add up to t.
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
      return around(o.lo + *std::min_element(p, p + 4) - off, o.hi + *std::max_element(p, p + 4) + off);
    };
    return Vector(coordinate(origin_.x, d_.x), coordinate(origin_.y, d_.y), coordinate(origin_.z, d_.z));
  }
  Enclosure distance(double low, double high, double off) const { return scalar::scene_distance(u_, wave_, point(low, high, off)); }

  /// Whether f stays at epsilon or more from t = low on: beside a face of the box and moving away from it.
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

  /// A lower bound of f' on [low, high]. Over the box f is the gap to the displaced top, |y + h(x, z)| - b_y; beside it
  /// a length of three parts, whose slope is bounded by theirs together.
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
    // Under the clamp at the edge and between the two filters' roundings the slope may also be none.
    return {std::min(r.low, 0.0), std::max(r.high, 0.0)};
  }

  const SurfaceHitUniforms& u_;
  const Texture& wave_;
  Vector origin_, d_;
  double lowest_;  ///< no filtered height is below this
};

// ---- corrected -----------------------------------------------------------------------------------------------------
class CorrectedDescent {
 public:
  CorrectedDescent(const SurfaceHitUniforms& u, const Texture& wave)
      : u_(u), wave_(fixed_texture<Address::clamp, Address::clamp, 1>(wave)) {}

  scalar::SurfaceHit<Enclosure> hit(const Texture& bounds, int px, int py, const float* port) const {
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
  /// The ends of a march that ends as the reference's does, or within some roundings of it: a part of what hit() gives.
  std::optional<scalar::SurfaceHit<Enclosure>> hit_beside_reference(const Texture& bounds, int px, int py, const float* port) const {
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
  using Hit = scalar::SurfaceHit<Enclosure>;

  /// Around the place where the reference's march stops on the water; nothing where it meets the plane. Its steps add up to t, each
  /// rounded.
  std::optional<Enclosure> beside_reference(const Texture& bounds, int px, int py) const {
    using Single = scalar::Scalar<float>;
    const scalar::Descent<Single> ray = scalar::descent<Single>(u_, px, py);
    const scalar::Stretch<Single> over = scalar::stretch(u_, ray, scalar::water_bounds(u_, bounds, ray));
    if (!over.enters) return std::nullopt;
    const double t = scalar::marched(u_, wave_, ray, over).t.v;
    if (!(t < over.t_out.v)) return std::nullopt;
    constexpr double roundings = 16 * 0x1p-23;
    return around(t * (1 - roundings), t * (1 + roundings));
  }
  /// Where a ray is that has passed the water.
  static Enclosure leaving(const scalar::Descent<Enclosure>& ray, const scalar::Stretch<Enclosure>& over) {
    return Enclosure(over.t_out.hi, std::max(over.t_out.hi, ray.t_plane.hi) + 1);
  }
  /// The hit of a ray that meets the plane: no march, or one that has come to t.
  Hit on_plane(const scalar::Descent<Enclosure>& ray, const scalar::Stretch<Enclosure>& over, Enclosure t, int px, int py) const {
    const Enclosure zero(0.0f);
    Hit out = scalar::landed(u_, wave_, ray, over, {t, zero, zero, zero});
    out.position = common_part(out.position, plane_point(px, py, ray));
    return out;
  }

  /// Where the ray meets y = 0: o + (o_y / f) d with f = -d_y. So o_y / f d_y is -o_y but for the roundings of a
  /// division and two products, and d_x / f = v_x / -v_y for v the ray before it was normalized, but for those of two
  /// components.
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
      return p.basic == enclosed::BasicRounding::nearest ? Enclosure(static_cast<float>(from), static_cast<float>(to)) : around(from, to);
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

  /// A stretch of the ray where the march may stop.
  struct Landing {
    Enclosure t, above;
    bool leaves;  ///< past the water: the ray meets the plane
  };

  /// Top and slope from every texel of `bounds` that may be read, and from the uniforms where they may hold instead.
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
      const Enclosure piece = around(t, std::min(t + step, end));
      const Enclosure gap = scalar::gap_above(u_, wave_, ray, piece);
      if (gap.is_vacuous()) return {};
      if (gap.lo < u_.epsilon) {
        // Once under the water for sure, no march gets further, but by the steps whose proof allows for rounding.
        const Enclosure after = scalar::gap_above(u_, wave_, ray, Enclosure(piece.hi));
        crossed = after.hi < -std::min(0.5 * u_.epsilon, 4 * width_of(after) + 1e-5 * u_.surface_top);
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
  /// Cuts off the ends of a stretch where no march stops: too high above, or surely under the water.
  void refine(const scalar::Descent<Enclosure>& ray, Landing& l) const {
    constexpr int pieces = 32;
    const double begin = l.t.lo, step = width_of(l.t) / pieces;
    double low = l.t.hi, high = l.t.lo;
    Enclosure above = Enclosure::vacuous();
    for (int k = 0; k < pieces; ++k) {
      const Enclosure piece = around(begin + k * step, begin + (k + 1) * step), gap = scalar::gap_above(u_, wave_, ray, piece);
      if (gap.lo >= u_.epsilon || gap.hi < -0.5 * u_.epsilon) continue;
      above = above.is_vacuous() ? gap : hull(above, gap);
      low = std::min(low, static_cast<double>(piece.lo));
      high = std::max(high, static_cast<double>(piece.hi));
    }
    if (low > high) return;  // what the coarse pieces saw was their own width
    l.t = around(low, high);
    l.above = above;
  }
  /// The hit of a march that stopped in this stretch: of those pieces whose last step may end where the port's did,
  /// each by itself, because t and the gap depend on each other. All of the stretch where no piece does.
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
      return around(low + k * step, low + (k + 1) * step);
    };
    // The outermost of coarse pieces where the port's end may lie; then all of the fine ones between them.
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
    // What hit_beside_reference() gives is a part of this.
    if (!reference || reference->hi < stretch.t.lo || stretch.t.hi < reference->lo) return ends;
    const std::optional<Hit> beside = end_of(*reference);
    return beside ? hull_of(ends, *beside) : ends;
  }
  /// What a march that stopped at t may end with, where the port's end is among it; nothing where it is not. Clears `is_settled` where too
  /// much of it is open.
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

class SurfaceHitModel : public capture::ModelOf<MarchedPass> {
 public:
  using ModelOf::ModelOf;
  bool needs_port() const override { return true; }
  std::optional<std::array<double, 2>> free_range(int v) const override {
    if (v != 3 || !pass().corrected) return std::nullopt;
    return std::array<double, 2>{0, static_cast<double>(pass().uniforms.max_steps)};
  }

  bool enclose_part(int x, int y, const float* port, Enclosure* out) const override {
    const MarchedPass& p = pass();
    if (!p.corrected) return false;
    const Texture wave = p.wave.view();
    const auto hit = CorrectedDescent(p.uniforms, wave).hit_beside_reference(p.bounds.view(), x, y, port);
    if (hit) MarchedPass::write(*hit, out);
    return hit.has_value();
  }
  void enclose(int x, int y, const float* port, Enclosure* out) const override {
    const MarchedPass& p = pass();
    // Under exact rules the march itself is the only result.
    if (enclosed::profile().reference) return p(x, y, out);
    const Texture wave = p.wave.view();
    if (p.corrected) return MarchedPass::write(CorrectedDescent(p.uniforms, wave).hit(p.bounds.view(), x, y, port), out);
    const PublishedMarch march(p.uniforms, wave, p.lowest, x, y);
    const std::vector<PublishedMarch::End> ends = march.ends();
    if (ends.empty()) return enclosed::give_up();
    MarchedPass::write(march.at(PublishedMarch::nearest(ends, port), port), out);
  }
};

}  // namespace

std::unique_ptr<capture::PassModel> bind_surface_hit(const PassCase& c) {
  MarchedPass p;
  const capture::CaseOutput* hit = c.output("hit");
  p.width = hit->array.width;
  p.height = hit->array.height;
  p.uniforms = capture::uniforms_of<SurfaceHitUniforms>(c);
  p.corrected = c.corrected();
  p.wave = BoundTexture(capture::image_input(c, "wave"), p.corrected ? 0 : 1, 1);
  const Texture wave = p.wave.view();
  p.lowest = *std::min_element(wave.texels, wave.texels + static_cast<std::ptrdiff_t>(wave.width[0]) * wave.height[0]);
  if (p.corrected) p.bounds = BoundTexture(capture::image_input(c, "bounds"));
  return std::make_unique<SurfaceHitModel>(std::move(p));
}

}  // namespace rainref::puddle
