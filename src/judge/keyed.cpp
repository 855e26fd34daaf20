#include "judge/keyed.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include <fmt/format.h>

#include "image/code_range.h"
#include "judge/bits.h"
#include "judge/keyed_fields.h"
#include "judge/quantities.h"
#include "judge/slots.h"
#include "math/path_enumeration.h"
#include "rainref/error.h"

namespace rainref::judge {
namespace {

using capture::Array;
using capture::KeyedRecord;
using enclosed::CodeRange;

/// The expected records as exact values.
class Exactly : public capture::KeyedModel {
 public:
  Exactly(const RecordTable& table, const RecordLayout& layout) : layout_(layout), records_(table.begin(), table.end()) {}
  int groups() const override { return static_cast<int>(records_.size()); }
  const std::vector<capture::FieldRange>& ranges() const override {
    static const std::vector<capture::FieldRange> none;  // exact values have no width
    return none;
  }
  void enclose(int group, std::vector<KeyedRecord>& out) const override {
    const auto& [id, bytes] = records_[static_cast<std::size_t>(group)];
    KeyedRecord r;
    r.id = id;
    for (const std::size_t offset : layout_.floats) {
      float f;
      std::memcpy(&f, bytes + offset, 4);
      r.floats.emplace_back(f, f);
    }
    for (const std::size_t offset : layout_.words) r.words.push_back(word_at(bytes, offset));
    out.push_back(std::move(r));
  }

