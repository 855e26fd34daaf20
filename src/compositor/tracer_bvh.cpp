// Tracer without Embree: a binary tree of boxes, one ray at a time, all in double. It gives the same bits, because the surfaces decide, but
// is slower.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "compositor/tracer.h"
#include "rainref/error.h"

namespace rainref::compositor {

namespace {

struct Primitive {
  Box box;
  std::uint32_t surface, number;
};

/// `count` primitives from `first` on. An inner node has none; its left child follows it and the right one is at `first`.
struct Node {
  Box box;
  std::uint32_t first = 0, count = 0;
};

void include(Box& box, const Box& other) {
  for (int k = 0; k < 3; ++k) {
    box.low[k] = std::min(box.low[k], other.low[k]);
    box.high[k] = std::max(box.high[k], other.high[k]);
  }
}

constexpr std::uint32_t leaf_size = 2;
constexpr int deepest = 64;  // more than halving 2^32 primitives needs

void build(std::vector<Primitive>& primitives, std::uint32_t begin, std::uint32_t end, std::vector<Node>& nodes) {
  const std::size_t self = nodes.size();
  Node node{primitives[begin].box, begin, end - begin};
  for (std::uint32_t i = begin + 1; i < end; ++i) include(node.box, primitives[i].box);
  nodes.push_back(node);
  if (end - begin <= leaf_size) return;
  int across = 0;
  for (int k = 1; k < 3; ++k) {
    if (node.box.high[k] - node.box.low[k] > node.box.high[across] - node.box.low[across]) across = k;
  }
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(primitives.begin() + begin, primitives.begin() + middle, primitives.begin() + end,
                   [across](const Primitive& a, const Primitive& b) {
                     return a.box.low[across] + a.box.high[across] < b.box.low[across] + b.box.high[across];
                   });
  build(primitives, begin, middle, nodes);
  nodes[self].first = static_cast<std::uint32_t>(nodes.size());
  nodes[self].count = 0;
  build(primitives, middle, end, nodes);
}

/// A ray for tests of boxes. Boxes are enlarged by a margin far above the roundings of the surfaces and of this arithmetic; a surplus box
/// does not change the result.
struct Feeler {
  double origin[3], inverse[3], nearest, farthest, margin;

  Feeler(const Ray& ray, double largest) : nearest(ray.nearest), farthest(ray.farthest) {
    for (int k = 0; k < 3; ++k) {
      origin[k] = ray.origin[k];
      inverse[k] = 1 / ray.direction[k];
      largest = std::max(largest, std::abs(ray.origin[k]));
    }
    margin = 0x1p-32 * largest;
  }
  bool meets(const Box& box, double limit) const {
    double enter = nearest, leave = std::min(farthest, limit);
    for (int k = 0; k < 3; ++k) {
      const double low = box.low[k] - margin - origin[k], high = box.high[k] + margin - origin[k];
      if (std::isinf(inverse[k])) {  // parallel to the faces: between them, or outside
        if (low > 0 || high < 0) return false;
        continue;
      }
      const double a = low * inverse[k], b = high * inverse[k];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave + 0x1p-32 * std::abs(leave);
  }
};

}  // namespace

struct Tracer::State {
  std::vector<std::shared_ptr<const Surface>> surfaces;
  std::vector<std::uint64_t> revisions;  ///< of the surfaces in the tree
  std::vector<Primitive> primitives;
  std::vector<Node> nodes;
  double largest = 0;  ///< largest coordinate of a box

  Hit first_hit(const Ray& ray) const {
    Hit first;
    if (nodes.empty()) return first;
    const Feeler feeler(ray, largest);
    std::uint32_t waiting[deepest];
    int count = 0;
    waiting[count++] = 0;
    while (count > 0) {
      const std::uint32_t at = waiting[--count];
      const Node& node = nodes[at];
      if (!feeler.meets(node.box, first.t)) continue;
      if (node.count == 0) {
        waiting[count++] = node.first;
        waiting[count++] = at + 1;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const Primitive& p = primitives[i];
        if (feeler.meets(p.box, first.t)) surfaces[p.surface]->meet(p.surface, p.number, ray, first);
      }
    }
    return first;
  }
};

Tracer::Tracer(const TracerOptions& options) : state_(std::make_unique<State>()) {
  constexpr int widths[] = {1, 4, 8, 16};
  if (std::find(std::begin(widths), std::end(widths), options.packet_width) == std::end(widths)) {
    throw Error(ExitCode::usage, fmt::format("the packet width {} is none of 1, 4, 8, 16", options.packet_width));
  }
  if (!options.embree_config.empty()) {
    throw Error(ExitCode::usage,
                fmt::format("compositor.embree_config = \"{}\": this build of rainref traces rays without Embree", options.embree_config));
  }
}
Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;

std::uint32_t Tracer::add(std::shared_ptr<const Surface> surface) {
  state_->surfaces.push_back(std::move(surface));
  return static_cast<std::uint32_t>(state_->surfaces.size() - 1);
}

const Surface& Tracer::surface(std::uint32_t number) const { return *state_->surfaces.at(number); }

void Tracer::commit() {
  const FloatingPointGuard guard;
  State& s = *state_;
  std::vector<std::uint64_t> revisions;
  for (const auto& surface : s.surfaces) revisions.push_back(surface->revision());
  if (revisions == s.revisions) return;
  s.primitives.clear();
  s.nodes.clear();
  s.largest = 0;
  for (std::uint32_t surface = 0; surface < s.surfaces.size(); ++surface) {
    for (std::uint32_t i = 0; i < s.surfaces[surface]->primitives(); ++i) {
      s.primitives.push_back({s.surfaces[surface]->bounds(i), surface, i});
      for (int k = 0; k < 3; ++k)
        s.largest = std::max({s.largest, std::abs(s.primitives.back().box.low[k]), std::abs(s.primitives.back().box.high[k])});
    }
  }
  if (!s.primitives.empty()) build(s.primitives, 0, static_cast<std::uint32_t>(s.primitives.size()), s.nodes);
  s.revisions = std::move(revisions);
}

void Tracer::first_hits(std::span<const Ray> rays, std::span<Hit> hits) const {
  const FloatingPointGuard guard;
  for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = state_->first_hit(rays[i]);
}

void Tracer::first_hits(const RayArrays& rays, std::span<Hit> hits) const {
  const FloatingPointGuard guard;
  for (std::size_t i = 0; i < hits.size(); ++i) hits[i] = state_->first_hit(rays[i]);
}

}  // namespace rainref::compositor
