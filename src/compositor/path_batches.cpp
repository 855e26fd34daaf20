#include "compositor/path_batches.h"

namespace rainref::compositor {

std::uint32_t PathBatches::find(std::uint32_t surface, const Medium* medium) {
  std::uint32_t b = 0;
  while (b < used_ && !batches_[b].is(surface, medium)) ++b;
  if (b < used_) return b;
  make_room(batches_, ++used_);
  batches_[b] = {surface, medium, 0, 0};
  return b;
}

void PathBatches::sort(std::span<const Path> paths, std::span<const Hit> hits) {
  const std::size_t n = paths.size();
  make_room(slot_, n);
  make_room(batches_, 1);
  batches_[0] = {Hit::none, nullptr, 0, 0};
  used_ = 1;
  std::uint32_t batch = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t surface = hits[i].surface;
    const Medium* const medium = surface == Hit::none ? nullptr : paths[i].medium;
    if (!batches_[batch].is(surface, medium)) batch = find(surface, medium);  // neighbours mostly share a batch
    ++batches_[batch].count;
    slot_[i] = batch;
  }
  slots_ = 0;
  for (Batch& b : std::span(batches_).first(used_)) {
    b.begin = slots_;
    slots_ += whole_lanes(b.count);
    b.count = 0;
  }
  make_room(ray_, slots_);
  make_room(hit_, slots_);
  for (std::size_t i = 0; i < n; ++i) {
    Batch& b = batches_[slot_[i]];
    const std::size_t slot = b.begin + b.count++;
    slot_[i] = static_cast<std::uint32_t>(slot);
    ray_[slot] = static_cast<std::uint32_t>(i);
    hit_[slot] = hits[i];
  }
  for (const Batch& b : batches()) {
    for (std::size_t slot = b.begin + b.count; slot < b.begin + whole_lanes(b.count); ++slot) {
      ray_[slot] = ray_[slot - 1];
      hit_[slot] = hit_[slot - 1];
    }
  }
}

}  // namespace rainref::compositor
