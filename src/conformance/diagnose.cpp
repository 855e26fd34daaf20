// Hypothesis replay: which single deviation stores the bits that a port stored where it fails.
#include <algorithm>
#include <cstring>

#include "conformance/judge.h"
#include "conformance/validate.h"
#include "rainref/error.h"

namespace rainref::conformance {
namespace {

using capture::Array;

/// Failing texels, spread evenly when there are many.
std::vector<Texel> failing_texels(const CaseJudgement& j, std::size_t most) {
  std::vector<Texel> all;
  for (const OutputJudgement& o : j.outputs)
    for (std::size_t i = 0; i < o.map.size(); ++i)
      if (o.map[i] == 3) all.push_back({static_cast<int>(i) % o.width, static_cast<int>(i) / o.width});
  std::sort(all.begin(), all.end(), [](Texel a, Texel b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  all.erase(std::unique(all.begin(), all.end(), [](Texel a, Texel b) { return a.x == b.x && a.y == b.y; }), all.end());
  if (all.size() <= most) return all;
  std::vector<Texel> some;
  for (std::size_t k = 0; k < most; ++k) some.push_back(all[k * all.size() / most]);
  return some;
}

bool same_bits(const std::vector<Slot>& slots, const std::vector<Array>& a, const std::vector<Array>& b, Texel t) {
  for (const Slot& s : slots) {
    const std::size_t o = static_cast<std::size_t>(s.output);
    if (s.code(a[o], t.x, t.y) != s.code(b[o], t.x, t.y)) return false;
  }
  return true;
}

}  // namespace

std::vector<Cause> diagnose(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before, Bind bind,
                            const capture::PassModel& model, const std::vector<Array>& port, const CaseJudgement& judgement,
                            const enclosed::Profile& profile, HalfMode mode, const parallel::Executor& executor) {
  const std::vector<Texel> failing = failing_texels(judgement, 400);
  if (failing.empty()) return {};
  const std::vector<Slot> slots = slots_of(c);
  const std::vector<Deviation> all = deviations_of(pass, c, model, before);
  std::vector<Cause> causes(all.size());
  std::vector<Array> blank;
  for (const capture::CaseOutput& o : c.outputs) blank.push_back(o.array);

  executor.for_range(static_cast<std::int64_t>(all.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k) {
      const Deviation& d = all[static_cast<std::size_t>(k)];
      Cause& cause = causes[static_cast<std::size_t>(k)];
      cause.name = d.name;
      cause.sentence = d.sentence;
      cause.of = static_cast<std::int64_t>(failing.size());
      try {
        const DeviatedPass deviated(d, c, bind, model);
        if (!deviated.applies()) continue;
        std::vector<Array> stored = blank;
        for (const Texel t : failing) {
          deviated.store(t, mode, stored);
          cause.explained += same_bits(slots, stored, port, t);
        }
      } catch (const Error&) {
        cause.explained = 0;  // the altered case is none that the pass can run
      }
    }
  });
  // A deviation that explains few texels of many explains nothing: a tenth is asked.
  std::vector<Cause> found;
  for (Cause& cause : causes)
    if (cause.explained * 10 >= cause.of && cause.explained > 0) found.push_back(std::move(cause));
  std::stable_sort(found.begin(), found.end(), [](const Cause& a, const Cause& b) { return a.explained > b.explained; });
  if (found.size() > 3) found.resize(3);
  static_cast<void>(profile);
  return found;
}

}  // namespace rainref::conformance
