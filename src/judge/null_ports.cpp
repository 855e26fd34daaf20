#include "judge/null_ports.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "judge/bits.h"
#include "judge/invocation_judge.h"
#include "judge/keyed.h"
#include "judge/reference_bits.h"
#include "judge/sample.h"
#include "judge/slots.h"

namespace rainref::judge {
namespace {

using capture::Array;
using capture::PassCase;

Array zeros(const Array& like) {
  Array out = like;
  if (out.is_records) {
    out.width = 0;
    out.levels.assign(1, {});
  }
  for (capture::Bytes& level : out.levels) level = capture::Bytes(level.size());
  return out;
}
bool is_interchangeable(const Array& in, const Array& out) {
  if (in.is_records != out.is_records) return false;
  if (in.is_records) return in.record.name == out.record.name && in.record.size == out.record.size;
  return in.format == out.format && in.width == out.width && in.height == out.height && !in.levels.empty();
}
/// Copies as many levels of an input as the output has.
Array copied(const Array& in, const Array& out) {
  Array copy = out;
  if (in.is_records) copy.width = in.width;
  copy.levels.assign(in.levels.begin(), in.levels.begin() + static_cast<std::ptrdiff_t>(std::min(in.levels.size(), out.levels.size())));
  return copy.levels.size() == out.levels.size() ? copy : zeros(out);
}

/// What the reference itself stores passes without computing envelopes: a pass without wipers returns its input, texel by texel.
bool is_expected(const PassCase& c, const std::vector<Array>& port) {
  for (std::size_t o = 0; o < c.outputs.size(); ++o) {
    const Array& expected = c.outputs[o].array;
    if (port[o].width != expected.width || port[o].levels != expected.levels) return false;
  }
  return true;
}
/// True if every invocation is inside. Tests a few over the whole picture first, because most null ports fail there.
bool is_inside(const PassCase& c, const capture::PassModel& model, const std::vector<Array>& port, const enclosed::Profile& profile,
               const enclosed::Profile* typical, HalfMode mode, const parallel::Executor& executor) {
  const std::vector<Slot> slots = slots_of(c, model);
  const std::vector<HalfMode> modes{mode};
  const ReferenceBits bits(c, model, port, slots, modes);
  const InvocationJudge by_profile(c, model, profile, mode);
  std::optional<InvocationJudge> by_typical;
  if (typical) by_typical.emplace(c, model, *typical, mode);
  const auto accepts = [&](int x, int y) {
    return bits.has(0, x, y) || (by_profile.accepts(x, y, port) == Accepted::as_written &&
                                 (!by_typical || by_typical->accepts(x, y, port) == Accepted::as_written));
  };
  constexpr std::int64_t few = 256;
  const Sample some(c, model, few);
  std::atomic<bool> is_every = true;
  some.each(1, [&](int x, int y) { is_every = is_every && accepts(x, y); });
  if (some.is_whole() || !is_every) return is_every;
  executor.for_tiles(model.width(), model.height(), model.width(), 1, [&](const parallel::Tile& tile) {
    for (int x = tile.x0; x < tile.x1 && is_every; ++x)
      if (!accepts(x, tile.y0)) is_every = false;
  });
  return is_every;
}
/// Values without a useful bound in the profile must lie inside what known devices do, as in any judgement.
bool passes(const PassCase& c, const capture::PassModel* model, const std::vector<Array>& port, const enclosed::Profile& profile,
            const enclosed::Profile* typical, HalfMode mode, const parallel::Executor& executor) {
  if (is_expected(c, port)) return true;
  for (std::size_t o = 0; o < c.outputs.size(); ++o) {
    const capture::CaseOutput& out = c.outputs[o];
    if (out.judge == capture::Judge::bits && judge_bits(out, port[o]).failing > 0) return false;
    if (is_placed(out) && port[o].width != out.array.width) return false;
    if (out.judge == capture::Judge::keyed && !is_placed(out) &&
        judge_keyed(out, port[o], model ? model->keyed(out.name) : nullptr, profile).failing > 0)
      return false;
  }
  return slots_of(c).empty() || is_inside(c, *model, port, profile, typical, mode, executor);
}

}  // namespace

std::vector<NullPort> null_ports(const PassCase& c) {
  std::vector<NullPort> all(1, {"zeros", {}});
  for (const capture::CaseOutput& out : c.outputs) all.front().outputs.push_back(zeros(out.array));
  for (const capture::CaseInput& in : c.inputs) {
    NullPort port{"a copy of its input " + in.name, all.front().outputs};
    bool is_one = false;
    for (std::size_t o = 0; o < c.outputs.size(); ++o) {
      if (!is_interchangeable(in.array, c.outputs[o].array)) continue;
      port.outputs[o] = copied(in.array, c.outputs[o].array);
      is_one = true;
    }
    if (is_one) all.push_back(std::move(port));
  }
  return all;
}

void NullPorts::judge(const PassCase& c, const capture::PassModel* model, const enclosed::Profile& profile,
                      const enclosed::Profile* typical, HalfMode mode, const parallel::Executor& executor) {
  if (std::all_of(c.outputs.begin(), c.outputs.end(), [](const auto& o) { return o.judge == capture::Judge::input_only; })) return;
  if (judged_ && passing_.empty()) return;
  std::vector<std::string> still;
  for (const NullPort& port : null_ports(c)) {
    if (judged_ && std::find(passing_.begin(), passing_.end(), port.what) == passing_.end()) continue;
    if (passes(c, model, port.outputs, profile, typical, mode, executor)) still.push_back(port.what);
  }
  passing_ = std::move(still);
  judged_ = true;
}

}  // namespace rainref::judge
