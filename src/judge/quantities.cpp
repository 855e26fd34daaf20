#include "judge/quantities.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "image/code_range.h"
#include "judge/keyed.h"
#include "scene/record_key.h"

namespace rainref::judge {

std::string unit_of(const std::string& units, int channel) {
  std::string rest = units;
  for (int k = 0; k < channel; ++k) {
    const std::size_t comma = rest.find(',');
    if (comma == std::string::npos) return units.find(',') == std::string::npos ? units : "";
    rest = rest.substr(rest.find_first_not_of(' ', comma + 1));
  }
  return rest.substr(0, rest.find(','));
}

std::vector<Quantity> quantities_of(const capture::CaseOutput& output) {
  std::vector<Quantity> out;
  if (!output.array.is_records) {
    const FormatInfo& format = info(output.array.format);
    const auto bytes = static_cast<std::size_t>(format.channel_bytes);
    for (int k = 0; k < format.channels; ++k)
      out.push_back({std::string(1, "xyzw"[k & 3]), unit_of(output.unit, k), output.range[1] - output.range[0], format.kind,
                     static_cast<std::size_t>(k) * bytes, bytes});
    return out;
  }
  for (const scene::Member& m : output.array.record.members) {
    if (m.name.starts_with("padding") || (output.judge == capture::Judge::keyed && is_key(m))) continue;
    for (int k = 0; k < m.components; ++k)
      out.push_back({m.components == 1 ? m.name : fmt::format("{}.{}", m.name, "xyzw"[k & 3]), unit_of(m.unit, k),
                     m.range ? m.range->high - m.range->low : 0,
                     m.scalar == scene::Scalar::float32 ? FormatInfo::float32 : FormatInfo::uint32,
                     m.offset + 4 * static_cast<std::size_t>(k), 4});
  }
  return out;
}

void name_quantities(const std::vector<Quantity>& quantities, OutputJudgement& out) {
  out.quantities.resize(quantities.size());
  for (std::size_t k = 0; k < quantities.size(); ++k) {
    out.quantities[k].name = quantities[k].name;
    out.quantities[k].unit = quantities[k].unit;
    out.quantities[k].extent = quantities[k].extent;
  }
}

double value_distance(FormatInfo::Kind kind, const Failure& f) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  if (f.not_a_number || f.low == INT64_MIN) return endless;
  const double distance = std::abs(enclosed::code_value(kind, f.got) - enclosed::code_value(kind, f.got < f.low ? f.low : f.high));
  return std::isfinite(distance) ? distance : endless;
}

}  // namespace rainref::judge
