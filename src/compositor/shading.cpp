#include "compositor/shading.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "compositor/interface.h"
#include "compositor/shading_kernels.h"

namespace rainref::compositor {
namespace {

/// What a ray on its way is to its pixel.
struct Path {
  double length = 1;      // of the ray's direction
  Vec weight{1, 1, 1};    // share of its radiance in the pixel
  std::uint32_t pixel = 0;
  std::uint32_t left = Hit::none;  // the surface where it began
  bool left_outside = false;       // and on which side of it
  bool is_straight = true;         // refracted and never reflected so far
  const Medium* medium = nullptr;
  double travelled = 0, blur = 0;
};

/// The geometric normal where a ray met a surface, and from which side it came.
struct Side {
  Vec normal{0, 0, 0};
  bool is_outside = false;
};

/// What is added to a pixel: a radiance, or a weight of what arrives along the next sight.
struct Term {
  std::uint32_t pixel;
  bool is_sight;
  Vec weight;
};

/// Rays with what goes with each.
struct Rays {
  std::vector<Ray> rays;
  std::vector<Path> paths;
  void clear() {
    rays.clear();
    paths.clear();
  }
};

/// Room for the rays of one call, kept by each thread for its next one.
struct Room {
  Rays now, next;
  std::vector<Hit> hits;
  std::vector<Side> sides;
  std::vector<std::uint32_t> again;
  std::vector<Ray> rays_again;
  std::vector<Hit> hits_again;
  std::vector<std::vector<std::uint32_t>> of_surface;  // opaque hits, surface by surface, because a finish takes many places at once
  std::vector<Place> places;
  std::vector<Finish> finishes;
  std::vector<std::uint32_t> place_of;  // by path
  std::vector<Term> terms;
  std::vector<Sight> sights;
  std::vector<Vec> arrived;
  std::vector<double> transmitted;  // of the paths whose media absorb: one share, or three where colours differ
};

double largest(const Vec& a) { return std::max(a.x, std::max(a.y, a.z)); }

/// The spacing of numbers as large as the ray's origin, along the ray.
double resolution(const Vec& origin, double length) {
  return 0x1p-52 * std::max({std::abs(origin.x), std::abs(origin.y), std::abs(origin.z), 1e-3}) / length;
}

class Generations {
 public:
  Generations(const Scene& scene, const ShadingOptions& options, std::span<const Ray> rays, std::span<Seen> seen, Room& room)
      : scene_(scene), options_(options), seen_(seen), room_(room), now_(room.now), next_(room.next) {
    now_.rays.assign(rays.begin(), rays.end());
    now_.paths.resize(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      Path& p = now_.paths[i] = Path{};
      p.length = std::sqrt(dot(rays[i].direction, rays[i].direction));
      p.pixel = static_cast<std::uint32_t>(i);
      p.medium = &scene.eye();
    }
    if (room.of_surface.size() < scene.surfaces()) room.of_surface.resize(scene.surfaces());
  }

  void run() {
    for (int depth = 1; !now_.paths.empty(); ++depth) {
      trace();
      next_.clear();
      room_.sights.clear();
      room_.terms.clear();
      finish_opaque();
      absorb();
      share_ = 0;
      for (std::size_t i = 0; i < now_.paths.size(); ++i) follow(i, depth);
      gather();
      std::swap(now_, next_);
    }
  }

 private:
  const Scene& scene_;
  const ShadingOptions& options_;
  std::span<Seen> seen_;
  Room& room_;
  Rays &now_, &next_;
  std::size_t share_ = 0;  // of room_.transmitted, the next one

  void find_side(std::size_t i) {
    const Hit& hit = room_.hits[i];
    if (!hit.is_surface()) return;
    Side& side = room_.sides[i];
    side.normal = scene_.tracer().surface(hit.surface).normal(now_.rays[i], hit);
    side.is_outside = dot(now_.rays[i].direction, side.normal) < 0;
  }
  bool contradicts(std::size_t i) const {
    return room_.hits[i].is_surface() && room_.hits[i].surface == now_.paths[i].left && room_.sides[i].is_outside != now_.paths[i].left_outside;
  }

