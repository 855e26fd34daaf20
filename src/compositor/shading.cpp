// One generation of rays after the other. Rays lie component by component, and those that met one surface within one medium are
// treated together, in lanes. What reaches a pixel is added up in the order of the paths, whatever the order in which it
// was found out.
#include "compositor/shading.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <vector>

#include "compositor/shading_kernels.h"

namespace rainref::compositor {
namespace {

/// What a ray on its way is to its pixel, beside its numbers.
struct Path {
  const Medium* medium;
  std::uint32_t pixel;
  std::uint32_t left = Hit::none;  // the surface where it began
  bool left_outside = false;       // and on which side of it
  bool is_straight = true;         // refracted and never reflected so far
};

struct Rays {
  RayColumns columns;
  std::vector<Path> paths;
};

/// Rays that met one surface within one medium.
struct Batch {
  std::uint32_t surface;
  const Medium* medium;
  std::vector<std::uint32_t> rays;
};

/// What a ray leads to: nothing, a sight, or a ray of the next generation.
struct Sequel {
  enum Kind : std::uint8_t { nothing, sight, ray } kind = nothing;
  std::uint32_t index = 0;
};

/// Room for the rays of one call, kept by each thread for its next one.
struct Room {
  Rays now, next;
  std::vector<double> length, farthest;
  std::vector<Hit> hits, hits_here;
  std::vector<std::uint32_t> again;
  std::vector<Ray> rays_again;
  std::vector<Hit> hits_again;
  std::vector<Batch> batches;
  std::vector<std::uint32_t> escaped;           // rays that met nothing
  std::vector<std::uint32_t> order, next_order;  // of the paths: in which their light is added up
  std::vector<Sequel> sequel;                   // by ray: its sight, or its slot
  // By slot, which are the rays of the batches one after the other, each batch from a whole vector on.
  Columns<6> terms;                             // what the medium added, what the surface sent
  std::vector<std::array<Sequel, 2>> children;  // reflected or mirrored, refracted
  // Of a batch.
  ArrivalColumns arrivals;
  Columns<16> surface;  // smooth normals, shaded normals, a finish
  RayColumns child[2];
  std::vector<std::uint32_t> kept;
  // Of a generation: what escaped, and then what was cut off, with its share in the pixel.
  Columns<7> sights;
  std::size_t sight_count;
  std::vector<Vec> cut_share, arrived;
};

/// The spacing of numbers as large as the ray's origin, along the ray.
double resolution(const Vec& origin, double length) {
  return 0x1p-52 * std::max({std::abs(origin.x), std::abs(origin.y), std::abs(origin.z), 1e-3}) / length;
}

/// The list goes on to whole lanes.
void fill_up(std::vector<std::uint32_t>& list) {
  if (!list.empty()) list.resize(whole_lanes(list.size()), list.back());
}

class Generations {
 public:
  Generations(const Scene& scene, const ShadingOptions& options, const RayArrays& rays, std::span<Seen> seen, Room& room)
      : scene_(scene), options_(options), seen_(seen), room_(room), now_(&room.now), next_(&room.next) {
    const std::size_t n = seen.size();
    now_->columns.make_room(n);
    const auto copy = [n](const double* from, double* to) { std::copy_n(from, n, to); };
    for (int k = 0; k < 3; ++k) {
      copy(rays.origin[k], now_->columns.origin().component[k]);
      copy(rays.direction[k], now_->columns.direction().component[k]);
      std::fill_n(now_->columns.weight().component[k], n, 1.0);
    }
    copy(rays.nearest, now_->columns.nearest());
    std::fill_n(now_->columns.travelled(), n, 0.0);
    std::fill_n(now_->columns.blur(), n, 0.0);
    room.farthest.assign(rays.farthest, rays.farthest + n);
    room.length.resize(n);
    now_->paths.resize(n);
    room.order.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Vec d = now_->columns.direction()[i];
      room.length[i] = std::sqrt(dot(d, d));
      now_->paths[i] = {&scene.eye(), static_cast<std::uint32_t>(i)};
      room.order[i] = static_cast<std::uint32_t>(i);
    }
  }

