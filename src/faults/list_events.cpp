// Mistakes in the events of records: appends, deaths, captures, merges.
#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "faults/list_faults.h"
#include "judge/evaluations.h"

namespace rainref::faults {
namespace {

using capture::PassCase;
using judge::evaluations_of;
using scene::Member;

/// Largest number of records for a mistake of a few records.
constexpr std::size_t most_of_few = 64;

/// The member that holds a record's mass, or null.
const Member* mass_of(const List& list) {
  const auto found = std::find_if(list.fields.begin(), list.fields.end(), [](const Member& m) {
    return m.name == "mass" && m.scalar == scene::Scalar::float32 && m.components == 1;
  });
  return found == list.fields.end() ? nullptr : &*found;
}
/// Ids that are in the input but not in the output.
Ids ended_in(const List& list, const PassCase& c, const Records& records) {
  std::set<std::uint32_t> have;
  for (const auto& r : records) have.insert(list.id_of(r));
  Ids out;
  for (const auto& [one, unused] : list.taken(c))
    if (!have.contains(one)) out.push_back(one);
  return out;
}

/// A record that ended, and the one that absorbed its mass: of the records that grew, the one whose growth fits best.
std::optional<std::array<std::uint32_t, 2>> captured_pair(const List& list, const PassCase& c, const Records& records) {
  const Member* mass = mass_of(list);
  if (!mass) return std::nullopt;
  const auto before = list.taken(c);
  std::optional<std::array<std::uint32_t, 2>> best;
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t ended : ended_in(list, c, records)) {
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

/// The pass's output for a record that is alone in the list.
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

/// The ids that a mistake of one record affects: the requested ones that are in the list, or one in its middle.
Ids present(const List& list, const ListEdit& e) {
  if (e.at.empty()) return e.records.empty() ? Ids() : Ids{list.id_of(e.records[e.records.size() / 2])};
  std::set<std::uint32_t> have;
  for (const auto& r : e.records) have.insert(list.id_of(r));
  return std::all_of(e.at.begin(), e.at.end(), [&](std::uint32_t id) { return have.contains(id); }) ? e.at : Ids();
}

}  // namespace

void add_events(ListAdder& a) {
  a.add(Kind::list_without_record, [](const List& list, const PassCase&, ListEdit& e) {
    const Ids at = present(list, e);
    const std::set<std::uint32_t> lost(at.begin(), at.end());
    std::erase_if(e.records, [&](const auto& r) { return lost.contains(list.id_of(r)); });
    return !at.empty();
  });
  a.add(Kind::list_with_twin, [](const List& list, const PassCase&, ListEdit& e) {
    const Ids at = present(list, e);
    const std::set<std::uint32_t> twice(at.begin(), at.end());
    for (std::size_t i = 0, n = e.records.size(); i < n; ++i) {
      if (!twice.contains(list.id_of(e.records[i]))) continue;
      const std::vector<std::byte> twin = e.records[i];
      e.records.push_back(twin);
    }
    return !at.empty();
  });
  a.add(Kind::list_with_ended, [](const List& list, const PassCase& c, ListEdit& e) {
    const Ids ended = ended_in(list, c, e.records);
    if (ended.empty()) return false;
    const auto before = list.taken(c);
    for (const std::uint32_t id : e.at.empty() ? Ids{ended[ended.size() / 2]} : e.at) {
      if (std::find(ended.begin(), ended.end(), id) == ended.end()) return false;
      e.records.push_back(before.at(id));
    }
    return true;
  });
  a.add(Kind::list_with_unmerged, [](const List& list, const PassCase& c, ListEdit& e) {
    const auto pair = e.at.size() > most_of_few ? std::nullopt : captured_pair(list, c, e.records);
    if (!pair) return false;
    const Ids ended = ended_in(list, c, e.records);
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
  // change(to, alone): for an absorbing drop; `alone` is its state without the capture.
  const auto of_absorbing = [&](const auto& change) {
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
  a.add(Kind::list_with_lost_capture, of_absorbing([](const List&, const auto& alone, auto& absorbing) { absorbing = alone; }));
  a.add(Kind::list_with_mass_of_before,
        of_absorbing([](const List& list, const auto& alone, auto& absorbing) { copy_member(*mass_of(list), alone, absorbing); }));
  a.add(Kind::list_with_untreated, [](const List& list, const PassCase& c, ListEdit& e) {
    constexpr std::size_t most = 16;  // with more records it is no coincidence
    if (e.at.size() > most) return false;
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

}  // namespace rainref::faults
