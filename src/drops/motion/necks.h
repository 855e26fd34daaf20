// Outlines of merged drops, kept between steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "drops/drops.h"
#include "drops/records.h"
#include "drops/uniforms.h"
#include "state/items.h"

namespace rainref::drops {

/// A drop that merges into another one, and that one, which remains: by their slots.
struct Joining {
  std::uint32_t into, slot;
};

/// The necks of the drops on a glass, at most one per drop, in ascending id.
class Necks {
 public:
  /// The pass. joining: for each drop that others merge into, the largest of these (of equal ones the lowest id), in any order. ended:
  /// slots of all drops that end, ascending.
  void step(const DropArrays& drops, const NecksUniforms& uniforms, std::span<const Joining> joining, std::span<const std::uint32_t> ended);
  /// The necks as records; valid until the next step.
  const std::vector<Neck>& list();
  void list_state(state::Items& items, std::int64_t most);

 private:
  void put(const Neck& neck, std::uint32_t slot);
  std::size_t size() const { return id_.size(); }
  void resize(std::size_t count);

  std::vector<float> numbers_[4];  ///< as in NeckState
  std::vector<std::uint32_t> id_, slot_;
  std::vector<Neck> listed_;
};

}  // namespace rainref::drops
