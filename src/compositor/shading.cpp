// Traces one generation of rays after the other. Rays are stored component by component; those that hit one surface within one medium are
// treated together, in lanes. Light of a pixel is added up in the order of the paths, whatever the order of evaluation.
#include "compositor/shading.h"

#include <cmath>
#include <limits>

#include "compositor/shading_kernels.h"
#include "compositor/shading_room.h"

namespace rainref::compositor {
namespace {

/// The spacing of numbers of the size of the ray's origin, along the ray.
double resolution(const Vec& origin, double length) {
  return 0x1p-52 * std::max({std::abs(origin.x), std::abs(origin.y), std::abs(origin.z), 1e-3}) / length;
}

class Generations {
 public:
  Generations(const Scene& scene, const ShadingOptions& options, const RayArrays& rays, std::size_t count, SeenColumns& seen,
              ShadingRoom& room)
      : scene_(scene), options_(options), seen_(seen), room_(room), now_(&room.now), next_(&room.next) {
    RayColumns& to = now_->columns;
    to.make_room(count);
    for (int k = 0; k < 3; ++k) {
      std::copy_n(rays.origin[k], count, to.origin().component[k]);
      std::copy_n(rays.direction[k], count, to.direction().component[k]);
      std::fill_n(to.weight().component[k], count, 1.0);
    }
    std::copy_n(rays.nearest, count, to.nearest());
    std::fill_n(to.travelled(), count, 0.0);
    std::fill_n(to.blur(), count, 0.0);
    room.farthest.assign(rays.farthest, rays.farthest + count);
    now_->count = count;
    make_room(now_->paths, count);
    make_room(room.length, whole_lanes(count));
    measure(count, to.direction(), room.length.data());
    room.order.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      now_->paths[i] = {&scene.eye(), static_cast<std::uint32_t>(i)};
      room.order[i] = static_cast<std::uint32_t>(i);
    }
    seen.clear(count);
  }

