#include "judge/keyed_fields.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "image/code_range.h"
#include "judge/keyed.h"
#include "judge/quantities.h"
#include "judge/slots.h"
#include "rainref/error.h"
#include "scene/record_key.h"

namespace rainref::judge {
namespace {

using capture::Array;
using capture::KeyedRecord;
using enclosed::CodeRange;

}  // namespace

bool has_key(const scene::UniformBlock& record) { return std::any_of(record.members.begin(), record.members.end(), scene::is_key); }
std::vector<std::size_t> keyed_outputs(const capture::PassCase& c) {
  std::vector<std::size_t> out;
  for (std::size_t o = 0; o < c.outputs.size(); ++o)
    if (c.outputs[o].judge == capture::Judge::keyed && has_key(c.outputs[o].array.record)) out.push_back(o);
  return out;
}

RecordLayout record_layout(const scene::UniformBlock& record) {
  RecordLayout out;
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

RecordTable table_of(const Array& list, const RecordLayout& layout, std::vector<std::uint32_t>& duplicate) {
  RecordTable table;
  const std::vector<std::byte>& bytes = list.levels[0];
  for (std::size_t at = 0; at + list.record.size <= bytes.size(); at += list.record.size) {
    const std::uint32_t id = word_at(&bytes[at], layout.id);
    if (!table.emplace(id, &bytes[at]).second) duplicate.push_back(id);
  }
  return table;
}

std::vector<double> extents_of(const scene::UniformBlock& record, const capture::KeyedModel& model) {
  std::vector<double> out;
  for (const scene::Member& m : record.members) {
    if (m.scalar != scene::Scalar::float32 || m.name.starts_with("padding")) continue;
    const auto found =
        std::find_if(model.ranges().begin(), model.ranges().end(), [&](const capture::FieldRange& r) { return r.member == m.name; });
    if (found == model.ranges().end()) throw Error(ExitCode::internal, fmt::format("{}: {} has no declared range", record.name, m.name));
    out.insert(out.end(), static_cast<std::size_t>(m.components), found->high - found->low);
  }
  return out;
}

std::vector<Failure> not_numbers(const std::vector<KeyedRecord>& records, const RecordTable& table, const RecordLayout& layout) {
  std::vector<Failure> out;
  for (const KeyedRecord& r : records) {
    const auto found = table.find(r.id);
    for (std::size_t k = 0; found != table.end() && k < layout.floats.size(); ++k) {
      const std::byte* at = found->second + layout.floats[k];
      if (!is_nan(FormatInfo::float32, at)) continue;
      Failure f;
      f.x = static_cast<int>(r.id);
      f.channel = layout.float_fields[k];
      f.field = layout.float_names[k];
      f.field_kind = FormatInfo::float32;
      f.got = enclosed::ordered_code(FormatInfo::float32, at);
      f.low = INT64_MIN;
      f.high = INT64_MAX;
      f.not_a_number = true;
      f.distance = ~std::uint64_t{0};
      out.push_back(std::move(f));
    }
  }
  return out;
}

void FieldCounts::add(const std::vector<KeyedRecord>& alternative, bool gave_up) {
  for (const KeyedRecord& r : alternative) {
    const auto got = port_.find(r.id), want = expected_.find(r.id);
    if (got == port_.end()) {
      if (r.lives && !gave_up) add_whole_record();  // missing
      continue;
    }
    if (!r.lives && !gave_up) {
      add_whole_record();  // extra
      continue;
    }
    const auto differs = [&](std::size_t offset) {
      return want == expected_.end() || word_at(got->second, offset) != word_at(want->second, offset);
    };
    for (std::size_t k = 0; k < layout_.floats.size(); ++k) {
      const CodeRange range = gave_up ? CodeRange::vacuous() : enclosed::code_range(FormatInfo::float32, r.floats[k], {});
      const double width = gave_up ? 0 : static_cast<double>(r.floats[k].hi) - r.floats[k].lo,
                   scale = gave_up ? 0 : std::max(extents_[k], r.floats[k].magnitude());
      add_field(layout_.float_fields[k], differs(layout_.floats[k]), range, width, range.is_vacuous() || width > scale / 16,
                range.is_vacuous() || width > scale / 256);
    }
    for (std::size_t k = 0; k < layout_.words.size(); ++k)
      add_field(layout_.word_fields[k], differs(layout_.words[k]), gave_up ? CodeRange::vacuous() : CodeRange{0, 0}, 0, gave_up, gave_up);
  }
}

void FieldCounts::add_whole_record() {
  const auto fields = static_cast<std::int64_t>(layout_.floats.size() + layout_.words.size());
  out_.elements += fields;
  out_.differing += fields;
  out_.failing += fields;
  for (QuantityJudgement& q : out_.quantities) {
    ++q.elements;
    ++q.failing;
  }
}

void FieldCounts::add_failures(const std::vector<Failure>& failures) {
  out_.failing += static_cast<std::int64_t>(failures.size());
  for (const Failure& f : failures) {
    widths_.add_failing(f.channel, value_distance(f.field_kind, f));
    if (out_.worst.size() < OutputJudgement::max_failures) out_.worst.push_back(f);
  }
}

void FieldCounts::add_field(int field, bool differs, const CodeRange& range, double width, bool is_vacuous, bool is_loose) {
  ++out_.elements;
  out_.differing += differs;
  out_.vacuous += is_vacuous;
  out_.unbounded += is_vacuous;
  out_.loose += is_loose;
  widths_.add(field, range, width, is_vacuous, is_loose);
}

}  // namespace rainref::judge
