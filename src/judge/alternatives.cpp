#include "judge/alternatives.h"

#include <algorithm>
#include <cstddef>

namespace rainref::judge {

using capture::PassModel;
using enclosed::CodeRange;
using enclosed::Enclosure;

enclosed::StoreRules rules_of(const enclosed::Profile& profile, HalfMode mode, Rounding unorm) {
  enclosed::StoreRules rules = enclosed::store_rules(profile, unorm);
  rules.half = mode == HalfMode::rne   ? enclosed::StoreRounding::rne
               : mode == HalfMode::rtz ? enclosed::StoreRounding::rtz
                                       : enclosed::StoreRounding::either;
  // The profile's rule for overflow belongs to the rounding that it requires.
  if (profile.half_store != enclosed::StoreRounding::either && profile.half_store != rules.half && !profile.reference)
    rules.half_overflow = enclosed::StoreOverflow::either;
  return rules;
}
enclosed::Profile narrowed(const enclosed::Profile& profile, HalfMode mode) {
  enclosed::Profile out = profile;
  const enclosed::StoreRules rules = rules_of(profile, mode, Rounding::rne);
  out.half_store = rules.half;
  out.half_overflow = rules.half_overflow;
  return out;
}

void Alternatives::only(const Stored& stored) {
  count = 1;
  gave_up = false;
  values.front().clear();
  for (const float x : stored.expected_values) values.front().emplace_back(x, x);
  widen(stored);
}
void Alternatives::widen(const Stored& stored) {
  for (int a = 0; a < count; ++a)
    for (std::size_t v = 0; v < stored.spread.size(); ++v) {
      Enclosure& e = values[static_cast<std::size_t>(a)][v];
      if (stored.is_known(v) || e.is_vacuous()) continue;
      // The port's value may be above the stored one, and still in the envelope when that is below it; and the other way round.
      const auto [below, above] = stored.spread[v];
      e = {enclosed::float_below(static_cast<double>(e.lo) - above), enclosed::float_above(static_cast<double>(e.hi) + below)};
    }
}
void Alternatives::run(const PassModel& model, int x, int y, const float* port, const enclosed::Profile& profile) {
  const enclosed::ProfileScope scope(profile);
  enclosed::PathEnumeration paths;
  count = 0;
  gave_up = !paths.for_each_alternative([&] {
    std::vector<Enclosure>& out = values[static_cast<std::size_t>(count++)];
    out.assign(static_cast<std::size_t>(model.values()), Enclosure());
    model.enclose(x, y, port, out.data());
  });
}
void Alternatives::run(const PassModel& model, int x, int y, const Stored& stored, const enclosed::Profile& profile) {
  run(model, x, y, stored.got_values.data(), profile);
  widen(stored);
}
void Alternatives::run_part(const PassModel& model, int part, int x, int y, const Stored& stored, const enclosed::Profile& profile) {
  const enclosed::ProfileScope scope(profile);
  enclosed::PathEnumeration paths;
  count = 0;
  gave_up = false;
  const bool is_settled = paths.for_each_alternative([&] {
    std::vector<Enclosure>& out = values[static_cast<std::size_t>(count)];
    out.assign(static_cast<std::size_t>(model.values()), Enclosure());
    count += model.enclose_part(part, x, y, stored.got_values.data(), out.data());
  });
  if (!is_settled) count = 0;
  widen(stored);
}
void Alternatives::rearrange(const PassModel& model, int x, int y, const float* port, const enclosed::Profile& profile) {
  const enclosed::ProfileScope scope(profile);
  enclosed::PathEnumeration paths;
  bool is_known = true;
  count = 0;
  gave_up = !paths.for_each_alternative([&] {
    std::vector<Enclosure>& out = values[static_cast<std::size_t>(count++)];
    out.assign(static_cast<std::size_t>(model.values()), Enclosure());
    is_known = model.rearrange(x, y, port, out.data());
  });
  gave_up |= !is_known;
}
void Alternatives::rearrange(const PassModel& model, int x, int y, const Stored& stored, const enclosed::Profile& profile) {
  rearrange(model, x, y, stored.got_values.data(), profile);
  widen(stored);
}

void code_ranges(const std::vector<Slot>& slots, const std::vector<Enclosure>& values, const enclosed::Profile& profile, HalfMode mode,
                 std::vector<CodeRange>& out) {
  out.resize(slots.size());
  for (std::size_t v = 0; v < slots.size(); ++v)
    out[v] = enclosed::code_range(slots[v].kind, values[v], rules_of(profile, mode, slots[v].store_rounding));
}

Bound bound_of(const Slot& slot, const Enclosure& value, const CodeRange& codes) {
  const double width = static_cast<double>(value.hi) - value.lo;
  // A value beyond the declared range (a lamp in a radiance) is measured relative to its own size.
  const double scale = std::max(slot.range, value.magnitude());
  const bool vacuous = codes.is_vacuous() || width > scale / 16;
  return {vacuous, vacuous || width > scale / 256};
}

std::uint64_t distance(std::int64_t code, const CodeRange& r) {
  if (r.contains(code)) return 0;
  return code < r.lo ? static_cast<std::uint64_t>(r.lo) - static_cast<std::uint64_t>(code)
                     : static_cast<std::uint64_t>(code) - static_cast<std::uint64_t>(r.hi);
}

}  // namespace rainref::judge
