// The drops on a glass as a structure of arrays. A slot holds a drop or is free; a drop keeps its slot while it lives.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "drops/records.h"
#include "rainref/executor.h"
#include "state/items.h"

namespace rainref::drops {

/// Number of slots in one chunk of work. It depends on the number of slots alone, so that results and sums do not depend on the number of
/// threads. It gives enough chunks for many threads, each large enough to be worth scheduling, and at least a vector.
constexpr std::int64_t chunk_of(std::int64_t slots) { return std::clamp<std::int64_t>((slots / 64 + 511) / 512 * 512, 512, 16384); }

/// Totals of the water, in whole mass units. as-published counts drops instead.
/// spawned - evaporated - removed - film = water in the live drops, exactly.
struct MassBalance {
  std::int64_t spawned = 0;     ///< arrived, even without a free slot
  std::int64_t evaporated = 0;  ///< from drops and film
  std::int64_t removed = 0;     ///< ran off the glass, ended with its drop, or found no room
  std::int64_t to_film = 0;     ///< from drops to film, minus what returned or dried
  MassBalance& operator+=(const MassBalance& other);
  bool operator==(const MassBalance&) const = default;
};

/// Slot i holds a live drop if life()[i] > 0. The spans cover the slots up to extent(); a kernel may read, and write back unchanged, a
/// whole vector beyond their ends.
class DropArrays {
 public:
  DropArrays() = default;
  /// capacity in [1, most_slots]. Throws Error(usage) otherwise, or if there is not enough memory.
  explicit DropArrays(std::int64_t capacity);
  static constexpr std::int64_t most_slots = 100'000'000;
  static std::size_t memory_bytes(std::int64_t capacity);

  std::int64_t capacity() const { return capacity_; }
  /// Every live slot is below this.
  std::int64_t extent() const { return extent_; }

  std::span<float> u() { return floats(0); }  ///< glass coordinates
  std::span<float> v() { return floats(1); }
  std::span<float> velocity_u() { return floats(2); }  ///< [1/s]
  std::span<float> velocity_v() { return floats(3); }
  std::span<float> mass() { return floats(4); }  ///< see Drop::mass
  std::span<float> life() { return floats(5); }  ///< [s]
  std::span<std::uint32_t> id() { return {reinterpret_cast<std::uint32_t*>(array(6)), static_cast<std::size_t>(extent_)}; }
  std::span<const float> u() const { return floats(0); }
  std::span<const float> v() const { return floats(1); }
  std::span<const float> velocity_u() const { return floats(2); }
  std::span<const float> velocity_v() const { return floats(3); }
  std::span<const float> mass() const { return floats(4); }
  std::span<const float> life() const { return floats(5); }
  std::span<const std::uint32_t> id() const {
    return {reinterpret_cast<const std::uint32_t*>(array(6)), static_cast<std::size_t>(extent_)};
  }

  /// The same in the form of pass::Host::Listed: the floats of a Drop, in its order.
  std::vector<float*> columns() { return {array(0), array(1), array(2), array(3), array(4), array(5)}; }

  /// Reads and writes the record of a slot; set() needs i < extent().
  Drop get(std::int64_t i) const;
  void set(std::int64_t i, const Drop& drop);

  /// The id of the next drop. Each arrival raises it by one; after 2^32 arrivals it wraps.
  std::uint32_t next_id() const { return next_id_; }
  /// Puts the records, in order, into the free slots, lowest first, and returns the number placed. Sets next_id() to one more than the last
  /// record's id, placed or not.
  std::size_t place(std::span<const Drop> records);

  std::int64_t live() const;
  std::int64_t free_slots() const { return capacity_ - live(); }
  /// Mass units in the live drops.
  std::int64_t water() const { return water_in(0, extent_); }
  std::int64_t water(const parallel::Executor& executor) const;
  /// The records of the live drops, in slot order.
  void gather(std::vector<Drop>& out, const parallel::Executor& executor) const;
  /// Replaces all drops: record i goes into slot i, including dead ones. Sets next_id() to one more than the largest id. Throws
  /// Error(port_files) if there are more records than slots, or a number in them is not finite.
  void assign(std::span<const Drop> records);
  /// Frees every slot; ids start at 0.
  void clear() { extent_ = 0, next_id_ = 0; }
  /// The slots up to extent(), including dead ones, and next_id().
  void list_state(state::Items& items);

 private:
  struct Free {
    void operator()(std::byte* p) const;
  };
  std::int64_t water_in(std::int64_t begin, std::int64_t end) const;
  /// Sets the extent to this many slots, all free.
  void empty(std::int64_t extent);
  float* array(int field) const { return reinterpret_cast<float*>(memory_.get() + static_cast<std::size_t>(field) * stride_); }
  std::span<float> floats(int field) { return {array(field), static_cast<std::size_t>(extent_)}; }
  std::span<const float> floats(int field) const { return {array(field), static_cast<std::size_t>(extent_)}; }

  std::int64_t capacity_ = 0, extent_ = 0;
  std::uint32_t next_id_ = 0;
  std::size_t stride_ = 0;  ///< distance between arrays [byte]
  std::unique_ptr<std::byte, Free> memory_;
};

}  // namespace rainref::drops
