// Mistakes in a list of records matched by their ids: what an append, a compaction or a struct of arrays gets wrong.
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "capture/pass_model.h"
#include "faults/fault.h"

namespace rainref::faults {

/// Of a list and back; array_of() takes everything but the records from `like`.
Records records_of(const capture::Array& list);
capture::Array array_of(const Records& records, const capture::Array& like);
/// The key of a record whose layout has one.
std::uint32_t id_of(const std::vector<std::byte>& record, const scene::UniformBlock& layout);

/// Adds the mistakes that can be made in the case's keyed lists. `before`: the run of the same pass before, or null.
void add_list_faults(std::vector<Fault>& out, const capture::PassCase& c, const capture::PassCase* before);
/// Literals and uniforms that a model meets for at least every other record of a keyed list. Sorted.
std::vector<float> constants_of_lists(const capture::PassModel& model, const capture::PassCase& c);

/// The list that a port with this mistake stores in place of `finished`, which is c.outputs[output] as the reference gives
/// it, in the order of the port's slots. `at`: the ids to which a mistake of few records happens; empty: some that show
/// it. `port`: what a port stored, for mistakes that are fitted to it; null: none. Nothing where the mistake does not
/// concern the list or cannot happen here. Throws Error when the altered case cannot be bound. `model` may be null.
std::optional<capture::Array> faulty_list(const Fault& d, const capture::PassCase& c, std::size_t output,
                                          const capture::PassEvaluations& evaluations, const capture::PassModel* model,
                                          const capture::Array& finished, const std::vector<std::uint32_t>& at = {},
                                          const Records* port = nullptr);

// ---- what they are made with

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
class ListAdder {
 public:
  ListAdder(std::vector<Fault>& out, List list) : out_(out), list_(std::move(list)) {}
  using Alter = std::function<bool(const List&, const capture::PassCase&, ListEdit&)>;

  /// `more`: what its words speak of beside the list.
  Fault& add(Kind kind, Alter alter, std::vector<std::string> more = {});
  const List& list() const { return list_; }

 private:
  std::vector<Fault>& out_;
  List list_;
};

/// A record too few, too many, in the wrong state.
void add_events(ListAdder& adder);

}  // namespace rainref::faults