  void run() {
    for (depth_ = 1; !now_->paths.empty(); ++depth_) {
      const std::size_t n = now_->paths.size();
      length_ = depth_ == 1 ? room_.length.data() : nullptr;
      if (depth_ > 1) room_.farthest.assign(n, std::numeric_limits<double>::infinity());
      trace();
      make_batches();
      next_->columns.make_room(2 * n);
      next_->paths.clear();
      leave_for_surroundings();
      std::size_t slot = 0;
      for (const Batch& batch : room_.batches) {
        if (!batch.rays.empty()) treat(batch, slot), slot += whole_lanes(batch.rays.size());
      }
      look_around();
      add_up();
      std::swap(now_, next_);
      std::swap(room_.order, room_.next_order);
    }
  }

 private:
  const Scene& scene_;
  const ShadingOptions& options_;
  std::span<Seen> seen_;
  Room& room_;
  Rays *now_, *next_;
  int depth_ = 1;
  const double* length_ = nullptr;  // of directions; null where they are unit

  RayArrays arrays() const {
    const VecArrays o = now_->columns.origin(), d = now_->columns.direction();
    return {{o.component[0], o.component[1], o.component[2]}, {d.component[0], d.component[1], d.component[2]}, now_->columns.nearest(), room_.farthest.data()};
  }

  /// A hit of the surface that the ray left, from the side where the ray is not.
  bool contradicts(std::size_t i, const Hit& hit) const {
    const Path& path = now_->paths[i];
    if (!hit.is_surface() || hit.surface != path.left) return false;
    const Ray ray = arrays()[i];
    return (dot(ray.direction, scene_.tracer().surface(hit.surface).normal(ray, hit)) < 0) != path.left_outside;
  }

  void trace() {
    const std::size_t n = now_->paths.size();
    std::vector<Hit>& hits = room_.hits;
    hits.resize(n);
    scene_.tracer().first_hits(arrays(), hits);
    std::vector<std::uint32_t>& again = room_.again;
    again.clear();
    for (std::size_t i = 0; i < n; ++i) {
      if (contradicts(i, hits[i])) again.push_back(static_cast<std::uint32_t>(i));
    }
    // Behind a contradicted hit by the resolution of the origin, doubled from one such hit to the next.
    double step = 1;
    for (int round = 0; round < 40 && !again.empty(); ++round, step *= 2) {
      room_.rays_again.resize(again.size());
      room_.hits_again.resize(again.size());
      for (std::size_t k = 0; k < again.size(); ++k) {
        const std::uint32_t i = again[k];
        now_->columns.nearest()[i] = hits[i].t + step * resolution(now_->columns.origin()[i], length_ == nullptr ? 1 : length_[i]);
        room_.rays_again[k] = arrays()[i];
      }
      scene_.tracer().first_hits(room_.rays_again, room_.hits_again);
      std::size_t left = 0;
      for (std::size_t k = 0; k < again.size(); ++k) {
        hits[again[k]] = room_.hits_again[k];
        if (contradicts(again[k], hits[again[k]])) again[left++] = again[k];
      }
      again.resize(left);
    }
  }

  void make_batches() {
    for (Batch& batch : room_.batches) batch.rays.clear();
    room_.escaped.clear();
    std::size_t used = 0, last = 0;
    const auto is = [&](std::size_t b, std::uint32_t surface, const Medium* medium) { return room_.batches[b].surface == surface && room_.batches[b].medium == medium; };
    for (std::size_t i = 0; i < now_->paths.size(); ++i) {
      const std::uint32_t surface = room_.hits[i].surface;
      if (surface == Hit::none) {
        room_.escaped.push_back(static_cast<std::uint32_t>(i));
        continue;
      }
      const Medium* medium = now_->paths[i].medium;
      if (!(last < used && is(last, surface, medium))) {
        for (last = 0; last < used && !is(last, surface, medium);) ++last;
        if (last == used) {
          if (++used > room_.batches.size()) room_.batches.emplace_back();
          room_.batches[last].surface = surface;
          room_.batches[last].medium = medium;
        }
      }
      room_.batches[last].rays.push_back(static_cast<std::uint32_t>(i));
    }
    const std::size_t n = now_->paths.size(), slots = n + used * most_lanes;
    room_.sequel.resize(n);
    room_.terms.make_room(slots);
    room_.children.assign(slots, {});
    room_.sights.make_room(room_.escaped.size() + 2 * n);
  }

