// Rays of one generation sorted by the surface that they hit, for evaluation in lanes.
#pragma once

#include <span>
#include <vector>

#include "compositor/scene.h"

namespace rainref::compositor {

/// The state of a ray besides its numbers.
struct Path {
  const Medium* medium = nullptr;
  std::uint32_t pixel = 0;
  std::uint32_t left = Hit::none;  ///< the surface where it began
  bool left_outside = false;       ///< and the side of it
  bool is_straight = true;         ///< refracted and never reflected so far
};

/// A vector that keeps its capacity, so that growing again is free.
template <class T>
void make_room(std::vector<T>& v, std::size_t count) {
  if (v.size() < count) v.resize(count);
}

/// Batches are stored one after the other in slots, each starting at a whole vector; slots between them repeat the previous ray.
class PathBatches {
 public:
  /// Rays that hit one surface within one medium; or rays that hit nothing (medium null).
  struct Batch {
    std::uint32_t surface;
    const Medium* medium;
    std::size_t begin, count;
    bool is(std::uint32_t s, const Medium* m) const { return surface == s && medium == m; }
  };

  void sort(std::span<const Path> paths, std::span<const Hit> hits);
  /// The first batch holds the rays that hit nothing.
  std::span<const Batch> batches() const { return {batches_.data(), used_}; }
  std::size_t slots() const { return slots_; }
  /// By slot: the ray, and its hit.
  const std::uint32_t* ray() const { return ray_.data(); }
  const Hit* hit() const { return hit_.data(); }
  /// By ray.
  std::uint32_t slot(std::size_t ray) const { return slot_[ray]; }

 private:
  std::uint32_t find(std::uint32_t surface, const Medium* medium);
  std::vector<Batch> batches_;
  std::size_t used_ = 0, slots_ = 0;
  std::vector<std::uint32_t> ray_, slot_;
  std::vector<Hit> hit_;
};

}  // namespace rainref::compositor
