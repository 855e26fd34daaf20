#include "drops/motion/merge_grid.h"

#include <algorithm>
#include <span>

#include "drops/motion/kernels.h"

namespace rainref::drops {
namespace {

constexpr std::size_t room_behind = 64;  // more than a vector of slots
constexpr double slack = 1.0001;         // more than the rounding of radii and coordinates
constexpr std::size_t ahead = 16;        // elements between prefetch and use of a slot

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

}  // namespace

void MergeGrid::lay_out(const std::array<std::int64_t, size_classes>& counts, const MergeUniforms& u) {
  // The glass is the parallelogram of (0, 0), (f0, 0) and (f1, f2).
  const double f0 = u.frame[0], f1 = u.frame[1], f2 = u.frame[2];
  const double x0 = std::min(f1, 0.0), width = std::max(f0, f0 + f1) - x0, height = f2;
  std::uint32_t cells = 0;
  double most_radius = u.radius * slack;
  for (int k = 0; k < size_classes; ++k) {
    most_radius *= 2;
    ClassGrid& g = classes[static_cast<std::size_t>(k)];
    g = {};
    const std::int64_t n = counts[static_cast<std::size_t>(k)];
    if (n == 0) continue;
    // At most as many cells as drops, because empty ones would cost more than they save.
    const double side = std::max(2 * most_radius, __builtin_sqrt(width * height / static_cast<double>(n)));
    g = {x0, 0, 1 / side, std::max(1, static_cast<int>(width / side)), std::max(1, static_cast<int>(height / side)), cells};
    cells += static_cast<std::uint32_t>(g.columns) * static_cast<std::uint32_t>(g.rows);
  }
  cell_start.resize(cells + 1u);  // sort() writes all
}

void MergeGrid::build(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms) {
  const std::int64_t extent = drops.extent(), chunk = chunk_of(extent);
  for (auto* a : {&slot_x_, &slot_y_, &slot_radius_}) a->resize(std::max(a->size(), index(extent) + room_behind));
  slot_cell_.resize(std::max(slot_cell_.size(), index(extent)));
  const Slots slots(drops);
  std::vector<std::array<std::int64_t, size_classes>> of_chunk(index((extent + chunk - 1) / chunk),
                                                               std::array<std::int64_t, size_classes>{});
  executor.for_range(extent, chunk, [&](std::int64_t begin, std::int64_t end) {
    measure_range(uniforms, slots, begin, end, slot_x_.data(), slot_y_.data(), slot_radius_.data());
    std::array<std::int64_t, size_classes> counts{};
    for (std::int64_t i = begin; i < end; ++i) {
      if (slots.life[i] > 0) ++counts[static_cast<std::size_t>(size_class_of(slots.mass[i]))];
    }
    of_chunk[index(begin / chunk)] = counts;
  });
  std::array<std::int64_t, size_classes> counts{};
  for (const auto& c : of_chunk) {
    for (std::size_t k = 0; k < size_classes; ++k) counts[k] += c[k];
  }
  count = 0;
  for (const std::int64_t n : counts) count += n;
  lay_out(counts, uniforms);
  sort(executor, drops);
}

void MergeGrid::sort(const parallel::Executor& executor, const DropArrays& drops) {
  const auto cells = static_cast<std::uint32_t>(cell_start.size() - 1);
  const std::span<const float> masses = drops.mass(), lives = drops.life();
  const auto cell_of = [&](std::size_t k) {
    if (!(lives[k] > 0)) return BucketSort::no_key;
    const ClassGrid& g = classes[static_cast<std::size_t>(size_class_of(masses[k]))];
    return g.first_cell + static_cast<std::uint32_t>(g.row(slot_y_[k])) * static_cast<std::uint32_t>(g.columns) +
           static_cast<std::uint32_t>(g.column(slot_x_[k]));
  };
  by_cell_.sort(
      executor, drops.extent(), chunk_of(drops.extent()), cells, [&](std::int64_t i) { return slot_cell_[index(i)] = cell_of(index(i)); },
      [&](std::int64_t i) { return slot_cell_[index(i)]; });
  for (auto* a : {&x, &y, &radius, &mass}) a->resize(std::max(a->size(), index(count) + room_behind));
  for (auto* a : {&id, &slot}) a->resize(std::max(a->size(), index(count)));
  const std::span<const std::uint32_t> ids = drops.id();
  executor.for_range(static_cast<std::int64_t>(by_cell_.buckets()), 1, [&](std::int64_t b, std::int64_t) {
    const std::span<const BucketSort::Entry> entries = by_cell_[index(b)];
    const auto [first_cell, last_cell] = by_cell_.keys(index(b));
    std::vector<std::uint32_t> next(last_cell - first_cell + 1u, 0);
    for (const BucketSort::Entry& e : entries) ++next[e.key - first_cell + 1];
    next[0] = by_cell_.start(index(b));
    for (std::uint32_t c = first_cell; c < last_cell; ++c) {
      cell_start[c] = next[c - first_cell];
      next[c - first_cell + 1] += next[c - first_cell];
    }
    for (std::size_t k = 0; k < entries.size(); ++k) {
      if (k + ahead < entries.size()) {  // the slots are in random order
        const std::size_t soon = entries[k + ahead].element;
        for (const std::vector<float>* a : {&slot_x_, &slot_y_, &slot_radius_}) __builtin_prefetch(a->data() + soon);
        __builtin_prefetch(masses.data() + soon);
        __builtin_prefetch(ids.data() + soon);
      }
      const std::size_t from = entries[k].element, to = next[entries[k].key - first_cell]++;
      x[to] = slot_x_[from];
      y[to] = slot_y_[from];
      radius[to] = slot_radius_[from];
      mass[to] = masses[from];
      id[to] = ids[from];
      slot[to] = static_cast<std::uint32_t>(from);
    }
  });
  cell_start[cells] = static_cast<std::uint32_t>(count);
}

}  // namespace rainref::drops