  void trace() {
    const std::size_t n = now_.paths.size();
    room_.hits.resize(n);
    room_.sides.resize(n);
    scene_.tracer().first_hits(now_.rays, room_.hits);
    std::vector<std::uint32_t>& again = room_.again;
    again.clear();
    for (std::size_t i = 0; i < n; ++i) {
      find_side(i);
      if (contradicts(i)) again.push_back(static_cast<std::uint32_t>(i));
    }
    // Behind a contradicted hit by the resolution of the origin, doubled from one such hit to the next.
    double step = 1;
    for (int round = 0; round < 40 && !again.empty(); ++round, step *= 2) {
      room_.rays_again.resize(again.size());
      room_.hits_again.resize(again.size());
      for (std::size_t k = 0; k < again.size(); ++k) {
        Ray& ray = now_.rays[again[k]];
        ray.nearest = room_.hits[again[k]].t + step * resolution(ray.origin, now_.paths[again[k]].length);
        room_.rays_again[k] = ray;
      }
      scene_.tracer().first_hits(room_.rays_again, room_.hits_again);
      std::size_t left = 0;
      for (std::size_t k = 0; k < again.size(); ++k) {
        room_.hits[again[k]] = room_.hits_again[k];
        find_side(again[k]);
        if (contradicts(again[k])) again[left++] = again[k];
      }
      again.resize(left);
    }
  }

  Vec direction(std::size_t i) const { return now_.paths[i].length == 1 ? now_.rays[i].direction : now_.rays[i].direction / now_.paths[i].length; }

  /// What is added to the path's distance at its hit.
  double length_of(std::size_t i) const {
    const Path& p = now_.paths[i];
    return (p.travelled + room_.hits[i].t * p.length) - p.travelled;
  }

  Place place(std::size_t i) const {
    const Hit& hit = room_.hits[i];
    return {now_.rays[i].at(hit.t), direction(i), room_.sides[i].normal, now_.paths[i].travelled + hit.t * now_.paths[i].length, hit};
  }

  void finish_opaque() {
    const std::size_t n = now_.paths.size();
    for (std::vector<std::uint32_t>& list : room_.of_surface) list.clear();
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t surface = room_.hits[i].surface;
      if (surface != Hit::none && scene_.material(surface).opaque) room_.of_surface[surface].push_back(static_cast<std::uint32_t>(i));
    }
    room_.place_of.resize(n);
    room_.places.clear();
    room_.finishes.clear();
    for (std::uint32_t surface = 0; surface < scene_.surfaces(); ++surface) {
      const std::vector<std::uint32_t>& list = room_.of_surface[surface];
      if (list.empty()) continue;
      const std::size_t begin = room_.places.size();
      for (const std::uint32_t i : list) {
        room_.place_of[i] = static_cast<std::uint32_t>(room_.places.size());
        room_.places.push_back(place(i));
      }
      room_.finishes.resize(room_.places.size());
      scene_.material(surface).opaque->finish(std::span(room_.places).subspan(begin), std::span(room_.finishes).subspan(begin));
    }
  }

  static bool is_grey(const Vec& a) { return a.x == a.y && a.y == a.z; }

  /// exp(-extinction path) of every path that met something, in the order in which `follow` asks.
  void absorb() {
    std::vector<double>& shares = room_.transmitted;
    shares.clear();
    for (std::size_t i = 0; i < now_.paths.size(); ++i) {
      const Vec& extinction = now_.paths[i].medium->extinction;
      if (!room_.hits[i].is_surface() || !(largest(extinction) > 0)) continue;
      const double path = length_of(i);
      for (int k = 0; k < (is_grey(extinction) ? 1 : 3); ++k) shares.push_back(-(extinction[k] * path));
    }
    exponentials(shares);
  }
  Vec next_share(const Vec& extinction) {
    const double* t = &room_.transmitted[share_];
    share_ += is_grey(extinction) ? 1 : 3;
    return is_grey(extinction) ? Vec(t[0], t[0], t[0]) : Vec(t[0], t[1], t[2]);
  }