  void leave_for_surroundings() {
    std::vector<std::uint32_t>& list = room_.escaped;
    const std::size_t n = list.size();
    for (std::size_t k = 0; k < n; ++k) room_.sequel[list[k]] = {Sequel::sight, static_cast<std::uint32_t>(k)};
    fill_up(list);
    gaze({now_->columns, length_, std::span(list).first(n)}, room_.sights.vectors(0), room_.sights.vectors(3), room_.sights[6]);
    room_.sight_count = n;
    room_.cut_share.clear();
  }

  /// The rays of a batch, which get the slots from `slot` on.
  void treat(const Batch& batch, std::size_t slot) {
    const std::size_t n = batch.rays.size();
    const Material& material = scene_.material(batch.surface);
    ArrivalColumns& at = room_.arrivals;
    at.make_room(n);
    room_.surface.make_room(n);
    room_.kept.assign(batch.rays.begin(), batch.rays.end());
    fill_up(room_.kept);
    room_.hits_here.resize(room_.kept.size());
    for (std::size_t k = 0; k < room_.kept.size(); ++k) room_.hits_here[k] = room_.hits[room_.kept[k]];
    for (std::size_t k = 0; k < n; ++k) room_.sequel[batch.rays[k]] = {Sequel::ray, static_cast<std::uint32_t>(slot + k)};
    const RayList list{now_->columns, length_, std::span(room_.kept).first(n)};
    const Hit* hits = room_.hits_here.data();
    scene_.tracer().surface(batch.surface).normals(arrays(), list.which, hits, at.normal());
    const VecArraysOut added = room_.terms.vectors(0).from(slot), sent = room_.terms.vectors(3).from(slot), shaded = room_.surface.vectors(3);
    arrive(list, hits, *batch.medium, at, added);

    const Places places{n, at.point(), at.direction(), at.normal(), at.distance(), hits};
    room_.child[0].make_room(n);
    if (material.opaque) {
      const Finishes finishes{room_.surface.vectors(6), room_.surface.vectors(9), room_.surface.vectors(12), room_.surface[15]};
      material.opaque->finish(places, finishes);
      leave_finishes(n, at, finishes, room_.child[0], sent, shaded);
    } else {
      room_.child[1].make_room(n);
      const VecArraysOut smooth = room_.surface.vectors(0);
      const VecArrays smooth_normals = smooth;
      if (material.smooth_normals) material.smooth_normals(places, smooth);
      cross_interfaces(n, at, material.smooth_normals ? &smooth_normals : nullptr, material.outside.ior, material.inside.ior, room_.child[0], room_.child[1], shaded);
      for (int k = 0; k < 3; ++k) std::fill_n(sent.component[k], n, 0.0);
    }
    for (std::size_t k = 0; k < n; ++k) {
      const Path& path = now_->paths[batch.rays[k]];
      Seen& seen = seen_[path.pixel];
      if (path.is_straight && batch.medium->is_film) seen.film += at.path()[k];
      if (depth_ > 1) continue;
      seen.hit = hits[k];
      seen.normal = shaded[k];
      seen.is_masked = material.is_masked;
    }
    go_on(batch, slot, 0);
    if (!material.opaque) go_on(batch, slot, 1);
  }

