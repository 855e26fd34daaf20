#include "faults/list_faults.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "faults/members.h"
#include "judge/keyed.h"
#include "math/half.h"

namespace rainref::faults {
namespace {

using capture::PassCase;
using judge::keyed_outputs;
using scene::Member;

// ---- ids and slots -------------------------------------------------------------------------------------------------
/// Replaces the records of failing ids by the port's, if those are among the correct records.
void permute_as_port(const List& list, ListEdit& e) {
  std::vector<std::size_t> places;
  for (const std::uint32_t id : e.at)
    if (const std::size_t place = list.place(e.records, id); place < e.records.size()) places.push_back(place);
  const Records right = e.records;
  const auto apart = [&](const std::vector<std::byte>& a, const std::vector<std::byte>& b) {
    double sum = 0;
    for (const Member& m : list.fields)
      for (int k = 0; k < m.components; ++k) {
        const std::size_t at = offset_of(m, k);
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

void add_orders(ListAdder& a) {
  a.add(Kind::list_in_another_order, [](const List&, const PassCase&, ListEdit& e) {
     std::reverse(e.records.begin(), e.records.end());
     return e.records.size() > 1;
   }).legal = true;
  a.add(Kind::list_under_permuted_ids, [](const List& list, const PassCase&, ListEdit& e) {
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
    Fault& d =
        a.add(by == 1 ? Kind::list_one_slot_off : Kind::list_one_slot_off_other_way, [by](const List& list, const PassCase&, ListEdit& e) {
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
  a.add(Kind::list_ids_one_too_large, [](const List& list, const PassCase&, ListEdit& e) {
    for (auto& r : e.records) list.set_id(r, list.id_of(r) + 1);
    return !e.records.empty();
  });
  a.add(Kind::list_without_last, [](const List&, const PassCase&, ListEdit& e) {
    if (e.records.empty()) return false;
    e.records.pop_back();
    return true;
  });
  a.add(Kind::list_without_workgroup, [](const List&, const PassCase&, ListEdit& e) {
    const std::size_t whole = e.records.size() / 64 * 64;
    const bool some = whole < e.records.size();
    e.records.resize(whole);
    return some;
  });
  a.add(Kind::list_not_written, [](const List&, const PassCase&, ListEdit& e) {
    const bool some = !e.records.empty();
    e.records.clear();
    return some;
  });
}

// ---- fields --------------------------------------------------------------------------------------------------------
void add_fields(ListAdder& a, bool has_input) {
  // change(record, all correct records, its index): for each record.
  const auto each = [&](Kind kind, std::vector<std::string> more, auto change) -> Fault& {
    const auto alter = [change](const List&, const PassCase&, ListEdit& e) {
      const Records right = e.records;
      for (std::size_t i = 0; i < right.size(); ++i) change(e.records[i], right, i);
      return true;
    };
    return a.add(kind, alter, std::move(more));
  };
  for (const Member& m : a.list().fields) {
    for (const std::size_t by : {1, -1}) {
      const auto alter = [m, by](const List&, const PassCase&, ListEdit& e) {
        const Records right = e.records;
        const std::size_t n = right.size();
        for (std::size_t i = 0; i < n; ++i) copy_member(m, right[(i + n + by) % n], e.records[i]);
        return n > 1;
      };
      a.add(by == 1 ? Kind::list_next_slot : Kind::list_previous_slot, alter, {m.name}).for_diagnosis = by != 1;
    }
    if (has_input) {
      const auto alter = [m](const List& list, const PassCase& c, ListEdit& e) {
        const auto before = list.taken(c);
        for (auto& r : e.records)
          if (const auto old = before.find(list.id_of(r)); old != before.end()) copy_member(m, old->second, r);
        return true;
      };
      a.add(Kind::list_stale_field, alter, {m.name});
    }
    if (m.scalar != scene::Scalar::float32) continue;
    using Record = std::vector<std::byte>;
    each(Kind::list_field_through_half, {m.name}, [m](Record& r, const Records&, std::size_t) {
      each_float(m, r, [](float f, int) { return to_float(to_half(f)); });
    }).for_diagnosis = true;
    each(Kind::list_without_field, {m.name}, [m](Record& r, const Records&, std::size_t) {
      each_float(m, r, [](float, int) { return 0.0f; });
    }).for_diagnosis = true;
    for (int k = 0; k < m.components; ++k)
      each(Kind::list_field_negated, {part_name(m, k)}, [m, k](Record& r, const Records&, std::size_t) {
        each_float(m, r, [k](float f, int at) { return at == k && f != 0 ? -f : f; });
      });
    if (m.components > 1)
      each(Kind::list_axes_exchanged, {m.name}, [m](Record& r, const Records& right, std::size_t i) {
        each_float(m, r, [&](float f, int at) { return at < 2 ? float_at(right[i], offset_of(m, 1 - at)) : f; });
      });
  }
  // Four components without names are a 2 x 2 matrix.
  std::vector<Member> matrices;
  for (const Member& m : a.list().fields)
    if (m.scalar == scene::Scalar::float32 && m.components == 4) matrices.push_back(m);
  if (!matrices.empty())
    a.add(Kind::list_matrices_transposed, [matrices](const List&, const PassCase&, ListEdit& e) {
      for (auto& r : e.records)
        for (const Member& m : matrices) std::swap_ranges(&r[m.offset + 4], &r[m.offset + 4] + 4, &r[m.offset + 8]);
      return !e.records.empty();
    });
  a.add(Kind::list_through_half, [](const List& list, const PassCase&, ListEdit& e) {
    for (auto& r : e.records)
      for (const Member& m : list.fields)
        if (m.scalar == scene::Scalar::float32) each_float(m, r, [](float f, int) { return to_float(to_half(f)); });
    return true;
  });
}

// ---- time ----------------------------------------------------------------------------------------------------------
void add_times(std::vector<Fault>& out, ListAdder& a, const PassCase& c, bool has_input, const PassCase* before) {
  const std::string name = a.list().name;
  if (has_input) {
    a.add(Kind::list_one_step_late, [](const List& list, const PassCase& taken, ListEdit& e) {
      const capture::CaseInput* in = taken.input(list.name);
      e.records = records_of(in->array);
      return true;
    });
    out.emplace_back(What{Kind::list_one_step_early, {name}}, false).alter_case =
        [name, gave = c.outputs[a.list().output].array](PassCase& altered) {
          for (capture::CaseInput& i : altered.inputs)
            if (i.name == name) i.array = gave;
        };
  }
  if (const capture::CaseOutput* old = before ? before->output(name) : nullptr; old && old->array.is_records) {
    a.add(Kind::list_stale, [stale = old->array](const List&, const PassCase&, ListEdit& e) {
      e.records = records_of(stale);
      return true;
    });
  }
}

}  // namespace

void add_list_faults(std::vector<Fault>& out, const PassCase& c, const PassCase* before) {
  for (const std::size_t o : keyed_outputs(c)) {
    ListAdder a(out, List(c, o));
    const capture::CaseInput* in = c.input(c.outputs[o].name);
    const bool has_input = in && in->array.is_records && in->array.record.size == c.outputs[o].array.record.size;
    // If mistakes give the same bits, the first is named, so those of a whole list come before those of some records.
    add_times(out, a, c, has_input, before);
    add_orders(a);
    add_fields(a, has_input);
    add_events(a);
  }
}

}  // namespace rainref::faults
