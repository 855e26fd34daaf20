#include "conformance/keyed.h"

#include <algorithm>
#include <cstring>
#include <map>

#include <fmt/format.h>

#include "image/code_range.h"
#include "math/replay.h"
#include "rainref/error.h"

namespace rainref::conformance {
namespace {

using capture::Array;
using capture::KeyedRecord;
using enclosed::CodeRange;

/// Where the fields of a record lie.
struct Layout {
  std::size_t id = 0;
  std::vector<std::size_t> floats, words;
  std::vector<int> float_fields, word_fields;  ///< their numbers among all fields
  std::vector<std::string> float_names, word_names;
};
bool is_key(const scene::Member& m) { return m.name == "id" && m.scalar == scene::Scalar::uint32 && m.components == 1; }

Layout layout_of(const scene::UniformBlock& record) {
  Layout out;
  int field = 0;
  for (const scene::Member& m : record.members) {
    if (is_key(m)) {
      out.id = m.offset;
      continue;
    }
    if (m.name.starts_with("padding")) continue;
    for (int k = 0; k < m.components; ++k, ++field) {
      const bool is_float = m.scalar == scene::Scalar::float32;
      (is_float ? out.floats : out.words).push_back(m.offset + 4 * static_cast<std::size_t>(k));
      (is_float ? out.float_fields : out.word_fields).push_back(field);
      (is_float ? out.float_names : out.word_names).push_back(m.components == 1 ? m.name : fmt::format("{}.{}", m.name, "xyzw"[k & 3]));
    }
  }
  return out;
}
std::uint32_t word_at(const std::byte* record, std::size_t offset) {
  std::uint32_t w;
  std::memcpy(&w, record + offset, 4);
  return w;
}

/// Records by id; where there are several, the first.
using Table = std::map<std::uint32_t, const std::byte*>;
Table table_of(const Array& list, const Layout& layout, std::vector<std::uint32_t>& duplicate) {
  Table table;
  const std::vector<std::byte>& bytes = list.levels[0];
  for (std::size_t at = 0; at + list.record.size <= bytes.size(); at += list.record.size) {
    const std::uint32_t id = word_at(&bytes[at], layout.id);
    if (!table.emplace(id, &bytes[at]).second) duplicate.push_back(id);
  }
  return table;
}

/// The expected records as they are.
class Exactly : public capture::KeyedModel {
 public:
  Exactly(const Table& table, const Layout& layout) : layout_(layout), records_(table.begin(), table.end()) {}
  int groups() const override { return static_cast<int>(records_.size()); }
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
  const Layout& layout_;
  std::vector<std::pair<std::uint32_t, const std::byte*>> records_;
};

bool is_not_a_number(std::uint32_t word) { return (word & 0x7fffffffu) > 0x7f800000u; }

/// How far one list is from one alternative of a group.
struct Difference {
  std::vector<std::uint32_t> missing, extra, outside;
  std::vector<Failure> failures;
  std::size_t count() const { return missing.size() + extra.size() + failures.size(); }
};

Difference compare(const std::vector<KeyedRecord>& alternative, const Table& table, const Layout& layout,
                   const enclosed::Profile& profile) {
  Difference d;
  const enclosed::StoreRules rules = enclosed::store_rules(profile);
  for (const KeyedRecord& r : alternative) {
    const auto found = table.find(r.id);
    if ((found != table.end()) != r.lives) {
      (r.lives ? d.missing : d.extra).push_back(r.id);
      continue;
    }
    if (!r.lives) continue;
    const std::size_t before = d.failures.size();
    Failure f;
    f.x = static_cast<int>(r.id);
    for (std::size_t k = 0; k < layout.floats.size(); ++k) {
      const std::byte* at = found->second + layout.floats[k];
      const CodeRange range = enclosed::code_range(FormatInfo::float32, r.floats[k], rules);
      f.not_a_number = is_not_a_number(word_at(at, 0));
      f.got = enclosed::ordered_code(FormatInfo::float32, at);
      if (range.contains(f.got) && !f.not_a_number) continue;
      f.channel = layout.float_fields[k];
      f.field = layout.float_names[k];
      f.field_kind = FormatInfo::float32;
      f.low = range.lo;
      f.high = range.hi;
      f.distance = f.not_a_number ? ~std::uint64_t{0}
                                  : static_cast<std::uint64_t>(f.got < range.lo ? range.lo - f.got : f.got - range.hi);
      d.failures.push_back(f);
    }
    f.not_a_number = false;
    f.field_kind = FormatInfo::uint32;
    for (std::size_t k = 0; k < layout.words.size(); ++k) {
      f.got = word_at(found->second, layout.words[k]);
      f.low = f.high = r.words[k];
      f.channel = layout.word_fields[k];
      f.field = layout.word_names[k];
      f.distance = static_cast<std::uint64_t>(f.got < f.low ? f.low - f.got : f.got - f.low);
      if (f.distance > 0) d.failures.push_back(f);
    }
    if (d.failures.size() > before) d.outside.push_back(r.id);
  }
  return d;
}

/// Counts of the fields that an alternative bounds, and how well.
void count_fields(const std::vector<KeyedRecord>& alternative, const Table& port, const Table& expected,
                  const Layout& layout, double extent, bool gave_up, OutputJudgement& out) {
  for (const KeyedRecord& r : alternative) {
    const auto got = port.find(r.id), want = expected.find(r.id);
    if (got == port.end()) continue;
    const auto differs = [&](std::size_t offset) {
      return want == expected.end() || word_at(got->second, offset) != word_at(want->second, offset);
    };
    for (std::size_t k = 0; k < layout.floats.size(); ++k) {
      ++out.elements;
      out.differing += differs(layout.floats[k]);
      if (gave_up || !r.lives) {
        out.vacuous += gave_up;
        out.loose += gave_up;
        continue;
      }
      const enclosed::Enclosure& e = r.floats[k];
      const double width = static_cast<double>(e.hi) - e.lo, scale = std::max(extent, e.magnitude());
      out.vacuous += e.is_vacuous() || width > scale / 16;
      out.loose += e.is_vacuous() || width > scale / 256;
    }
    for (const std::size_t offset : layout.words) {
      ++out.elements;
      out.differing += differs(offset);
      out.vacuous += gave_up;
      out.loose += gave_up;
    }
  }
}

void append(std::vector<std::uint32_t>& to, const std::vector<std::uint32_t>& from) {
  to.insert(to.end(), from.begin(), from.end());
}
void settle(std::vector<std::uint32_t>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

std::string KeyedEvents::text() const {
  std::string out;
  const auto add = [&](const char* what, const std::vector<std::uint32_t>& ids) {
    if (ids.empty()) return;
    const std::vector<std::uint32_t> some(
        ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(8, ids.size())));
    out += fmt::format("{}{}: {}{}", out.empty() ? "" : "; ", what, fmt::join(some, ", "),
                       ids.size() > 8 ? fmt::format(" and {} more", ids.size() - 8) : "");
  };
  add("missing", missing);
  add("extra", extra);
  add("duplicate", duplicate);
  add("outside", outside);
  return out;
}

bool has_key(const scene::UniformBlock& record) {
  return std::any_of(record.members.begin(), record.members.end(), is_key);
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
  const Layout layout = layout_of(expected.array.record);
  KeyedJudgement j;
  j.output.name = expected.name;
  j.output.records = true;
  j.output.width = expected.array.width;
  j.output.height = 1;
  std::vector<std::uint32_t> twice;
  const Table want = table_of(expected.array, layout, twice);
  if (!twice.empty())
    throw Error(ExitCode::port_files,
                fmt::format("{}: expected each id once, found {} twice", expected.name, twice.front()));
  Table have = table_of(port, layout, j.events.duplicate);
  const Exactly exactly(want, layout);
  if (!model) model = &exactly;

  Table unknown = have;
  const enclosed::ProfileScope scope(profile);
  for (int group = 0; group < model->groups(); ++group) {
    std::vector<std::vector<KeyedRecord>> alternatives;
    enclosed::Replay replay;
    const bool whole = replay.for_each_alternative([&] { model->enclose(group, alternatives.emplace_back()); });
    ++j.groups;
    j.gave_up += !whole;
    j.ambiguous += whole && alternatives.size() > 1;
    for (const std::vector<KeyedRecord>& a : alternatives)
      for (const KeyedRecord& r : a) {
        unknown.erase(r.id);
        if (r.lives && (r.floats.size() != layout.floats.size() || r.words.size() != layout.words.size()))
          throw Error(
              ExitCode::internal,
              fmt::format("{}: the model's record has {} floats and {} integers, the output's {} and {}", expected.name,
                          r.floats.size(), r.words.size(), layout.floats.size(), layout.words.size()));
      }
    if (!whole) {
      count_fields(alternatives.front(), have, want, layout, 0, true, j.output);
      continue;
    }
    // The alternative that accepts what was stored, the reference's if it does; else the nearest.
    std::size_t best = 0;
    Difference least;
    int reference = -1;
    for (std::size_t a = 0; a < alternatives.size(); ++a) {
      if (reference < 0 && compare(alternatives[a], want, layout, profile).count() == 0)
        reference = static_cast<int>(a);
      Difference d = compare(alternatives[a], have, layout, profile);
      if (a == 0 || d.count() < least.count() || (d.count() == 0 && static_cast<int>(a) == reference)) {
        best = a;
        least = std::move(d);
      }
    }
    count_fields(alternatives[best], have, want, layout, expected.range[1] - expected.range[0], false, j.output);
    const bool failed = least.count() > 0;
    j.failing += failed;
    j.other_branch += !failed && reference >= 0 && static_cast<int>(best) != reference;
    append(j.events.missing, least.missing);
    append(j.events.extra, least.extra);
    append(j.events.outside, least.outside);
    j.output.failing += static_cast<std::int64_t>(least.failures.size());
    for (const Failure& f : least.failures)
      if (j.output.worst.size() < OutputJudgement::max_failures) j.output.worst.push_back(f);
  }
  for (const auto& [id, bytes] : unknown) j.events.extra.push_back(id);
  for (std::vector<std::uint32_t>* ids : {&j.events.missing, &j.events.extra, &j.events.duplicate, &j.events.outside})
    settle(*ids);
  j.failing += static_cast<std::int64_t>(unknown.size() + j.events.duplicate.size());
  j.output.failing +=
      static_cast<std::int64_t>(j.events.missing.size() + j.events.extra.size() + j.events.duplicate.size());
  std::stable_sort(j.output.worst.begin(), j.output.worst.end(),
                   [](const Failure& a, const Failure& b) { return a.distance > b.distance; });
  return j;
}

}  // namespace rainref::conformance