  /// The children of a batch that are worth it join the next generation; the others see the surroundings.
  void go_on(const Batch& batch, std::size_t slot, int which) {
    const RayColumns& from = room_.child[which];
    std::vector<std::uint32_t>& kept = room_.kept;
    kept.clear();
    const std::size_t first = next_->paths.size(), n = batch.rays.size();
    const VecArrays weight = from.weight();
    for (std::size_t k = 0; k < n; ++k) {
      const double share = std::max(weight.component[0][k], std::max(weight.component[1][k], weight.component[2][k]));
      if (!(share > 0)) continue;
      Sequel& sequel = room_.children[slot + k][static_cast<std::size_t>(which)];
      if (depth_ >= options_.depth || share < options_.least_weight) {
        sequel = {Sequel::sight, static_cast<std::uint32_t>(room_.sight_count)};
        room_.sights.vectors(0).put(room_.sight_count, from.origin()[k]);
        room_.sights.vectors(3).put(room_.sight_count, from.direction()[k]);
        room_.sights[6][room_.sight_count++] = from.blur()[k];
        room_.cut_share.push_back(weight[k]);
        continue;
      }
      sequel = {Sequel::ray, static_cast<std::uint32_t>(first + kept.size())};
      kept.push_back(static_cast<std::uint32_t>(k));
    }
    for (int c = 0; c < RayColumns::count; ++c) {
      const double* values = from.column(c);
      double* to = next_->columns.column(c) + first;
      if (kept.size() == n) std::memcpy(to, values, n * sizeof(double));
      else
        for (std::size_t j = 0; j < kept.size(); ++j) to[j] = values[kept[j]];
    }
    const Material& material = scene_.material(batch.surface);
    const double* facing = room_.arrivals.facing();
    next_->paths.resize(first + kept.size());
    for (std::size_t j = 0; j < kept.size(); ++j) {
      const Path& parent = now_->paths[batch.rays[kept[j]]];
      const bool goes_through = which == 1, is_outside = (facing[kept[j]] < 0) != goes_through;
      const Medium* medium = material.opaque ? batch.medium : is_outside ? &material.outside : &material.inside;
      next_->paths[first + j] = {medium, parent.pixel, batch.surface, is_outside, goes_through && parent.is_straight};
    }
  }

  void look_around() {
    const std::size_t n = room_.sight_count;
    room_.arrived.resize(n);
    if (n == 0) return;
    for (std::size_t k = n; k < whole_lanes(n); ++k) {
      for (int c = 0; c < 7; ++c) room_.sights[c][k] = room_.sights[c][n - 1];
    }
    scene_.environment().radiance({n, room_.sights.vectors(0), room_.sights.vectors(3), room_.sights[6]}, room_.arrived);
  }

  /// Each pixel's light, path by path, and the order of the next generation.
  void add_up() {
    const std::size_t escaped = room_.sight_count - room_.cut_share.size();
    const VecArrays weight = now_->columns.weight(), added = room_.terms.vectors(0), sent = room_.terms.vectors(3);
    room_.next_order.clear();
    for (const std::uint32_t i : room_.order) {
      Vec& radiance = seen_[now_->paths[i].pixel].radiance;
      const auto [kind, index] = room_.sequel[i];
      if (kind == Sequel::sight) {
        radiance += weight[i] * room_.arrived[index];
        continue;
      }
      radiance += added[index];
      radiance += sent[index];
      for (const Sequel& child : room_.children[index]) {
        if (child.kind == Sequel::sight) radiance += room_.cut_share[child.index - escaped] * room_.arrived[child.index];
        if (child.kind == Sequel::ray) room_.next_order.push_back(child.index);
      }
    }
  }
};

}  // namespace

void shade(const Scene& scene, const ShadingOptions& options, const RayArrays& rays, std::span<Seen> seen) {
  std::fill(seen.begin(), seen.end(), Seen{});
  static thread_local Room room;
  Generations(scene, options, rays, seen, room).run();
}

void shade(const Scene& scene, const ShadingOptions& options, std::span<const Ray> rays, std::span<Seen> seen) {
  Columns<8> c;
  c.make_room(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    c.vectors(0).put(i, rays[i].origin);
    c.vectors(3).put(i, rays[i].direction);
    c[6][i] = rays[i].nearest;
    c[7][i] = rays[i].farthest;
  }
  shade(scene, options, RayArrays{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, c[6], c[7]}, seen.first(rays.size()));
}

}  // namespace rainref::compositor
