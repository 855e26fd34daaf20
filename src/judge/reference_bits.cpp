#include "judge/reference_bits.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "judge/reference_outputs.h"
#include "math/scalar.h"

namespace rainref::judge {

using capture::Array;

namespace {

/// Whether all floats are below the largest, as Slot::is_same asks of each. Word: as many bits as a float has.
template <class Word>
bool are_below_largest(const std::byte* at, std::size_t count, Word largest) {
  constexpr auto magnitude = static_cast<Word>(static_cast<Word>(~Word{0}) >> 1);
  bool are_below = true;
  for (std::size_t k = 0; k < count; ++k) {
    Word bits;
    std::memcpy(&bits, at + k * sizeof bits, sizeof bits);
    are_below &= static_cast<Word>(bits & magnitude) < largest;
  }
  return are_below;
}

}  // namespace

ReferenceBits::ReferenceBits(const capture::PassCase& c, const capture::PassModel& model, const std::vector<Array>& port,
                             const std::vector<Slot>& slots, const std::vector<HalfMode>& modes)
    : case_(c), model_(model), port_(port), slots_(slots), modes_(modes) {}

bool ReferenceBits::has_reference(std::size_t mode) const { return is_own_rounding(slots_, modes_[mode]) || !model_.rounds_inside(); }

std::array<bool, 2> ReferenceBits::stores(int x, int y) const {
  thread_local std::vector<scalar::Scalar<float>> values;
  values.resize(slots_.size());
  model_.evaluate(x, y, values.data());
  std::array<bool, 2> all{};
  for (std::size_t m = 0; m < std::min<std::size_t>(2, modes_.size()); ++m)
    all[m] = has_reference(m) && std::equal(slots_.begin(), slots_.end(), values.begin(), [&](const Slot& s, const auto& value) {
               std::array<std::byte, 4> stored{};
               store_value(s, value.v, rounding_of(s, modes_[m]), stored.data());
               return s.is_same(stored.data(), s.at(port_[static_cast<std::size_t>(s.output)], x, y));
             });
  return all;
}
void ReferenceBits::prepare(const parallel::Executor& executor, std::size_t leading, bool every) {
  for (std::size_t m = 0; m < std::min<std::size_t>(2, modes_.size()); ++m)
    if ((every || m == leading) && has_reference(m) && !is_own_rounding(slots_, modes_[m]))
      other_[m] = reference_outputs(case_, model_, executor, modes_[m]);
}

template <class ArrayOf>
bool ReferenceBits::equals(const ArrayOf& reference, int x, int y) const {
  return std::all_of(slots_.begin(), slots_.end(), [&](const Slot& s) {
    const auto o = static_cast<std::size_t>(s.output);
    return s.is_same(s.at(reference(o), x, y), s.at(port_[o], x, y));
  });
}
bool ReferenceBits::has(std::size_t mode, int x, int y) const {
  const auto is_own_stored = [&] { return equals([&](std::size_t o) -> const Array& { return case_.outputs[o].array; }, x, y); };
  const auto is_other_stored = [&](std::size_t m) {
    return !other_[m].empty() && equals([&](std::size_t o) -> const Array& { return other_[m][o]; }, x, y);
  };
  if (modes_[mode] == HalfMode::either) return is_own_stored() || is_other_stored(0) || is_other_stored(1);
  return is_own_rounding(slots_, modes_[mode]) ? is_own_stored() : is_other_stored(mode);
}

bool ReferenceBits::have_expected(int x, int y, int count) const {
  return std::all_of(slots_.begin(), slots_.end(), [&](const Slot& s) {
    if (s.channel != 0) return true;  // the first stands for all of its output
    const auto o = static_cast<std::size_t>(s.output);
    const std::byte* const given = s.at(port_[o], x, y);
    const auto bytes = static_cast<std::size_t>(count) * static_cast<std::size_t>(s.texel_bytes);
    if (std::memcmp(given, s.at(case_.outputs[o].array, x, y), bytes) != 0) return false;
    if (s.kind == FormatInfo::float16) return are_below_largest<std::uint16_t>(given, bytes / 2, 0x7bff);
    return s.kind != FormatInfo::float32 || are_below_largest<std::uint32_t>(given, bytes / 4, 0x7f7fffff);
  });
}

}  // namespace rainref::judge