 private:
  const RecordLayout& layout_;
  std::vector<std::pair<std::uint32_t, const std::byte*>> records_;
};

/// Rules for comparing a list.
struct Rules {
  const RecordLayout& layout;
  const enclosed::Profile& profile;
  bool by_bits;
};

/// Distance of a list from one alternative of a group.
struct Difference {
  std::vector<std::uint32_t> missing, extra, outside;
  std::vector<Failure> failures;
  std::size_t count() const { return missing.size() + extra.size() + failures.size(); }
};

/// Failure of a float outside its envelope, or with other bits; nothing if it is inside.
std::optional<Failure> float_failure(const enclosed::Enclosure& e, const std::byte* at, const Rules& rules) {
  Failure f;
  f.field_kind = FormatInfo::float32;
  if (rules.by_bits) {
    std::byte want[4];
    std::memcpy(want, &e.lo, 4);
    if (std::memcmp(want, at, 4) == 0) return std::nullopt;
    set_unequal(FormatInfo::float32, want, at, f);
    return f;
  }
  const CodeRange range = enclosed::code_range(FormatInfo::float32, e, enclosed::store_rules(rules.profile));
  f.not_a_number = is_nan(FormatInfo::float32, at);
  f.got = enclosed::ordered_code(FormatInfo::float32, at);
  if (range.contains(f.got) && !f.not_a_number) return std::nullopt;
  f.low = range.lo;
  f.high = range.hi;
  f.distance = f.not_a_number ? ~std::uint64_t{0} : static_cast<std::uint64_t>(f.got < range.lo ? range.lo - f.got : f.got - range.hi);
  return f;
}

Difference compare(const std::vector<KeyedRecord>& alternative, const RecordTable& table, const Rules& rules) {
  const RecordLayout& layout = rules.layout;
  Difference d;
  for (const KeyedRecord& r : alternative) {
    const auto found = table.find(r.id);
    if ((found != table.end()) != r.lives) {
      (r.lives ? d.missing : d.extra).push_back(r.id);
      continue;
    }
    if (!r.lives) continue;
    const std::size_t before = d.failures.size();
    for (std::size_t k = 0; k < layout.floats.size(); ++k) {
      std::optional<Failure> f = float_failure(r.floats[k], found->second + layout.floats[k], rules);
      if (!f) continue;
      f->x = static_cast<int>(r.id);
      f->channel = layout.float_fields[k];
      f->field = layout.float_names[k];
      d.failures.push_back(std::move(*f));
    }
    for (std::size_t k = 0; k < layout.words.size(); ++k) {
      Failure f;
      f.x = static_cast<int>(r.id);
      f.got = word_at(found->second, layout.words[k]);
      f.low = f.high = f.expected = r.words[k];
      f.channel = layout.word_fields[k];
      f.field = layout.word_names[k];
      f.distance = static_cast<std::uint64_t>(f.got < f.low ? f.low - f.got : f.got - f.low);
      if (f.distance > 0) d.failures.push_back(f);
    }
    if (d.failures.size() > before) d.outside.push_back(r.id);
  }
  return d;
}

/// True if a rearrangement gives the port's values of a group, and bounds each field that the formula as written does not accept.
bool is_rearranged(const capture::KeyedModel& model, int group, const RecordTable& have, const Difference& as_written,
                   const std::vector<double>& extents, const Rules& rules) {
  if (rules.by_bits || rules.profile.rearrangement == enclosed::Rearrangement::none) return false;
  std::vector<std::vector<KeyedRecord>> alternatives;
  bool is_known = true;
  enclosed::PathEnumeration paths;
  const bool whole = paths.for_each_alternative([&] { is_known = model.rearrange(group, alternatives.emplace_back()); });
  if (!whole || !is_known) return false;
  const auto bounds = [&](const std::vector<KeyedRecord>& alternative, const Failure& f) {
    const auto record =
        std::find_if(alternative.begin(), alternative.end(), [&](const KeyedRecord& r) { return r.id == static_cast<std::uint32_t>(f.x); });
    const auto field = std::find(rules.layout.float_fields.begin(), rules.layout.float_fields.end(), f.channel);
    if (field == rules.layout.float_fields.end()) return true;
    const auto k = static_cast<std::size_t>(field - rules.layout.float_fields.begin());
    const enclosed::Enclosure& e = record->floats[k];
    return !e.is_vacuous() && static_cast<double>(e.hi) - e.lo <= std::max(extents[k], e.magnitude()) / 16;
  };
  return std::any_of(alternatives.begin(), alternatives.end(), [&](const std::vector<KeyedRecord>& a) {
    return compare(a, have, rules).count() == 0 &&
           std::all_of(as_written.failures.begin(), as_written.failures.end(), [&](const Failure& f) { return bounds(a, f); });
  });
}

void append(std::vector<std::uint32_t>& to, const std::vector<std::uint32_t>& from) { to.insert(to.end(), from.begin(), from.end()); }
void settle(std::vector<std::uint32_t>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

std::string KeyedEvents::text() const {
  std::string out;
  const auto add = [&](const char* what, const std::vector<std::uint32_t>& ids) {
    if (ids.empty()) return;
    const std::vector<std::uint32_t> some(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(8, ids.size())));
    out += fmt::format("{}{}: {}{}", out.empty() ? "" : "; ", what, fmt::join(some, ", "),
                       ids.size() > 8 ? fmt::format(" and {} more", ids.size() - 8) : "");
  };
  add("missing", missing);
  add("extra", extra);
  add("duplicate", duplicate);
  add("outside", outside);
  return out;
}

bool same_records(const Array& a, const Array& b) {
  const auto sorted = [](const Array& list) {
    const std::size_t size = list.element_bytes();
    std::vector<std::vector<std::byte>> records;
    for (auto at = list.levels[0].begin(); at != list.levels[0].end(); at += static_cast<std::ptrdiff_t>(size))
      records.emplace_back(at, at + static_cast<std::ptrdiff_t>(size));
    std::sort(records.begin(), records.end());
    return records;
  };
  return sorted(a) == sorted(b);
}

KeyedJudgement judge_keyed(const capture::CaseOutput& expected, const Array& port, const capture::KeyedModel* model,
                           const enclosed::Profile& profile) {
  if (!expected.array.is_records || !has_key(expected.array.record))
    throw Error(ExitCode::internal, fmt::format("{}: expected records with a uint 'id'", expected.name));
  const RecordLayout layout = record_layout(expected.array.record);
  KeyedJudgement j;
  j.output.name = expected.name;
  j.output.records = true;
  j.output.counted = Counted::fields;
  j.output.width = expected.array.width;
  j.output.height = 1;
  std::vector<std::uint32_t> twice;
  const RecordTable want = table_of(expected.array, layout, twice);
  if (!twice.empty())
    throw Error(ExitCode::port_files, fmt::format("{}: expected each id once, found {} twice", expected.name, twice.front()));
  const RecordTable have = table_of(port, layout, j.events.duplicate);
  const Rules rules{layout, profile, profile.reference || !model};
  const Exactly exactly(want, layout);
  const std::vector<double> extents =
      rules.by_bits ? std::vector<double>(layout.floats.size(), 0.0) : extents_of(expected.array.record, *model);
  if (rules.by_bits) model = &exactly;
  name_quantities(quantities_of(expected), j.output);
  for (std::size_t k = 0; k < extents.size(); ++k)
    j.output.quantities[static_cast<std::size_t>(layout.float_fields[k])].extent = extents[k];

  RecordTable unknown = have;
  FieldCounts counts(have, want, layout, extents, j.output);
  const enclosed::ProfileScope scope(profile);
  for (int group = 0; group < model->groups(); ++group) {
    std::vector<std::vector<KeyedRecord>> alternatives;
    enclosed::PathEnumeration paths;
    const bool whole = paths.for_each_alternative([&] { model->enclose(group, alternatives.emplace_back()); });
    ++j.groups;
    j.gave_up += !whole;
    j.ambiguous += whole && alternatives.size() > 1;
    for (const std::vector<KeyedRecord>& a : alternatives)
      for (const KeyedRecord& r : a) {
        unknown.erase(r.id);
        if (r.lives && (r.floats.size() != layout.floats.size() || r.words.size() != layout.words.size()))
          throw Error(ExitCode::internal,
                      fmt::format("{}: the model's record has {} floats and {} integers, the output's {} and {}", expected.name,
                                  r.floats.size(), r.words.size(), layout.floats.size(), layout.words.size()));
      }
    if (!whole) {
      counts.add(alternatives.front(), true);
      // Without a bound, everything but NaN passes.
      const std::vector<Failure> failures = not_numbers(alternatives.front(), have, layout);
      j.failing += !failures.empty();
      for (const Failure& f : failures) j.events.outside.push_back(static_cast<std::uint32_t>(f.x));
      counts.add_failures(failures);
      continue;
    }
    // The alternative that accepts the stored values, the reference's if it does; else the nearest.
    std::size_t best = 0;
    Difference least;
    int reference = -1;
    for (std::size_t a = 0; a < alternatives.size(); ++a) {
      if (reference < 0 && compare(alternatives[a], want, rules).count() == 0) reference = static_cast<int>(a);
      Difference d = compare(alternatives[a], have, rules);
      if (a == 0 || d.count() < least.count() || (d.count() == 0 && static_cast<int>(a) == reference)) {
        best = a;
        least = std::move(d);
      }
    }
    counts.add(alternatives[best], false);
    bool failed = least.count() > 0;
    if (failed && is_rearranged(*model, group, have, least, extents, rules)) {
      ++j.rearranged;
      for (const Failure& f : least.failures) j.rearranged_distance = std::max(j.rearranged_distance, f.distance);
      j.output.rearranged += static_cast<std::int64_t>(least.failures.size());
      least = Difference();
      failed = false;
    }
    j.failing += failed;
    j.other_branch += !failed && reference >= 0 && static_cast<int>(best) != reference;
    append(j.events.missing, least.missing);
    append(j.events.extra, least.extra);
    append(j.events.outside, least.outside);
    counts.add_failures(least.failures);
  }
  for (const auto& [id, bytes] : unknown) j.events.extra.push_back(id);
  for (std::size_t k = 0; k < unknown.size() + j.events.duplicate.size(); ++k) counts.add_whole_record();
  counts.finish();
  for (std::vector<std::uint32_t>* ids : {&j.events.missing, &j.events.extra, &j.events.duplicate, &j.events.outside}) settle(*ids);
  j.failing += static_cast<std::int64_t>(unknown.size() + j.events.duplicate.size());
  std::stable_sort(j.output.worst.begin(), j.output.worst.end(),
                   [](const Failure& a, const Failure& b) { return a.distance > b.distance; });
  return j;
}

}  // namespace rainref::judge
