#include "judge/bits.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "image/code_range.h"
#include "judge/quantities.h"
#include "judge/slots.h"

namespace rainref::judge {
namespace {

/// Finds the first channel of a texel whose bits differ.
void set_first_difference(const FormatInfo& format, const std::byte* want, const std::byte* have, Failure& f) {
  const auto bytes = static_cast<std::size_t>(format.channel_bytes);
  while (std::memcmp(want + static_cast<std::size_t>(f.channel) * bytes, have + static_cast<std::size_t>(f.channel) * bytes, bytes) == 0)
    ++f.channel;
  const std::size_t at = static_cast<std::size_t>(f.channel) * bytes;
  set_unequal(format.kind, want + at, have + at, f);
}

/// Finds the first word of a record whose bits differ. Padding has no name, but counts.
void set_first_difference(const scene::UniformBlock& record, const std::byte* want, const std::byte* have, Failure& f) {
  std::size_t at = 0;
  while (std::memcmp(want + at, have + at, 4) == 0) at += 4;
  f.field = fmt::format("byte {}", at);
  for (const scene::Member& m : record.members) {
    if (at < m.offset || at >= m.offset + m.size()) continue;
    f.field = m.components == 1 ? m.name : fmt::format("{}.{}", m.name, "xyzw"[(at - m.offset) / 4]);
    if (m.scalar == scene::Scalar::float32) f.field_kind = FormatInfo::float32;
  }
  set_unequal(f.field_kind, want + at, have + at, f);
}

/// Counts the numbers of a texel or record whose bits differ.
void count_differing(const std::vector<Quantity>& quantities, const std::byte* want, const std::byte* have,
                     std::vector<QuantityJudgement>& counts) {
  for (std::size_t k = 0; k < quantities.size(); ++k) {
    const Quantity& q = quantities[k];
    if (std::memcmp(want + q.offset, have + q.offset, q.bytes) == 0) continue;
    Failure f;
    set_unequal(q.kind, want + q.offset, have + q.offset, f);
    ++counts[k].failing;
    counts[k].farthest = std::max(counts[k].farthest, value_distance(q.kind, f));
  }
}

}  // namespace

bool is_negative_zero(FormatInfo::Kind kind, const std::byte* stored) {
  const std::size_t bytes = kind == FormatInfo::float16 ? 2 : kind == FormatInfo::float32 ? 4 : 0;
  std::uint32_t bits = 0;
  std::memcpy(&bits, stored, bytes);
  return bytes > 0 && bits == 1u << (8 * bytes - 1);
}

void set_unequal(FormatInfo::Kind kind, const std::byte* want, const std::byte* have, Failure& f) {
  f.got = enclosed::ordered_code(kind, have);
  f.expected = f.low = f.high = enclosed::ordered_code(kind, want);
  f.got_is_negative_zero = is_negative_zero(kind, have);
  f.expected_is_negative_zero = is_negative_zero(kind, want);
  f.not_a_number = is_nan(kind, have);
  // +0 and -0 have one code.
  const std::uint64_t codes = f.got < f.low ? static_cast<std::uint64_t>(f.low) - static_cast<std::uint64_t>(f.got)
                                            : static_cast<std::uint64_t>(f.got) - static_cast<std::uint64_t>(f.low);
  f.distance = f.not_a_number ? ~std::uint64_t{0} : std::max<std::uint64_t>(1, codes);
}

OutputJudgement judge_bits(const capture::CaseOutput& expected, const capture::Array& port) {
  OutputJudgement out;
  out.name = expected.name;
  out.format = expected.array.format;
  out.records = expected.array.is_records;
  out.counted = out.records ? Counted::records : Counted::texels;
  out.width = expected.array.width;
  out.height = expected.array.height;
  const std::size_t size = expected.array.element_bytes();
  const std::vector<std::byte>&want = expected.array.levels[0], &have = port.levels[0];
  const std::size_t count = want.size() / size, found = have.size() / size;
  out.elements = static_cast<std::int64_t>(std::max(count, found));
  if (!out.records) out.map.assign(count, 0);
  const std::vector<Quantity> quantities = quantities_of(expected);
  name_quantities(quantities, out);
  for (QuantityJudgement& q : out.quantities) q.elements = out.elements;
  for (std::size_t i = 0; i < std::max(count, found); ++i) {
    if (i < count && i < found && std::memcmp(want.data() + i * size, have.data() + i * size, size) == 0) continue;
    ++out.failing;
    ++out.differing;
    if (!out.records) out.map[i] = 3;
    if (i < count && i < found)
      count_differing(quantities, want.data() + i * size, have.data() + i * size, out.quantities);
    else
      for (QuantityJudgement& q : out.quantities) ++q.failing;
    if (out.worst.size() >= OutputJudgement::max_failures) continue;
    Failure f;
    f.x = static_cast<int>(out.records ? i : i % static_cast<std::size_t>(out.width));
    f.y = out.records ? 0 : static_cast<int>(i / static_cast<std::size_t>(out.width));
    f.distance = 1;
    if (!out.records)
      set_first_difference(info(out.format), want.data() + i * size, have.data() + i * size, f);
    else if (i < count && i < found)
      set_first_difference(expected.array.record, want.data() + i * size, have.data() + i * size, f);
    out.worst.push_back(f);
  }
  return out;
}

}  // namespace rainref::judge
