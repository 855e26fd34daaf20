#include "judge/host_values.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "capture/difference.h"
#include "image/code_range.h"
#include "judge/keyed.h"

namespace rainref::judge {
namespace {

using capture::Array;

/// Compares the components of one vector.
Likeness compare_vector(const double (&expected)[4], const double (&given)[4], int count, double floor) {
  double scale = 0;
  for (int k = 0; k < count; ++k) scale = std::max(scale, std::abs(expected[k]));
  const double most = std::max(host_share * scale, floor);
  for (int k = 0; k < count; ++k)
    if (!(std::abs(given[k] - expected[k]) <= most)) return Likeness::other;  // false for NaN too
  return Likeness::rounded;
}

Likeness compare_texel(FormatInfo::Kind kind, int channels, int bytes, const std::byte* expected, const std::byte* given) {
  if (std::memcmp(expected, given, static_cast<std::size_t>(channels * bytes)) == 0) return Likeness::same;
  if (kind == FormatInfo::uint32) return Likeness::other;
  double want[4] = {}, have[4] = {};
  bool is_next = kind != FormatInfo::float32;  // the neighbouring code, for formats of few bits
  for (int k = 0; k < channels; ++k) {
    const std::int64_t a = enclosed::ordered_code(kind, expected + k * bytes), b = enclosed::ordered_code(kind, given + k * bytes);
    is_next &= std::abs(a - b) <= 1;
    want[k] = enclosed::code_value(kind, a);
    have[k] = enclosed::code_value(kind, b);
  }
  return is_next ? Likeness::rounded : compare_vector(want, have, channels, 0);
}

}  // namespace

Likeness compare_member(const scene::Member& m, const std::byte* expected, const std::byte* given) {
  const std::byte *want = expected + m.offset, *have = given + m.offset;
  if (std::memcmp(want, have, m.size()) == 0) return Likeness::same;
  if (m.scalar != scene::Scalar::float32) return Likeness::other;
  double a[4] = {}, b[4] = {};
  for (int k = 0; k < m.components; ++k) {
    float value;
    std::memcpy(&value, want + 4 * k, 4);
    a[k] = value;
    std::memcpy(&value, have + 4 * k, 4);
    b[k] = value;
  }
  const bool may_be_negative = m.range && m.range->low < 0;
  return compare_vector(a, b, m.components, may_be_negative ? host_floor * std::min(1.0, m.range->high - m.range->low) : 0);
}

Likeness compare_arrays(const Array& expected, const Array& given) {
  if (expected.is_records && expected.width == 0 && given.is_records && given.width == 1 && given.record.name == expected.record.name &&
      std::all_of(given.levels[0].begin(), given.levels[0].end(), [](std::byte b) { return b == std::byte{0}; }))
    return Likeness::same;
  if (!capture::same_shape(expected, given)) return Likeness::other;
  Likeness worst = Likeness::same;
  const std::size_t size = expected.element_bytes();
  const FormatInfo& format = info(expected.format);
  for (std::size_t l = 0; l < expected.levels.size(); ++l) {
    for (std::size_t at = 0; at + size <= expected.levels[l].size() && worst != Likeness::other; at += size) {
      const std::byte *want = &expected.levels[l][at], *have = &given.levels[l][at];
      if (!expected.is_records) {
        worst = std::max(worst, compare_texel(format.kind, format.channels, format.channel_bytes, want, have));
        continue;
      }
      for (const scene::Member& m : expected.record.members)
        if (!m.name.starts_with("padding")) worst = std::max(worst, compare_member(m, want, have));
    }
  }
  const bool is_a_set = expected.is_records && has_key(expected.record);
  return worst == Likeness::other && is_a_set && same_records(expected, given) ? Likeness::same : worst;
}

}  // namespace rainref::judge
