// Mistakes in a list of records matched by id: in an append, a compaction or a struct of arrays.
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

/// Converts a list to records and back; array_of() takes everything but the records from `like`.
Records records_of(const capture::Array& list);
capture::Array array_of(const Records& records, const capture::Array& like);
/// The key of a record whose layout has one.
std::uint32_t id_of(const std::vector<std::byte>& record, const scene::UniformBlock& layout);

/// Adds mistakes in the case's keyed lists. `before`: the previous run of the same pass, or null.
void add_list_faults(std::vector<Fault>& out, const capture::PassCase& c, const capture::PassCase* before);
/// Literals and uniforms that a model uses for at least every other record of a keyed list. Sorted.
std::vector<float> constants_of_lists(const capture::PassModel& model, const capture::PassCase& c);

/// The list that a port with this mistake would store in place of `finished`, the reference's c.outputs[output] in the order of the port's
/// slots. `at`: the ids that a mistake of few records affects; empty: some that show it. `port`: what a port stored, for mistakes that are
/// fitted to it; null: none. Nothing if the mistake does not concern the list or is impossible here. Throws Error if the altered case
/// cannot be bound. `model` may be null.
std::optional<capture::Array> faulty_list(const Fault& d, const capture::PassCase& c, std::size_t output,
                                          const capture::PassEvaluations& evaluations, const capture::PassModel* model,
                                          const capture::Array& finished, const std::vector<std::uint32_t>& at = {},
                                          const Records* port = nullptr);
/// The bytes of a list in which a mistake is made, which must not change the case. `trace`: collects its operations; null: nothing does.
std::optional<std::vector<std::byte>> evaluated(const Fault& d, const capture::KeyedModel& keyed, perturbed::Trace* trace = nullptr);

// ---- helpers of the generators

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

/// A list with the data that its mistakes need.
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
  /// Records by id of the input list of the same name.
  std::map<std::uint32_t, std::vector<std::byte>> taken(const capture::PassCase& c) const;
  /// Index of the record with this id; the number of records if there is none.
  std::size_t place(const Records& records, std::uint32_t of) const;
};

/// Adds mistakes in one list.
class ListAdder {
 public:
  ListAdder(std::vector<Fault>& out, List list) : out_(out), list_(std::move(list)) {}
  using Alter = std::function<bool(const List&, const capture::PassCase&, ListEdit&)>;

  /// `more`: names in its text besides the list.
  Fault& add(Kind kind, Alter alter, std::vector<std::string> more = {});
  const List& list() const { return list_; }

 private:
  std::vector<Fault>& out_;
  List list_;
};

/// Adds: a record too few, too many, or in the wrong state.
void add_events(ListAdder& adder);

}  // namespace rainref::faults