  void run() {
    for (depth_ = 1; now_->count > 0; ++depth_) {
      const std::size_t n = now_->count;
      length_ = depth_ == 1 ? room_.length.data() : nullptr;
      if (room_.endless.size() < n) room_.endless.assign(n, std::numeric_limits<double>::infinity());
      trace();
      if (depth_ == 1) std::copy_n(room_.hits.data(), n, seen_.hits());
      room_.batches.sort(std::span(now_->paths).first(n), std::span(room_.hits).first(n));
      next_->columns.make_room(2 * n);
      make_room(next_->paths, 2 * n);
      next_->count = 0;
      room_.escaped_rays.make_room(3 * n);
      room_.terms.make_room(room_.batches.slots());
      room_.children.assign(room_.batches.slots(), {nowhere, nowhere});
      for (const PathBatches::Batch& batch : room_.batches.batches()) {
        if (batch.surface == Hit::none)
          leave_for_surroundings(batch);
        else
          treat(batch);
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
  SeenColumns& seen_;
  ShadingRoom& room_;
  Rays *now_, *next_;
  int depth_ = 1;
  const double* length_ = nullptr;  // of directions; null if they are unit vectors

  RayArrays arrays() const {
    const VecArrays o = now_->columns.origin(), d = now_->columns.direction();
    return {{o.component[0], o.component[1], o.component[2]},
            {d.component[0], d.component[1], d.component[2]},
            now_->columns.nearest(),
            depth_ == 1 ? room_.farthest.data() : room_.endless.data()};
  }
  RayList list_of(const PathBatches::Batch& batch) const {
    return {now_->columns, length_, {room_.batches.ray() + batch.begin, batch.count}};
  }

  /// True for a hit of the surface that the ray left, from the side on which the ray cannot be.
  bool contradicts(std::size_t i, const Hit& hit) const {
    const Path& path = now_->paths[i];
    if (!hit.is_surface() || hit.surface != path.left) return false;
    const Ray ray = arrays()[i];
    return (dot(ray.direction, scene_.tracer().surface(hit.surface).normal(ray, hit)) < 0) != path.left_outside;
  }

  void trace() {
    const std::size_t n = now_->count;
    std::vector<Hit>& hits = room_.hits;
    make_room(hits, n);
    scene_.tracer().first_hits(arrays(), std::span(hits).first(n));
    std::vector<std::uint32_t>& again = room_.again;
    again.clear();
    for (std::size_t i = 0; depth_ > 1 && i < n; ++i) {
      if (contradicts(i, hits[i])) again.push_back(static_cast<std::uint32_t>(i));
    }
    // Continues behind a contradicted hit, by the resolution of the origin, doubled for each such hit.
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

  /// The first of all batches: an escaped ray has the number of its slot.
  void leave_for_surroundings(const PathBatches::Batch& batch) {
    collect_escaped(list_of(batch), room_.escaped_rays.vectors(0), room_.escaped_rays.vectors(3), room_.escaped_rays[6]);
    room_.escaped_count = batch.count;
    room_.cut_share.clear();
  }

  void treat(const PathBatches::Batch& batch) {
    const std::size_t n = batch.count;
    const Material& material = scene_.material(batch.surface);
    ArrivalColumns& at = room_.arrivals;
    at.make_room(n);
    room_.surface.make_room(n);
    const RayList list = list_of(batch);
    const Hit* hits = room_.batches.hit() + batch.begin;
    const VecArraysOut added = room_.terms.vectors(0).from(batch.begin), sent = room_.terms.vectors(3).from(batch.begin);
    const VecArraysOut smooth = room_.surface.vectors(0), shaded = room_.surface.vectors(3);
    scene_.tracer().surface(batch.surface).normals(arrays(), list.which, hits, at.normal());
    arrive(list, hits, *batch.medium, at, added);
    if (batch.medium->is_film) {
      for (std::size_t k = 0; k < n; ++k) {
        const Path& path = now_->paths[list.which[k]];
        if (path.is_straight) seen_.film()[path.pixel] += at.path()[k];
      }
    }

    const Places places{n, at.point(), at.direction(), at.normal(), at.distance(), hits};
    if (material.opaque) {
      const Finishes finishes{room_.surface.vectors(6), room_.surface.vectors(9), room_.surface.vectors(12), room_.surface[15]};
      material.opaque->finish(places, finishes);
      leave_finishes(n, at, finishes, next_->columns, next_->count, sent, shaded);
    } else {
      room_.refracted.make_room(n);
      const VecArrays smooth_normals = smooth;
      if (material.smooth_normals) material.smooth_normals(places, smooth);
      cross_interfaces(n, at, material.smooth_normals ? &smooth_normals : nullptr, material.outside.ior, material.inside.ior,
                       next_->columns, next_->count, room_.refracted, shaded);
      for (int k = 0; k < 3; ++k) std::fill_n(sent.component[k], n, 0.0);
    }
    if (depth_ == 1) {
      for (std::size_t k = 0; k < n; ++k) seen_.normal().put(list.which[k], shaded[k]);
    }
    if (material.is_masked) {
      for (std::size_t k = 0; k < n; ++k) {
        const Path& path = now_->paths[list.which[k]];
        if (path.is_straight) seen_.mask()[path.pixel] = 1;
      }
    }
    go_on(batch, 0);
    if (!material.opaque) go_on(batch, 1);
  }

  /// The children of a batch with enough weight join the next generation; the others see the surroundings. Children that are not refracted
  /// are already stored there.
  void go_on(const PathBatches::Batch& batch, std::size_t which) {
    const std::size_t first = next_->count, n = batch.count, begin = which == 0 ? first : 0;
    const RayColumns& from = which == 0 ? next_->columns : room_.refracted;
    make_room(room_.kept, n);
    std::uint32_t* const kept = room_.kept.data();
    std::array<std::uint32_t, 2>* const children = &room_.children[batch.begin];
    std::size_t count = 0;
    const VecArrays weight = from.weight().from(begin);
    for (std::size_t k = 0; k < n; ++k) {
      const double share = std::max(weight.component[0][k], std::max(weight.component[1][k], weight.component[2][k]));
      if (!(share > 0)) continue;
      if (depth_ >= options_.depth || share < options_.least_weight) {
        children[k][which] = has_escaped | static_cast<std::uint32_t>(room_.escaped_count);
        room_.escaped_rays.vectors(0).put(room_.escaped_count, from.origin()[begin + k]);
        room_.escaped_rays.vectors(3).put(room_.escaped_count, from.direction()[begin + k]);
        room_.escaped_rays[6][room_.escaped_count++] = from.blur()[begin + k];
        room_.cut_share.push_back(weight[k]);
        continue;
      }
      children[k][which] = static_cast<std::uint32_t>(first + count);
      kept[count++] = static_cast<std::uint32_t>(k);
    }
    if (count == 0) return;
    next_->count += count;
    for (int c = 0; (which == 1 || count < n) && c < RayColumns::count; ++c) {
      const double* values = from.column(c) + begin;
      double* to = next_->columns.column(c) + first;
      for (std::size_t j = 0; j < count; ++j) to[j] = values[kept[j]];
    }
    const Material& material = scene_.material(batch.surface);
    const double* facing = room_.arrivals.facing();
    const std::uint32_t* rays = room_.batches.ray() + batch.begin;
    for (std::size_t j = 0; j < count; ++j) {
      const Path& parent = now_->paths[rays[kept[j]]];
      const bool goes_through = which == 1, is_outside = (facing[kept[j]] < 0) != goes_through;
      const Medium* medium = material.opaque ? batch.medium : is_outside ? &material.outside : &material.inside;
      next_->paths[first + j] = {medium, parent.pixel, batch.surface, is_outside, goes_through && parent.is_straight};
    }
  }

  void look_around() {
    const std::size_t n = room_.escaped_count;
    make_room(room_.arrived, n);
    if (n == 0) return;
    for (std::size_t k = n; k < whole_lanes(n); ++k) {
      for (int c = 0; c < 7; ++c) room_.escaped_rays[c][k] = room_.escaped_rays[c][n - 1];
    }
    scene_.environment().radiance({n, room_.escaped_rays.vectors(0), room_.escaped_rays.vectors(3), room_.escaped_rays[6]},
                                  std::span(room_.arrived).first(n));
  }

  /// Adds up each pixel's light, path by path, and sets the order of the next generation.
  void add_up() {
    const std::size_t escaped = room_.batches.batches().front().count;
    const VecArrays weight = now_->columns.weight(), added = room_.terms.vectors(0), sent = room_.terms.vectors(3);
    const VecArraysOut radiance = seen_.radiance();
    const Vec *arrived = room_.arrived.data(), *cut_share = room_.cut_share.data();
    make_room(room_.next_order, next_->count);
    std::uint32_t* next = room_.next_order.data();
    for (const std::uint32_t i : std::span(room_.order).first(now_->count)) {
      const std::uint32_t pixel = now_->paths[i].pixel, slot = room_.batches.slot(i);
      Vec sum = radiance[pixel];
      if (slot < escaped) {
        sum += weight[i] * arrived[slot];
      } else {
        sum += added[slot];
        sum += sent[slot];
        for (const std::uint32_t child : room_.children[slot]) {
          if (child == nowhere) continue;
          if (child & has_escaped)
            sum += cut_share[(child ^ has_escaped) - escaped] * arrived[child ^ has_escaped];
          else
            *next++ = child;
        }
      }
      radiance.put(pixel, sum);
    }
  }
};

/// Not inlined, because otherwise every access would look up the thread's memory again.
[[gnu::noinline]] ShadingRoom& room_of_thread() {
  static thread_local ShadingRoom room;
  return room;
}

}  // namespace

void shade(const Scene& scene, const ShadingOptions& options, const RayArrays& rays, std::size_t count, SeenColumns& seen) {
  Generations(scene, options, rays, count, seen, room_of_thread()).run();
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
  SeenColumns columns;
  shade(scene, options, RayArrays{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, c[6], c[7]}, rays.size(), columns);
  for (std::size_t i = 0; i < rays.size(); ++i)
    seen[i] = {columns.radiance()[i], columns.hits()[i], columns.normal()[i], columns.film()[i], columns.mask()[i] != 0};
}

}  // namespace rainref::compositor
