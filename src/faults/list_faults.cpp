#include "faults/list_faults.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "judge/evaluations.h"
#include "judge/keyed.h"
#include "math/half.h"
#include "rainref/error.h"

namespace rainref::faults {
namespace {

using capture::Array;
using capture::PassCase;
using judge::evaluations_of;
using judge::keyed_outputs;
using scene::Member;
using Ids = std::vector<std::uint32_t>;

/// Mistakes of a few records are those of at most so many.
constexpr std::size_t most_of_few = 64;

std::uint32_t word_at(const std::vector<std::byte>& record, std::size_t offset) {
  std::uint32_t w;
  std::memcpy(&w, &record[offset], sizeof w);
  return w;
}
float float_at(const std::vector<std::byte>& record, std::size_t offset) {
  float f;
  std::memcpy(&f, &record[offset], sizeof f);
  return f;
}
void copy_member(const Member& m, const std::vector<std::byte>& from, std::vector<std::byte>& to) {
  std::memcpy(&to[m.offset], &from[m.offset], m.size());
}
template <class Change>
void each_float(const Member& m, std::vector<std::byte>& record, Change change) {
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
  std::vector<Member> fields;  ///< without the id and padding

  List(const PassCase& c, std::size_t o) : output(o), name(c.outputs[o].name), layout(c.outputs[o].array.record) {
    for (const Member& m : layout.members) {
      if (m.name == "id")
        id = m.offset;
      else if (!m.name.starts_with("padding"))
        fields.push_back(m);
    }
  }
  std::uint32_t id_of(const std::vector<std::byte>& record) const { return word_at(record, id); }
  void set_id(std::vector<std::byte>& record, std::uint32_t value) const { std::memcpy(&record[id], &value, sizeof value); }
  /// The list that the pass takes under the same name, by id.
  std::map<std::uint32_t, std::vector<std::byte>> taken(const PassCase& c) const {
    std::map<std::uint32_t, std::vector<std::byte>> out;
    const capture::CaseInput* in = c.input(name);
    if (!in || !in->array.is_records || in->array.record.size != layout.size) return out;
    for (std::vector<std::byte>& r : records_of(in->array)) out.emplace(id_of(r), std::move(r));
    return out;
  }
  const Member* mass() const {
    const auto found = std::find_if(fields.begin(), fields.end(), [](const Member& m) {
      return m.name == "mass" && m.scalar == scene::Scalar::float32 && m.components == 1;
    });
    return found == fields.end() ? nullptr : &*found;
  }
  std::size_t place(const Records& records, std::uint32_t of) const {
    return static_cast<std::size_t>(std::find_if(records.begin(), records.end(), [&](const auto& r) { return id_of(r) == of; }) -
                                    records.begin());
  }
  /// Ids that the pass took and does not give.
  Ids ended(const PassCase& c, const Records& records) const {
    std::set<std::uint32_t> have;
    for (const auto& r : records) have.insert(id_of(r));
    Ids out;
    for (const auto& [one, unused] : taken(c))
      if (!have.contains(one)) out.push_back(one);
    return out;
  }
};

/// A record that ended, and the one that took up its mass: of those that grew the one whose growth fits best.
std::optional<std::array<std::uint32_t, 2>> captured_pair(const List& list, const PassCase& c, const Records& records) {
  const Member* mass = list.mass();
  if (!mass) return std::nullopt;
  const auto before = list.taken(c);
  std::optional<std::array<std::uint32_t, 2>> best;
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t ended : list.ended(c, records)) {
    const double lost = float_at(before.at(ended), mass->offset);
    for (const auto& r : records) {
      const auto old = before.find(list.id_of(r));
      if (old == before.end()) continue;
      const double gained = static_cast<double>(float_at(r, mass->offset)) - float_at(old->second, mass->offset);
      const double off = std::abs(gained - lost);
      if (!(gained > 0) || off >= least) continue;
      least = off;
      best = {ended, list.id_of(r)};
    }
  }
  return best;
}

/// What the pass gives for a record that is alone in the list.
std::optional<std::vector<std::byte>> as_if_alone(const List& list, const PassCase& c, std::uint32_t id) {
  const capture::PassEvaluations* evaluations = evaluations_of(c.effect, c.pass);
  const auto before = list.taken(c);
  if (!evaluations || !evaluations->bind || !before.contains(id)) return std::nullopt;
  PassCase alone = c;
  for (capture::CaseInput& input : alone.inputs)
    if (input.name == list.name) input.array = array_of({before.at(id)}, input.array);
  const std::unique_ptr<capture::PassModel> model = evaluations->bind(alone);
  const capture::KeyedModel* keyed = model->keyed(list.name);
  const auto bytes = keyed ? keyed->reference() : std::nullopt;
  if (!bytes || bytes->size() != list.layout.size) return std::nullopt;
  return *bytes;
}

class Adder {
 public:
  Adder(std::vector<Deviation>& out, List list) : out_(out), list_(std::move(list)) {}
  using Alter = std::function<bool(const List&, const PassCase&, ListEdit&)>;