  void see(std::uint32_t pixel, const Vec& weight, const Vec& origin, const Vec& towards, double blur) {
    room_.terms.push_back({pixel, true, weight});
    room_.sights.push_back({origin, towards, blur});
  }
  void add(std::uint32_t pixel, const Vec& radiance) { room_.terms.push_back({pixel, false, radiance}); }

  /// A new ray from a place that path `parent` reached; cut off, it sees the surroundings.
  void go_on(std::size_t parent, int depth, const Place& at, const Vec& towards, const Vec& share, bool is_outside, const Medium& medium, double blur, bool is_straight) {
    const double largest_share = largest(share);
    if (!(largest_share > 0)) return;
    const std::uint32_t pixel = now_.paths[parent].pixel;
    if (depth >= options_.depth || largest_share < options_.least_weight) return see(pixel, share, at.point, towards, blur);
    next_.rays.push_back({at.point, towards, resolution(at.point, 1)});
    next_.paths.push_back({1, share, pixel, at.hit.surface, is_outside, is_straight, &medium, at.distance, blur});
  }

  // Adds what path i brings, and makes the paths that go on from it.
  void follow(std::size_t i, int depth) {
    const Path& p = now_.paths[i];
    const Hit& hit = room_.hits[i];
    Seen& seen = seen_[p.pixel];
    if (depth == 1) seen.hit = hit;
    if (!hit.is_surface()) return see(p.pixel, p.weight, now_.rays[i].origin, direction(i), p.blur);

    const Material& material = scene_.material(hit.surface);
    const bool is_outside = room_.sides[i].is_outside;
    const Place at = material.opaque ? room_.places[room_.place_of[i]] : place(i);
    const double path = at.distance - p.travelled;
    Vec weight = p.weight;
    if (largest(p.medium->extinction) > 0) {
      const Vec t = next_share(p.medium->extinction);
      add(p.pixel, weight * (Vec(1, 1, 1) - t) * p.medium->glow);
      weight *= t;
    }
    if (p.is_straight && p.medium->is_film) seen.film += path;
    const Vec facing = is_outside ? at.normal : -at.normal;
    Vec shaded = facing;
    if (material.opaque) {
      const Finish& f = room_.finishes[room_.place_of[i]];
      add(p.pixel, weight * f.radiance);
      if (largest(f.mirror) > 0) {
        shaded = f.mirror_normal;
        Vec mirrored = at.direction - 2 * dot(at.direction, shaded) * shaded;
        // A bump's normal may turn the ray into the surface that it mirrors: it is turned out again.
        const double out = dot(mirrored, facing);
        if (out < 0) mirrored -= 2 * out * facing;
        go_on(i, depth, at, mirrored, weight * f.mirror, is_outside, *p.medium, f.blur, false);
      }
    } else {
      const Medium& here = is_outside ? material.outside : material.inside;
      const Medium& beyond = is_outside ? material.inside : material.outside;
      const auto [rays, normal] = cross_interface(material, at, is_outside);
      shaded = normal;
      go_on(i, depth, at, rays.reflected, rays.reflectance * weight, is_outside, here, p.blur, false);
      if (rays.reflectance < 1) go_on(i, depth, at, rays.refracted, (1 - rays.reflectance) * weight, !is_outside, beyond, p.blur, p.is_straight);
    }
    if (depth == 1) {
      seen.is_masked = material.is_masked;
      seen.normal = shaded;
    }
  }

  void gather() {
    room_.arrived.resize(room_.sights.size());
    if (!room_.sights.empty()) scene_.environment().radiance(room_.sights, room_.arrived);
    std::size_t sight = 0;
    for (const Term& term : room_.terms) seen_[term.pixel].radiance += term.is_sight ? term.weight * room_.arrived[sight++] : term.weight;
  }
};

}  // namespace

void shade(const Scene& scene, const ShadingOptions& options, std::span<const Ray> rays, std::span<Seen> seen) {
  std::fill(seen.begin(), seen.end(), Seen{});
  static thread_local Room room;
  Generations(scene, options, rays, seen, room).run();
}

}  // namespace rainref::compositor
