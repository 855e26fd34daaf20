// Traces failing texels in the port's own shader, and finds its lines.
#include <algorithm>
#include <cstdlib>

#include "faults/texel_replay.h"
#include "image/code_range.h"
#include "rainref/error.h"

namespace rainref::faults {

using judge::Slot;

namespace {
/// True if two stored values are further apart than two implementations may be.
bool is_far(const Slot& s, const std::byte* a, const std::byte* b) {
  const std::int64_t few = s.kind == FormatInfo::float32 ? 64 : 1;
  return std::abs(enclosed::ordered_code(s.kind, a) - enclosed::ordered_code(s.kind, b)) > few;
}
}  // namespace

StoredTexel TexelReplay::of_program(Texel at) const {
  std::vector<scalar::Scalar<float>> values(slots_.size());
  program_->evaluate(at.x, at.y, values.data());
  StoredTexel out(slots_.size());
  for (std::size_t v = 0; v < slots_.size(); ++v)
    if (!probed_.model.is_free(static_cast<int>(v)))
      judge::store_value(slots_[v], values[v].v, judge::rounding_of(slots_[v], mode_), out[v].data());
  return out;
}
std::vector<int> TexelReplay::changed_outputs(Texel at, const StoredTexel& stored) const {
  std::vector<int> out;
  for (std::size_t v = 0; v < slots_.size(); ++v) {
    const Slot& s = slots_[v];
    if (probed_.model.is_free(static_cast<int>(v))) continue;
    if (is_far(s, stored[v].data(), s.at(reference_[static_cast<std::size_t>(s.output)], at.x, at.y))) out.push_back(static_cast<int>(v));
  }
  return out;
}

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
  StoredTexel stored;
  const std::vector<Texel> tried = spread(failing_, most_tried);
  for (const Texel at : tried) {
    faulty.store(at, stored);
    const StoredTexel port = of_program(at);
    bool is_same = true;
    for (std::size_t v = 0; v < slots_.size(); ++v)
      is_same &= probed_.model.is_free(static_cast<int>(v)) || !is_far(slots_[v], stored[v].data(), port[v].data());
    std::vector<int> outputs = changed_outputs(at, stored);
    if (is_same && !outputs.empty()) agreed.push_back({at, std::move(outputs)});
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
  for (const Texel at : spread(failing_, most)) {
    std::vector<int> outputs = changed_outputs(at, of_program(at));
    if (outputs.empty()) continue;
    failing.push_back(trace(at));
    failing.back().outputs = std::move(outputs);
  }
  for (const Texel at : spread(few_passing_, most)) passing.push_back(trace(at));
} catch (const Error&) {
  failing.clear();
}

}  // namespace rainref::faults