  Deviation& add(const std::string& name, std::string sentence, Alter alter) {
    Deviation d;
    d.name = fmt::format("{} {}", list_.name, name);
    d.sentence = std::move(sentence);
    d.list_output = static_cast<int>(list_.output);
    d.alter_list = [list = list_, alter](const PassCase& c, ListEdit& e) { return alter(list, c, e); };
    return out_.emplace_back(std::move(d));
  }
  const List& list() const { return list_; }

 private:
  std::vector<Deviation>& out_;
  List list_;
};

/// The ids that a mistake of one record happens to: those asked for that are in the list, or one in its middle.
Ids present(const List& list, const ListEdit& e) {
  if (e.at.empty()) return e.records.empty() ? Ids() : Ids{list.id_of(e.records[e.records.size() / 2])};
  std::set<std::uint32_t> have;
  for (const auto& r : e.records) have.insert(list.id_of(r));
  return std::all_of(e.at.begin(), e.at.end(), [&](std::uint32_t id) { return have.contains(id); }) ? e.at : Ids();
}

// ---- a record too few, too many, in the wrong state ----------------------------------------------------------------
void add_events(Adder& a) {
  a.add("without a record", "an append is lost: two threads took one slot, or the counter is not atomic",
        [](const List& list, const PassCase&, ListEdit& e) {
          const Ids at = present(list, e);
          const std::set<std::uint32_t> lost(at.begin(), at.end());
          std::erase_if(e.records, [&](const auto& r) { return lost.contains(list.id_of(r)); });
          return !at.empty();
        });
  a.add("with a record twice", "one record is appended by two threads, or a slot is not cleared when its record moves",
        [](const List& list, const PassCase&, ListEdit& e) {
          const Ids at = present(list, e);
          const std::set<std::uint32_t> twice(at.begin(), at.end());
          for (std::size_t i = 0, n = e.records.size(); i < n; ++i) {
            if (!twice.contains(list.id_of(e.records[i]))) continue;
            const std::vector<std::byte> twin = e.records[i];
            e.records.push_back(twin);
          }
          return !at.empty();
        });
  a.add("with an ended record still alive", "a record that died or was captured stays in the list as it was",
        [](const List& list, const PassCase& c, ListEdit& e) {
          const Ids ended = list.ended(c, e.records);
          if (ended.empty()) return false;
          const auto before = list.taken(c);
          for (const std::uint32_t id : e.at.empty() ? Ids{ended[ended.size() / 2]} : e.at) {
            if (std::find(ended.begin(), ended.end(), id) == ended.end()) return false;
            e.records.push_back(before.at(id));
          }
          return true;
        });
  a.add("with an unmerged pair", "records that should have merged went on each by itself",
        [](const List& list, const PassCase& c, ListEdit& e) {
          const auto pair = e.at.size() > most_of_few ? std::nullopt : captured_pair(list, c, e.records);
          if (!pair) return false;
          const Ids ended = list.ended(c, e.records);
          bool some_ended = false, some_go_on = false;
          for (const std::uint32_t id : e.at.empty() ? Ids(pair->begin(), pair->end()) : e.at) {
            const auto alone = as_if_alone(list, c, id);
            if (!alone) return false;
            const std::size_t place = list.place(e.records, id);
            const bool has_ended = place == e.records.size();
            (has_ended ? some_ended : some_go_on) = true;
            if (has_ended)
              e.records.push_back(*alone);
            else
              e.records[place] = *alone;
          }
          return some_ended && some_go_on;
        });
  // change(to, alone): of a absorber, by what it would be had it captured nothing.
  const auto of_absorbers = [&](const auto& change) {
    return [change](const List& list, const PassCase& c, ListEdit& e) {
      const auto pair = e.at.size() > most_of_few ? std::nullopt : captured_pair(list, c, e.records);
      if (!pair) return false;
      for (const std::uint32_t id : e.at.empty() ? Ids{(*pair)[1]} : e.at) {
        const auto alone = as_if_alone(list, c, id);
        const std::size_t place = list.place(e.records, id);
        if (!alone || place == e.records.size()) return false;
        change(list, *alone, e.records[place]);
      }
      return true;
    };
  };
  a.add("with a capture that is lost", "a captured record ends, and its absorber goes on as if alone: what it had is lost",
        of_absorbers([](const List&, const auto& alone, auto& absorber) { absorber = alone; }));
  a.add("with the mass of before a capture", "a absorber takes over the motion of what it captures, but not its mass",
        of_absorbers([](const List& list, const auto& alone, auto& absorber) { copy_member(*list.mass(), alone, absorber); }));
  a.add("with a record not treated", "the pass leaves out a record that it should have changed",
        [](const List& list, const PassCase& c, ListEdit& e) {
          const auto before = list.taken(c);
          const std::set<std::uint32_t> at(e.at.begin(), e.at.end());
          std::size_t found = 0;
          for (auto& r : e.records) {
            const auto old = before.find(list.id_of(r));
            if (old == before.end() || (at.empty() ? found > 0 || old->second == r : !at.contains(list.id_of(r)))) continue;
            r = old->second;
            ++found;
          }
          return found > 0 && found >= at.size();
        });
}

// ---- ids and slots -------------------------------------------------------------------------------------------------
/// Gives the failing ids the records that the port has for them, as far as these are among the right ones.
void permute_as_port(const List& list, ListEdit& e) {
  std::vector<std::size_t> places;
  for (const std::uint32_t id : e.at)
    if (const std::size_t place = list.place(e.records, id); place < e.records.size()) places.push_back(place);
  const Records right = e.records;
  const auto apart = [&](const std::vector<std::byte>& a, const std::vector<std::byte>& b) {
    double sum = 0;
    for (const Member& m : list.fields)
      for (int k = 0; k < m.components; ++k) {
        const std::size_t at = m.offset + 4 * static_cast<std::size_t>(k);
        const double x = m.scalar == scene::Scalar::float32 ? float_at(a, at) : word_at(a, at),
                     y = m.scalar == scene::Scalar::float32 ? float_at(b, at) : word_at(b, at);
        const double scale = std::max(std::abs(x), std::abs(y));
        if (x != y) sum += scale > 0 ? std::abs(x - y) / scale : 0;
      }
    return sum;
  };
  std::set<std::size_t> free(places.begin(), places.end());
  for (const std::size_t place : places) {
    const std::uint32_t id = list.id_of(right[place]);
    const std::size_t theirs = list.place(*e.port, id);
    if (theirs == e.port->size() || free.empty()) continue;
    std::size_t best = *free.begin();
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t p : free) {
      const double far = apart(right[p], (*e.port)[theirs]);
      if (far < least) least = far, best = p;
    }
    free.erase(best);
    e.records[place] = right[best];
    list.set_id(e.records[place], id);
  }
}

