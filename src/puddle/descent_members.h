// Results of surface_hit, corrected, that every device of a profile may give, computed in plain floats. Values between them are in the
// envelope (CorrectedDescent) too.
//
// For a march that stops on the water they are at the ends of the stretch that the envelope allows around the reference's stop. For a ray
// that meets the plane they come from simulated devices, which normalize its direction by each formula, divide with the largest error that
// the profile allows, and fuse or do not. All results come from the same decisions, so they lie in one alternative.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "math/directed.h"
#include "puddle/scalar.h"

namespace rainref::puddle {

class DescentMembers {
  using Single = scalar::Scalar<float>;
  using Vector = scalar::Vec3<Single>;
  using Enclosure = enclosed::Enclosure;

 public:
  /// Largest distance of a march's stop from the reference's, relative to the distance so far, because its steps add up with a rounding
  /// each.
  static constexpr double roundings = 16 * 0x1p-23;

  DescentMembers(const SurfaceHitUniforms& u, const FixedTexture<Address::clamp, Address::clamp, 1>& wave, const Texture& bounds, int px,
                 int py)
      : u_(u),
        wave_(wave),
        px_(px),
        py_(py),
        ray_(scalar::descent<Single>(u, px, py)),
        over_(scalar::stretch(u, ray_, scalar::water_bounds(u, bounds, ray_))) {}

  /// Where the reference's march stops on the water; nothing if its ray meets the plane.
  std::optional<double> stop() const {
    if (!over_.enters) return std::nullopt;
    const float t = scalar::marched(u_, wave_, ray_, over_).t.v;
    return t < over_.t_out.v ? std::optional<double>(t) : std::nullopt;
  }
  /// The smallest box around the members, under the current profile.
  scalar::SurfaceHit<Enclosure> box() {
    if (!ray_.down) {
      add(scalar::surface_missed(ray_));
    } else if (const std::optional<double> t = stop()) {
      add_stops(*t);
    } else {
      add_on_plane();
    }
    return box_;
  }

 private:
  void add_stops(double stop) {
    constexpr double within = 7.0 / 8 * roundings;  // leaves room for rounding to a float and for its neighbour
    scalar::Descent<Single> fused = ray_;
    const std::vector<Vector> views = directions(true);
    fused.d = views.back();
    fused.ds = fused.d.x * Single(u_.inverse_size[0]);
    fused.dr = fused.d.z * Single(u_.inverse_size[1]);
    fused.fall = max(-fused.d.y, Single(1e-4f));
    std::optional<bool> steps;
    for (const double t : {stop, stop * (1 - within), stop * (1 + within)}) {
      for (const scalar::Descent<Single>& ray : {ray_, fused}) {
        const Single at(static_cast<float>(t)), least(std::nextafterf(u_.epsilon, 0.0f));
        if (!(at < over_.t_out)) continue;
        const auto last = scalar::last_step(u_, wave_, ray, over_, true, at, min(scalar::gap_above(u_, wave_, ray, at), least));
        if (last.is_taken != steps.value_or(last.is_taken)) continue;  // another alternative
        steps = last.is_taken;
        for (const float beside : {last.t.v, enclosed::next_down(last.t.v), enclosed::next_up(last.t.v)})
          add_place(ray.d, Single(beside), last.normal);
        if (!enclosed::profile().contraction) break;
      }
    }
  }
  void add_on_plane() {
    const Vector up(Single(0.0f), Single(1.0f), Single(0.0f));
    for (const Vector& d : directions(enclosed::profile().contraction)) {
      for (const float quotient : quotients(1 / std::max<double>(-d.y.v, 1e-4f))) {
        const double t = static_cast<double>(ray_.origin.y.v) * quotient;
        add_place(d, Single(static_cast<float>(t)), up);
        if (enclosed::profile().basic != enclosed::BasicRounding::either) continue;
        for (const float beside : {enclosed::float_below(t), enclosed::float_above(t)}) add_place(d, Single(beside), up);
      }
    }
  }
  /// origin + t d, rounded twice, or once if that is allowed.
  void add_place(const Vector& d, Single t, const Vector& normal) {
    const Vector& o = ray_.origin;
    add(o + t * d, normal);
    if (enclosed::profile().contraction) add(Vector(fused(t, d.x, o.x), fused(t, d.y, o.y), fused(t, d.z, o.z)), normal);
  }
  /// Directions of the ray on different devices: the reference's first, one with fused operations last if that is allowed.
  std::vector<Vector> directions(bool fuses) const {
    std::vector<Vector> all{ray_.d};
    const CameraUniforms& c = u_.camera;
    const auto normalized = [&](const Vector& v) {
      const Single squared = scalar::dot(v, v), length = sqrt(squared), inverse(static_cast<float>(1 / __builtin_sqrt(squared.v)));
      all.emplace_back(v.x / length, v.y / length, v.z / length);
      all.push_back(inverse * v);
    };
    normalized(scalar::to_image_plane(c, Single::index(px_), Single(static_cast<float>(py_))));
    if (!fuses) return all;
    const Single sx = fused(Single(static_cast<float>(px_)) + Single(0.5f), Single(c.pixel_scale), Single(c.plane_left)),
                 sy = fused(Single(static_cast<float>(py_)) + Single(0.5f), Single(c.pixel_scale), Single(c.plane_bottom));
    const auto axis = [&](int k) { return fused(sy, Single(c.up[k]), fused(sx, Single(c.right[k]), Single(c.forward[k]))); };
    normalized(Vector(axis(0), axis(1), axis(2)));
    return all;
  }
  /// 1 / x with the largest errors that the current profile allows, and the nearest.
  static std::array<float, 3> quotients(double exact) {
    const double error = std::max(0.0, enclosed::profile().division.ulp) * enclosed::ulp_of(exact);
    const float nearest = static_cast<float>(exact);
    const auto toward = [&](double bound, bool is_above) {
      const float at = is_above ? enclosed::float_below(bound) : enclosed::float_above(bound);
      return is_above ? std::max(at, nearest) : std::min(at, nearest);
    };
    return {nearest, toward(exact - error, false), toward(exact + error, true)};
  }
  static Single fused(Single a, Single b, Single c) { return Single(enclosed::fused_sum(a.v, b.v, c.v)); }

  void add(const Vector& position, const Vector& normal) {
    scalar::SurfaceHit<Single> hit = scalar::surface_missed(ray_);
    hit.position = position;
    hit.normal = normal;
    hit.flag = Single(1.0f);
    add(hit);
  }
  void add(const scalar::SurfaceHit<Single>& hit) {
    const auto widen = [&](Enclosure& to, Single value) {
      to = is_empty_ ? Enclosure(value.v, value.v) : Enclosure(std::min(to.lo, value.v), std::max(to.hi, value.v));
    };
    const auto widen3 = [&](scalar::Vec3<Enclosure>& to, const Vector& value) {
      widen(to.x, value.x);
      widen(to.y, value.y);
      widen(to.z, value.z);
    };
    widen3(box_.position, hit.position);
    widen3(box_.normal, hit.normal);
    widen(box_.iterations, hit.iterations);
    widen(box_.flag, hit.flag);
    is_empty_ = false;
  }

  const SurfaceHitUniforms& u_;
  FixedTexture<Address::clamp, Address::clamp, 1> wave_;
  int px_, py_;
  scalar::Descent<Single> ray_;
  scalar::Stretch<Single> over_;
  scalar::SurfaceHit<Enclosure> box_;
  bool is_empty_ = true;
};

}  // namespace rainref::puddle
