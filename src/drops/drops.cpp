#include "drops/drops.h"

#include <atomic>
#include <cstring>
#include <new>

#include <fmt/format.h>

#include "base/memory.h"
#include "rainref/error.h"

namespace rainref::drops {
namespace {

constexpr std::size_t alignment = 64;
constexpr int fields = 7;
constexpr std::int64_t padding_slots = 64;  // more than a vector after the last slot

// An odd number of cache lines, so that the seven streams use different cache sets.
std::size_t stride_bytes(std::int64_t capacity) {
  const std::size_t lines = (static_cast<std::size_t>(capacity + padding_slots) * sizeof(float) + alignment - 1) / alignment;
  return (lines | 1) * alignment;
}

}  // namespace

MassBalance& MassBalance::operator+=(const MassBalance& other) {
  spawned += other.spawned;
  evaporated += other.evaporated;
  removed += other.removed;
  to_film += other.to_film;
  return *this;
}

void DropArrays::Free::operator()(std::byte* p) const { ::operator delete (p, std::align_val_t{alignment}); }

std::size_t DropArrays::memory_bytes(std::int64_t capacity) { return fields * stride_bytes(capacity); }

DropArrays::DropArrays(std::int64_t capacity) : capacity_(capacity) {
  if (capacity < 1 || capacity > most_slots) {
    throw Error(ExitCode::usage, fmt::format("capacity for drops: expected a number from 1 to {}, found {}", most_slots, capacity));
  }
  stride_ = stride_bytes(capacity);
  memory_.reset(static_cast<std::byte*>(::operator new (memory_bytes(capacity), std::align_val_t{alignment}, std::nothrow)));
  if (!memory_)
    throw Error(ExitCode::usage, fmt::format("{} drops: {} of memory could not be had", capacity, memory_text(memory_bytes(capacity))));
  std::memset(memory_.get(), 0, memory_bytes(capacity));
}

Drop DropArrays::get(std::int64_t i) const {
  const auto k = static_cast<std::size_t>(i);
  return {{u()[k], v()[k]}, {velocity_u()[k], velocity_v()[k]}, mass()[k], life()[k], id()[k], 0};
}

void DropArrays::set(std::int64_t i, const Drop& drop) {
  const auto k = static_cast<std::size_t>(i);
  u()[k] = drop.position[0];
  v()[k] = drop.position[1];
  velocity_u()[k] = drop.velocity[0];
  velocity_v()[k] = drop.velocity[1];
  mass()[k] = drop.mass;
  life()[k] = drop.life;
  id()[k] = drop.id;
}

std::size_t DropArrays::place(std::span<const Drop> records) {
  std::size_t placed = 0;
  const float* lives = array(5);
  for (std::int64_t i = 0; i < capacity_ && placed < records.size(); ++i) {
    if (i < extent_ && lives[i] > 0) continue;
    extent_ = std::max(extent_, i + 1);
    set(i, records[placed++]);
  }
  if (!records.empty()) next_id_ = records.back().id + 1;
  return placed;
}

std::int64_t DropArrays::live() const {
  return std::count_if(life().begin(), life().end(), [](float x) { return x > 0; });
}

std::int64_t DropArrays::water_in(std::int64_t begin, std::int64_t end) const {
  const std::span<const float> lives = life(), masses = mass();
  std::int64_t sum = 0;
  for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
    sum += lives[i] > 0 ? static_cast<std::int64_t>(masses[i]) : 0;
  return sum;
}
std::int64_t DropArrays::water(const parallel::Executor& executor) const {
  std::atomic<std::int64_t> sum{0};  // integers, so the order does not matter
  executor.for_range(extent_, chunk_of(extent_),
                     [&](std::int64_t begin, std::int64_t end) { sum.fetch_add(water_in(begin, end), std::memory_order_relaxed); });
  return sum;
}

void DropArrays::gather(std::vector<Drop>& out, const parallel::Executor& executor) const {
  // Each chunk counts its drops, then writes them after those of the previous chunks.
  const std::int64_t chunk = chunk_of(extent_);
  std::vector<std::size_t> first(static_cast<std::size_t>((extent_ + chunk - 1) / chunk) + 1, 0);
  const std::span<const float> lives = life();
  executor.for_range(extent_, chunk, [&](std::int64_t begin, std::int64_t end) {
    first[static_cast<std::size_t>(begin / chunk) + 1] =
        static_cast<std::size_t>(std::count_if(lives.begin() + begin, lives.begin() + end, [](float x) { return x > 0; }));
  });
  for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
  out.resize(first.back());
  executor.for_range(extent_, chunk, [&](std::int64_t begin, std::int64_t end) {
    Drop* to = out.data() + first[static_cast<std::size_t>(begin / chunk)];
    for (std::int64_t i = begin; i < end; ++i) {
      if (lives[static_cast<std::size_t>(i)] > 0) *to++ = get(i);
    }
  });
}

void DropArrays::empty(std::int64_t extent) {
  std::memset(memory_.get(), 0, memory_bytes(capacity_));
  extent_ = extent;
}

void DropArrays::list_state(state::Items& items) {
  const auto slots =
      std::make_shared<state::Length>(state::Length{static_cast<std::uint64_t>(extent_), static_cast<std::uint64_t>(capacity_),
                                                    [this](std::uint64_t extent) { empty(static_cast<std::int64_t>(extent)); }});
  // Wider than any drop reaches, and such that the next steps stay finite.
  constexpr state::Range motion{-1e6, 1e6}, mass{0, most_mass}, life{-1e9, 1e9};
  constexpr const char* names[] = {"u", "v", "velocity_u", "velocity_v", "mass", "life", "id"};
  for (int field = 0; field < fields; ++field)
    items.array(names[field], field == 6 ? state::Type::u32 : state::Type::f32,
                field < 4    ? motion
                : field == 4 ? mass
                             : life,
                slots, [this, field] { return array(field); });
  items.number("next_id", next_id_);
}

void DropArrays::assign(std::span<const Drop> records) {
  if (records.size() > static_cast<std::size_t>(capacity_)) {
    throw Error(ExitCode::port_files, fmt::format("drops: expected at most {} records, found {}", capacity_, records.size()));
  }
  clear();
  extent_ = static_cast<std::int64_t>(records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    const Drop& d = records[i];
    for (const float x : {d.position[0], d.position[1], d.velocity[0], d.velocity[1], d.mass, d.life}) {
      if (!(x - x == 0)) {
        clear();
        throw Error(ExitCode::port_files, fmt::format("drops: expected finite numbers, found {} in record {} (id {})", x, i, d.id));
      }
    }
    set(static_cast<std::int64_t>(i), d);
    next_id_ = std::max(next_id_, d.id + 1);
  }
}

}  // namespace rainref::drops