void add_orders(Adder& a) {
  a.add("in another order", "slots are filled in another order: records are matched by id", [](const List&, const PassCase&, ListEdit& e) {
     std::reverse(e.records.begin(), e.records.end());
     return e.records.size() > 1;
   }).legal = true;
  a.add("under permuted ids", "the records are right, under each other's ids: keys and fields are sorted or compacted apart",
        [](const List& list, const PassCase&, ListEdit& e) {
          constexpr std::size_t most = 1024;  // each is compared with each
          if (e.port) {
            if (e.at.size() > most) return false;
            permute_as_port(list, e);
            return true;
          }
          Ids ids;
          for (const auto& r : e.records) ids.push_back(list.id_of(r));
          for (std::size_t i = 0; i < e.records.size(); ++i) list.set_id(e.records[i], ids[ids.size() - 1 - i]);
          return e.records.size() > 1;
        });
  for (const std::size_t by : {1, -1}) {
    Deviation& d = a.add(by == 1 ? "one slot off" : "one slot off, other way", "an id has the fields of the slot beside it",
                         [by](const List& list, const PassCase&, ListEdit& e) {
                           const Records right = e.records;
                           const std::size_t n = right.size();
                           for (std::size_t i = 0; i < n; ++i) {
                             e.records[i] = right[(i + n + by) % n];
                             list.set_id(e.records[i], list.id_of(right[i]));
                           }
                           return n > 1;
                         });
    d.for_diagnosis = by != 1;
  }
  a.add("with ids one too large", "ids count from 1, or the id is taken after the counter was raised",
        [](const List& list, const PassCase&, ListEdit& e) {
          for (auto& r : e.records) list.set_id(r, list.id_of(r) + 1);
          return !e.records.empty();
        });
  a.add("without its last record", "the dispatch is one short", [](const List&, const PassCase&, ListEdit& e) {
    if (e.records.empty()) return false;
    e.records.pop_back();
    return true;
  });
  a.add("without the last partial workgroup", "records beyond the last whole workgroup of 64 are not written",
        [](const List&, const PassCase&, ListEdit& e) {
          const std::size_t whole = e.records.size() / 64 * 64;
          const bool some = whole < e.records.size();
          e.records.resize(whole);
          return some;
        });
  a.add("not written", "the list stays empty", [](const List&, const PassCase&, ListEdit& e) {
    const bool some = !e.records.empty();
    e.records.clear();
    return some;
  });
}

