// Traces failing texels in the port's own shader, and finds its lines.
#include <algorithm>
#include <cstdlib>

#include "faults/texel_replay.h"
#include "image/code_range.h"
#include "rainref/error.h"

namespace rainref::faults {

using judge::Slot;

namespace {
/// Codes by which two implementations may differ.
std::int64_t few_codes(const Slot& s) { return s.kind == FormatInfo::float32 ? 64 : 1; }
}  // namespace

void TexelReplay::follow(const Fault& d, std::vector<Followed>& out) const try {
  constexpr std::size_t most_tried = 48, most = 12;
  if (!program_ || program_->values() != probed_.model.values()) return;
  const FaultyPass faulty(d, probed_.c, probed_.bind, probed_.model, mode_, reference_);
  if (!faulty.applies()) return;
  // Texels where the mistake gives what the port's program gives, independent of the device.
  struct Agreed {
    Texel at;
    std::vector<int> outputs;
  };
  std::vector<Agreed> agreed;
  StoredTexel stored(slots_.size()), of_port(slots_.size());
  std::vector<scalar::Scalar<float>> values(slots_.size());
  const std::vector<Texel> tried = spread(failing_, most_tried);
  for (const Texel at : tried) {
    faulty.store(at, stored);
    program_->evaluate(at.x, at.y, values.data());
    Agreed one{at, {}};
    bool is_same = true;
    for (std::size_t v = 0; v < slots_.size(); ++v) {
      const Slot& s = slots_[v];
      if (probed_.model.is_free(static_cast<int>(v))) continue;
      judge::store_value(s, values[v].v, judge::rounding_of(s, mode_), of_port[v].data());
      const auto code = [&](const std::byte* bytes) { return enclosed::ordered_code(s.kind, bytes); };
      const std::int64_t with = code(stored[v].data()), given = code(of_port[v].data());
      const std::int64_t right = code(s.at(reference_[static_cast<std::size_t>(s.output)], at.x, at.y));
      const std::int64_t few = few_codes(s);
      is_same &= std::abs(with - given) <= few;
      if (std::abs(with - right) > few) one.outputs.push_back(static_cast<int>(v));
    }
    if (is_same && !one.outputs.empty()) agreed.push_back(std::move(one));
  }
  if (agreed.size() * 3 < tried.size()) return;
  for (std::size_t k = 0; k < std::min(most, agreed.size()); ++k) {
    Agreed& chosen = agreed[k * agreed.size() / std::min(most, agreed.size())];
    Followed& one = out.emplace_back();
    one.outputs = std::move(chosen.outputs);
    faulty.trace(chosen.at, one.right, one.wrong);
    program_->trace(chosen.at.x, chosen.at.y, one.port);
  }
} catch (const Error&) {
  out.clear();  // the program uses something unsupported: a note says so
}

void TexelReplay::follow_right(std::vector<Followed>& failing, std::vector<Followed>& passing) const try {
  constexpr std::size_t most = 12;
  if (!program_ || program_->values() != probed_.model.values()) return;
  const Fault none;
  const FaultyPass right(none, probed_.c, probed_.bind, probed_.model, mode_, reference_);
  const auto trace = [&](Texel at) {
    Followed one;
    right.trace(at, one.right, one.wrong);
    program_->trace(at.x, at.y, one.port);
    return one;
  };
  std::vector<scalar::Scalar<float>> values(slots_.size());
  StoredTexel of_port(slots_.size());
  for (const Texel at : spread(failing_, most)) {
    program_->evaluate(at.x, at.y, values.data());
    std::vector<int> outputs;
    for (std::size_t v = 0; v < slots_.size(); ++v) {
      const Slot& s = slots_[v];
      if (probed_.model.is_free(static_cast<int>(v))) continue;
      judge::store_value(s, values[v].v, judge::rounding_of(s, mode_), of_port[v].data());
      const auto code = [&](const std::byte* bytes) { return enclosed::ordered_code(s.kind, bytes); };
      const std::byte* const meant = s.at(reference_[static_cast<std::size_t>(s.output)], at.x, at.y);
      if (std::abs(code(of_port[v].data()) - code(meant)) > few_codes(s)) outputs.push_back(static_cast<int>(v));
    }
    if (outputs.empty()) continue;
    failing.push_back(trace(at));
    failing.back().outputs = std::move(outputs);
  }
  for (const Texel at : spread(few_passing_, most)) passing.push_back(trace(at));
} catch (const Error&) {
  failing.clear();
}

}  // namespace rainref::faults
