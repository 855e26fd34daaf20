#include "compositor/shading.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "compositor/interface.h"
#include "math/real64.h"

namespace rainref::compositor {
namespace {

/// A ray on its way, and what it is to its pixel.
struct Path {
  Ray ray;
  double length = 1;      // of the direction
  Vec weight{1, 1, 1};    // share of its radiance in the pixel
  std::uint32_t pixel = 0;
  std::uint32_t left = Hit::none;  // the surface where it began
  bool left_outside = false;       // and on which side of it
  bool is_straight = true;         // refracted and never reflected so far
  const Medium* medium = nullptr;
  double travelled = 0, blur = 0;
};

/// Where a path's ray met a surface.
struct Meeting {
  Hit hit;
  Vec normal{0, 0, 0};  // geometric
  bool from_outside = false;
};

double largest(const Vec& a) { return std::max(a.x, std::max(a.y, a.z)); }

/// The spacing of numbers as large as the ray's origin, along the ray.
double resolution(const Path& p) {
  const Vec& o = p.ray.origin;
  return 0x1p-52 * std::max({std::abs(o.x), std::abs(o.y), std::abs(o.z), 1e-3}) / p.length;
}

Vec transmitted(const Medium& m, double path) {
  const auto share = [&](double extinction) { return exp_real(Real64(-(extinction * path))).v; };
  if (m.extinction.x == m.extinction.y && m.extinction.y == m.extinction.z) {
    const double t = share(m.extinction.x);
    return {t, t, t};
  }
  return {share(m.extinction.x), share(m.extinction.y), share(m.extinction.z)};
}

class Generations {
 public:
  Generations(const Scene& scene, const ShadingOptions& options, std::span<const Ray> rays, std::span<Seen> seen)
      : scene_(scene), options_(options), seen_(seen) {
    paths_.resize(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      Path& p = paths_[i];
      p.ray = rays[i];
      p.length = std::sqrt(dot(p.ray.direction, p.ray.direction));
      p.pixel = static_cast<std::uint32_t>(i);
      p.medium = &scene.eye();
    }
  }

  void run() {
    for (int depth = 1; !paths_.empty(); ++depth) {
      trace();
      next_.clear();
      sights_.clear();
      terms_.clear();
      finish_opaque();
      for (std::size_t i = 0; i < paths_.size(); ++i) follow(i, depth);
      gather();
      paths_.swap(next_);
    }
  }

 private:
  const Scene& scene_;
  const ShadingOptions& options_;
  std::span<Seen> seen_;
  std::vector<Path> paths_, next_;
  std::vector<Meeting> met_;

  // What is added to pixels in this generation, in the order of the paths: a weight times a constant or a sight.
  struct Term {
    std::uint32_t pixel;
    Vec weight;
    bool is_sight;  // else `weight` is the radiance itself
  };
  std::vector<Term> terms_;
  std::vector<Sight> sights_;
  std::vector<Vec> arrived_;

  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::vector<std::uint32_t> again_;
  std::vector<Place> places_;
  std::vector<Finish> finishes_;
  std::vector<std::uint32_t> place_of_;  // by path
  std::vector<std::uint32_t> order_;

  void meet(std::size_t i, const Hit& hit) {
    Meeting& m = met_[i];
    m.hit = hit;
    if (!hit.is_surface()) return;
    m.normal = scene_.tracer().surface(hit.surface).normal(paths_[i].ray, hit);
    m.from_outside = dot(paths_[i].ray.direction, m.normal) < 0;
  }
  bool contradicts(std::size_t i) const {
    return met_[i].hit.is_surface() && met_[i].hit.surface == paths_[i].left && met_[i].from_outside != paths_[i].left_outside;
  }

  void trace() {
    const std::size_t n = paths_.size();
    rays_.resize(n);
    hits_.assign(n, Hit{});
    met_.resize(n);
    for (std::size_t i = 0; i < n; ++i) rays_[i] = paths_[i].ray;
    scene_.tracer().first_hits(rays_, hits_);
    again_.clear();
    for (std::size_t i = 0; i < n; ++i) {
      meet(i, hits_[i]);
      if (contradicts(i)) again_.push_back(static_cast<std::uint32_t>(i));
    }
    // Behind a contradicted hit by the resolution of the origin, doubled from one such hit to the next.
    double step = 1;
    for (int round = 0; round < 40 && !again_.empty(); ++round, step *= 2) {
      rays_.resize(again_.size());
      hits_.assign(again_.size(), Hit{});
      for (std::size_t k = 0; k < again_.size(); ++k) {
        Path& p = paths_[again_[k]];
        p.ray.nearest = met_[again_[k]].hit.t + step * resolution(p);
        rays_[k] = p.ray;
      }
      scene_.tracer().first_hits(rays_, hits_);
      std::size_t left = 0;
      for (std::size_t k = 0; k < again_.size(); ++k) {
        meet(again_[k], hits_[k]);
        if (contradicts(again_[k])) again_[left++] = again_[k];
      }
      again_.resize(left);
    }
  }

  Place place(std::size_t i) const {
    const Path& p = paths_[i];
    const Meeting& m = met_[i];
    Place out;
    out.point = p.ray.at(m.hit.t);
    out.direction = p.length == 1 ? p.ray.direction : p.ray.direction / p.length;
    out.normal = m.normal;
    out.distance = p.travelled + m.hit.t * p.length;
    out.hit = m.hit;
    return out;
  }

