// Conversion of a record between bytes and the numbers of a pass. A record that passes change has static layout() and ranges(corrected).
// State holds its numbers in a text; each(state, f) calls f(number) for each float, in the order of declaration.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "scene/uniform_block.h"

namespace rainref::pass {

/// Offsets of the floats of a record, in the order of declaration, without padding [byte].
std::vector<std::size_t> float_offsets(const scene::UniformBlock& record);
template <class Record>
const std::vector<std::size_t>& float_offsets_of() {
  static const std::vector<std::size_t> all = float_offsets(Record::layout());
  return all;
}
/// One record, in the form of Host::Listed::columns.
template <class Record>
std::vector<float*> columns_of(Record& one) {
  std::vector<float*> all;
  for (const std::size_t at : float_offsets_of<Record>()) all.push_back(reinterpret_cast<float*>(reinterpret_cast<std::byte*>(&one) + at));
  return all;
}

template <class State, class Record>
State loaded(const Record& from) {
  State state;
  auto at = float_offsets_of<Record>().begin();
  State::each(state, [&](auto& number) {
    float stored;
    std::memcpy(&stored, reinterpret_cast<const std::byte*>(&from) + *at++, sizeof stored);
    number = std::remove_cvref_t<decltype(number)>::load(&stored);
  });
  return state;
}
/// The record with floats from numbers that have a value v; the rest is copied from `like`. Stored zeros are positive.
template <class State, class Record>
Record stored(const State& state, Record like) {
  auto at = float_offsets_of<Record>().begin();
  State::each(state, [&](const auto& number) {
    float value;
    // A number that tracks operations sees the store.
    if constexpr (requires { number.as_stored(); })
      value = number.as_stored().v + 0.0f;
    else
      value = number.v + 0.0f;
    std::memcpy(reinterpret_cast<std::byte*>(&like) + *at++, &value, sizeof value);
  });
  return like;
}
/// Bytes of the records, as a list of a case holds them.
template <class Record>
std::vector<std::byte> bytes_of(const std::vector<Record>& records) {
  std::vector<std::byte> bytes(records.size() * sizeof(Record));
  if (!records.empty()) std::memcpy(bytes.data(), records.data(), bytes.size());
  return bytes;
}

/// Returns why these ids are not valid for a list, or "": "in.drops: expected each id once, found 7 twice".
std::string ids_fault(std::string_view list, std::vector<std::uint32_t> ids);
template <class Record>
std::string ids_fault(std::string_view list, const std::vector<Record>& records) {
  std::vector<std::uint32_t> ids;
  for (const Record& r : records) ids.push_back(r.id);
  return ids_fault(list, std::move(ids));
}

}  // namespace rainref::pass
