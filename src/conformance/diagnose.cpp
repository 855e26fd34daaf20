// Hypothesis replay: which single deviation stores the bits that a port stored where it fails.
#include <algorithm>

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

/// How a deviation's texel compares with the port's.
struct Match {
  bool exact = false;  ///< the same bits
  bool near = false;   ///< as near as a device's own differences, and much nearer than the reference
};

std::int64_t gap(std::int64_t a, std::int64_t b) { return a < b ? b - a : a - b; }

/// `usual`: for each slot the codes that the envelope usually accepts beside one.
Match compare(const std::vector<Slot>& slots, const capture::PassModel& model, const std::vector<Array>& deviated, const std::vector<Array>& port,
              const std::vector<Array>& reference, const std::vector<std::int64_t>& usual, Texel t) {
  Match m{true, true};
  bool nearer = false;
  for (std::size_t v = 0; v < slots.size(); ++v) {
    if (model.is_free(static_cast<int>(v))) continue;
    const Slot& s = slots[v];
    const std::size_t o = static_cast<std::size_t>(s.output);
    const std::int64_t got = s.code(port[o], t.x, t.y), far = gap(got, s.code(deviated[o], t.x, t.y)), before = gap(got, s.code(reference[o], t.x, t.y));
    m.exact &= far == 0;
    m.near &= far <= usual[v];
    nearer |= far < before && 4 * far <= before;
  }
  m.exact &= nearer;  // else the reference gives the same bits, and the deviation explains nothing
  m.near &= nearer;
  return m;
}

std::vector<std::int64_t> usual_widths(const std::vector<Slot>& slots, const capture::PassCase& c, const CaseJudgement& j) {
  std::vector<std::int64_t> out;
  for (const Slot& s : slots) {
    const std::string& name = c.outputs[static_cast<std::size_t>(s.output)].name;
    const auto found = std::find_if(j.outputs.begin(), j.outputs.end(), [&](const OutputJudgement& o) { return o.name == name; });
    out.push_back(1 + (found == j.outputs.end() ? 0 : static_cast<std::int64_t>(found->median_width)));
  }
  return out;
}

}  // namespace

std::vector<Cause> diagnose(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before, Bind bind,
                            const capture::PassModel& model, const std::vector<Array>& port, const CaseJudgement& judgement,
                            HalfMode mode, const parallel::Executor& executor) {
  const std::vector<Texel> failing = failing_texels(judgement, 400);
  if (failing.empty()) return {};
  const std::vector<Slot> slots = slots_of(c);
  const std::vector<Deviation> all = deviations_of(pass, c, model, before);
  const std::vector<Array> reference = reference_outputs(c, model, executor, mode);
  const std::vector<std::int64_t> usual = usual_widths(slots, c, judgement);
  std::vector<Cause> causes(all.size());

  executor.for_range(static_cast<std::int64_t>(all.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k) {
      const Deviation& d = all[static_cast<std::size_t>(k)];
      Cause& cause = causes[static_cast<std::size_t>(k)];
      cause.name = d.name;
      cause.sentence = d.sentence;
      cause.of = static_cast<std::int64_t>(failing.size());
      try {
        const DeviatedPass deviated(d, c, bind, model, mode, reference);
        if (!deviated.applies()) continue;
        std::vector<Array> stored = reference;
        for (const Texel t : failing) {
          deviated.store(t, stored);
          const Match m = compare(slots, model, stored, port, reference, usual, t);
          cause.explained += m.exact;
          cause.inside += m.near;
        }
      } catch (const Error&) {
        cause.explained = cause.inside = 0;  // the altered case is none that the pass can run
      }
    }
  });
  // A deviation that explains few texels of many explains nothing: a tenth is asked.
  std::vector<Cause> found;
  for (Cause& cause : causes)
    if (cause.inside * 10 >= cause.of && cause.inside > 0) found.push_back(std::move(cause));
  std::stable_sort(found.begin(), found.end(), [](const Cause& a, const Cause& b) { return a.inside != b.inside ? a.inside > b.inside : a.explained > b.explained; });
  if (found.size() > 3) found.resize(3);
  return found;
}

}  // namespace rainref::conformance
