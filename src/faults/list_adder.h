// What mistakes in lists are made with: the parts of a list's records, and how a mistake is added.
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "faults/fault.h"
#include "faults/list_faults.h"

namespace rainref::faults {

using Ids = std::vector<std::uint32_t>;

inline std::uint32_t word_at(const std::vector<std::byte>& record, std::size_t offset) {
  std::uint32_t w;
  std::memcpy(&w, &record[offset], sizeof w);
  return w;
}
inline float float_at(const std::vector<std::byte>& record, std::size_t offset) {
  float f;
  std::memcpy(&f, &record[offset], sizeof f);
  return f;
}
inline void copy_member(const scene::Member& m, const std::vector<std::byte>& from, std::vector<std::byte>& to) {
  std::memcpy(&to[m.offset], &from[m.offset], m.size());
}
template <class Change>
void each_float(const scene::Member& m, std::vector<std::byte>& record, Change change) {
  for (int k = 0; k < m.components; ++k) {
    const std::size_t offset = m.offset + 4 * static_cast<std::size_t>(k);
    const float f = change(float_at(record, offset), k);
    std::memcpy(&record[offset], &f, sizeof f);
  }
}

/// What the mistakes in one list know of it.
struct List {
  std::size_t output;
  std::string name;
  scene::UniformBlock layout;
  std::size_t id = 0;
  std::vector<scene::Member> fields;  ///< without the id and padding

  /// Output `o` of the case.
  List(const capture::PassCase& c, std::size_t o);
  std::uint32_t id_of(const std::vector<std::byte>& record) const { return word_at(record, id); }
  void set_id(std::vector<std::byte>& record, std::uint32_t value) const { std::memcpy(&record[id], &value, sizeof value); }
  /// The list that the pass takes under the same name, by id.
  std::map<std::uint32_t, std::vector<std::byte>> taken(const capture::PassCase& c) const;
  /// The number of the record with this id; how many there are where none has it.
  std::size_t place(const Records& records, std::uint32_t of) const;
};

/// Adds mistakes in one list.
class Adder {
 public:
  Adder(std::vector<Fault>& out, List list) : out_(out), list_(std::move(list)) {}
  using Alter = std::function<bool(const List&, const capture::PassCase&, ListEdit&)>;

  /// `more`: what its words speak of beside the list.
  Fault& add(Kind kind, Alter alter, std::vector<std::string> more = {});
  const List& list() const { return list_; }

 private:
  std::vector<Fault>& out_;
  List list_;
};

/// A record too few, too many, in the wrong state.
void add_events(Adder& adder);

}  // namespace rainref::faults
