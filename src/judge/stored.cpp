#include "judge/stored.h"

#include <cstring>

namespace rainref::judge {

using capture::Array;
using capture::PassCase;
using capture::PassModel;
using enclosed::CodeRange;

std::optional<std::array<double, 2>> free_range(const PassModel& model, std::size_t value, const enclosed::Profile& profile) {
  return profile.reference ? std::nullopt : model.free_range(static_cast<int>(value));
}

void Stored::read(const std::vector<Slot>& slots, const PassCase& c, const PassModel& model, const enclosed::Profile& profile,
                  const std::vector<Array>& port, int x, int y, const port_dump::KeptForms* kept) {
  const std::size_t n = slots.size();
  got.resize(n);
  expected.resize(n);
  got_values.resize(n);
  expected_values.resize(n);
  same.resize(n);
  free.resize(n);
  impossible.resize(n);
  any_impossible = false;
  spread.clear();
  for (std::size_t v = 0; v < n; ++v) {
    const Slot& s = slots[v];
    const std::size_t o = static_cast<std::size_t>(s.output);
    const std::byte *have = s.at(port[o], x, y), *want = s.at(c.outputs[o].array, x, y);
    got[v] = enclosed::ordered_code(s.kind, have);
    expected[v] = enclosed::ordered_code(s.kind, want);
    got_values[v] = stored_value(s, have);
    expected_values[v] = stored_value(s, want);
    same[v] = std::memcmp(have, want, static_cast<std::size_t>(s.channel_bytes)) == 0;
    const auto range = free_range(model, v, profile);
    free[v] = range.has_value();
    impossible[v] = is_nan(s.kind, have) || (range && !(got_values[v] >= (*range)[0] && got_values[v] <= (*range)[1]));
    any_impossible |= impossible[v] != 0;
    if (!kept || kept->empty() || !(*kept)[o] || (*kept)[o]->spread.empty()) continue;
    spread.resize(n);
    const auto texel = static_cast<std::size_t>(y) * static_cast<std::size_t>(s.width) + static_cast<std::size_t>(x);
    spread[v] = (*kept)[o]->spread[texel * static_cast<std::size_t>(s.texel_bytes / s.channel_bytes) + static_cast<std::size_t>(s.channel)];
  }
}

bool holds(const enclosed::Profile& profile, const Stored& stored, std::size_t v, const CodeRange& range) {
  if (profile.reference && stored.is_known(v)) return stored.same[v];
  return stored.free[v] ? !stored.impossible[v] : range.contains(stored.got[v]);
}
bool inside(const enclosed::Profile& profile, const std::vector<CodeRange>& ranges, const Stored& stored) {
  for (std::size_t v = 0; v < ranges.size(); ++v)
    if (!holds(profile, stored, v, ranges[v])) return false;
  return true;
}

}  // namespace rainref::judge