// ---- fields --------------------------------------------------------------------------------------------------------
void add_fields(Adder& a, bool has_input) {
  for (const Member& m : a.list().fields) {
    for (const std::size_t by : {1, -1}) {
      Deviation& d = a.add(fmt::format("with the {} of the {} slot", m.name, by == 1 ? "next" : "previous"),
                           fmt::format("{} is read or written one slot off", m.name), [m, by](const List&, const PassCase&, ListEdit& e) {
                             const Records right = e.records;
                             const std::size_t n = right.size();
                             for (std::size_t i = 0; i < n; ++i) copy_member(m, right[(i + n + by) % n], e.records[i]);
                             return n > 1;
                           });
      d.for_diagnosis = by != 1;
    }
    if (has_input) {
      a.add(fmt::format("with stale {}", m.name), fmt::format("{} is that of before the pass", m.name),
            [m](const List& list, const PassCase& c, ListEdit& e) {
              const auto before = list.taken(c);
              for (auto& r : e.records)
                if (const auto old = before.find(list.id_of(r)); old != before.end()) copy_member(m, old->second, r);
              return true;
            });
    }
    if (m.scalar != scene::Scalar::float32) continue;
    a.add(fmt::format("without {}", m.name), fmt::format("{} is not stored", m.name), [m](const List&, const PassCase&, ListEdit& e) {
       for (auto& r : e.records) each_float(m, r, [](float, int) { return 0.0f; });
       return true;
     }).for_diagnosis = true;
    for (int k = 0; k < m.components; ++k) {
      const std::string part = m.components == 1 ? m.name : fmt::format("{}.{}", m.name, "xyzw"[k]);
      a.add(fmt::format("with {} negated", part), fmt::format("{} has the other sign: the axis points the other way", part),
            [m, k](const List&, const PassCase&, ListEdit& e) {
              for (auto& r : e.records) each_float(m, r, [k](float f, int at) { return at == k && f != 0 ? -f : f; });
              return true;
            });
    }
    if (m.components > 1) {
      a.add(fmt::format("with the components of {} exchanged", m.name), fmt::format("x and y of {} are exchanged", m.name),
            [m](const List&, const PassCase&, ListEdit& e) {
              for (auto& r : e.records) {
                const std::vector<std::byte> right = r;
                each_float(m, r,
                           [&](float f, int at) { return at < 2 ? float_at(right, m.offset + 4 * static_cast<std::size_t>(1 - at)) : f; });
              }
              return true;
            });
    }
  }
  a.add("through half", "the fields have half precision", [](const List& list, const PassCase&, ListEdit& e) {
    for (auto& r : e.records)
      for (const Member& m : list.fields)
        if (m.scalar == scene::Scalar::float32) each_float(m, r, [](float f, int) { return to_float(to_half(f)); });
    return true;
  });
}

// ---- time ----------------------------------------------------------------------------------------------------------
void add_times(std::vector<Deviation>& out, Adder& a, const PassCase& c, bool has_input, const PassCase* before) {
  const std::string name = a.list().name;
  if (has_input) {
    a.add("one step late", "the list is that of before the pass: a missing swap or a stale binding",
          [](const List& list, const PassCase& taken, ListEdit& e) {
            const capture::CaseInput* in = taken.input(list.name);
            e.records = records_of(in->array);
            return true;
          });
    Deviation twice;
    twice.name = fmt::format("{} one step early", name);
    twice.sentence = "the pass runs twice in a step";
    twice.alter_case = [name, gave = c.outputs[a.list().output].array](PassCase& altered) {
      for (capture::CaseInput& i : altered.inputs)
        if (i.name == name) i.array = gave;
    };
    out.push_back(std::move(twice));
  }
  if (const capture::CaseOutput* old = before ? before->output(name) : nullptr; old && old->array.is_records) {
    a.add("stale", "the list is that of the run before", [stale = old->array](const List&, const PassCase&, ListEdit& e) {
      e.records = records_of(stale);
      return true;
    });
  }
}

}  // namespace

void add_list_faults(std::vector<Deviation>& out, const PassCase& c, const PassCase* before) {
  for (const std::size_t o : keyed_outputs(c)) {
    Adder a(out, List(c, o));
    const capture::CaseInput* in = c.input(c.outputs[o].name);
    const bool has_input = in && in->array.is_records && in->array.record.size == c.outputs[o].array.record.size;
    // Of mistakes that give the same bits the first one is named: all of a list before some of it.
    add_times(out, a, c, has_input, before);
    add_orders(a);
    add_fields(a, has_input);
    add_events(a);
  }
}

}  // namespace rainref::faults