  // The finish of every opaque hit, surface by surface, because a finish takes many places at once.
  void finish_opaque() {
    order_.clear();
    place_of_.assign(paths_.size(), 0);
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      if (met_[i].hit.is_surface() && scene_.material(met_[i].hit.surface).opaque) order_.push_back(static_cast<std::uint32_t>(i));
    }
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) { return met_[a].hit.surface < met_[b].hit.surface; });
    places_.resize(order_.size());
    finishes_.assign(order_.size(), Finish{});
    for (std::size_t k = 0; k < order_.size(); ++k) {
      places_[k] = place(order_[k]);
      place_of_[order_[k]] = static_cast<std::uint32_t>(k);
    }
    for (std::size_t begin = 0; begin < order_.size();) {
      const std::uint32_t surface = places_[begin].hit.surface;
      std::size_t end = begin + 1;
      while (end < order_.size() && places_[end].hit.surface == surface) ++end;
      scene_.material(surface).opaque->finish(std::span(places_).subspan(begin, end - begin), std::span(finishes_).subspan(begin, end - begin));
      begin = end;
    }
  }

  void see(const Path& p, const Vec& weight, const Vec& origin, const Vec& direction, double blur) {
    terms_.push_back({p.pixel, weight, true});
    sights_.push_back({origin, direction, blur});
  }

  // Adds what path i brings, and makes the paths that go on from it.
  void follow(std::size_t i, int depth) {
    const Path& p = paths_[i];
    const Meeting& m = met_[i];
    Seen& seen = seen_[p.pixel];
    if (depth == 1) seen.hit = m.hit;
    if (!m.hit.is_surface()) return see(p, p.weight, p.ray.origin, p.length == 1 ? p.ray.direction : p.ray.direction / p.length, p.blur);

    const Material& material = scene_.material(m.hit.surface);
    const Place at = material.opaque ? places_[place_of_[i]] : place(i);
    const double path = at.distance - p.travelled;
    Vec weight = p.weight;
    if (largest(p.medium->extinction) > 0) {
      const Vec t = transmitted(*p.medium, path);
      terms_.push_back({p.pixel, weight * (Vec(1, 1, 1) - t) * p.medium->glow, false});
      weight *= t;
    }
    if (p.is_straight && p.medium->is_film) seen.film += path;
    if (depth == 1) seen.is_masked = material.is_masked;

    Path child;
    child.pixel = p.pixel;
    child.left = m.hit.surface;
    child.travelled = at.distance;
    child.ray.origin = at.point;
    const auto go_on = [&](const Vec& direction, const Vec& share, bool outside, const Medium& medium, double blur, bool is_straight) {
      if (!(largest(share) > 0)) return;
      if (depth >= options_.depth || largest(share) < options_.least_weight) return see(p, share, at.point, direction, blur);
      child.ray.direction = direction;
      child.weight = share;
      child.left_outside = outside;
      child.medium = &medium;
      child.blur = blur;
      child.is_straight = is_straight;
      next_.push_back(child);
    };

    const Vec facing = m.from_outside ? m.normal : -m.normal;
    if (material.opaque) {
      const Finish& f = finishes_[place_of_[i]];
      terms_.push_back({p.pixel, weight * f.radiance, false});
      const bool mirrors = largest(f.mirror) > 0;
      if (depth == 1) seen.normal = mirrors ? f.mirror_normal : facing;
      if (!mirrors) return;
      Vec mirrored = at.direction - 2 * dot(at.direction, f.mirror_normal) * f.mirror_normal;
      // A bump's normal may turn the ray into the surface that it mirrors: it is turned out again.
      const double out = dot(mirrored, facing);
      if (out < 0) mirrored -= 2 * out * facing;
      return go_on(mirrored, weight * f.mirror, m.from_outside, *p.medium, f.blur, false);
    }

    const Medium& here = m.from_outside ? material.outside : material.inside;
    const Medium& beyond = m.from_outside ? material.inside : material.outside;
    Vec normal = facing;
    Split rays;
    bool is_smooth = false;
    if (material.smooth_normal) {
      normal = material.smooth_normal(at);
      if (!m.from_outside) normal = -normal;
      if (dot(at.direction, normal) < 0) {
        rays = split(at.direction, normal, here.ior, beyond.ior);
        is_smooth = dot(rays.reflected, facing) > 0 && !(dot(rays.refracted, facing) > 0);
      }
    }
    if (!is_smooth) {
      normal = facing;
      rays = split(at.direction, facing, here.ior, beyond.ior);
    }
    if (depth == 1) seen.normal = normal;
    go_on(rays.reflected, rays.reflectance * weight, m.from_outside, here, p.blur, false);
    if (rays.reflectance < 1) go_on(rays.refracted, (1 - rays.reflectance) * weight, !m.from_outside, beyond, p.blur, p.is_straight);
  }

  void gather() {
    arrived_.resize(sights_.size());
    if (!sights_.empty()) scene_.environment().radiance(sights_, arrived_);
    std::size_t sight = 0;
    for (const Term& term : terms_) seen_[term.pixel].radiance += term.is_sight ? term.weight * arrived_[sight++] : term.weight;
  }
};

}  // namespace

void shade(const Scene& scene, const ShadingOptions& options, std::span<const Ray> rays, std::span<Seen> seen) {
  std::fill(seen.begin(), seen.end(), Seen{});
  Generations(scene, options, rays, seen).run();
}

}  // namespace rainref::compositor
