#include "judge/invocation_judge.h"

#include <algorithm>

#include "judge/alternatives.h"
#include "judge/second_tier.h"
#include "judge/slots.h"
#include "judge/stored.h"

namespace rainref::judge {

using capture::Array;
using capture::PassCase;
using capture::PassModel;
using enclosed::CodeRange;

InvocationJudge::InvocationJudge(const PassCase& c, const PassModel& model, const enclosed::Profile& profile, HalfMode mode,
                                 bool asks_again)
    : case_(c), model_(model), profile_(profile), mode_(mode), keeps_(asks_again && !model.needs_port()) {}

Accepted InvocationJudge::accepts(int x, int y, const std::vector<Array>& port, const port_dump::KeptForms* kept) const {
  const std::vector<Slot> slots = slots_of(case_, model_);
  Stored stored;
  stored.read(slots, case_, model_, profile_, port, x, y, kept);
  if (stored.any_impossible) return Accepted::no;
  Known of_this_port;
  Known& all = keeps_ && stored.spread.empty() ? known(x, y) : of_this_port;
  std::call_once(all.is_written_known, [&] {
    if (profile_.reference) return all.written.only(stored);
    all.written.run(model_, x, y, stored, model_.rounds_inside() ? narrowed(profile_, mode_) : profile_);
  });
  const Alternatives& alternatives = all.written;
  if (alternatives.gave_up) return Accepted::as_written;
  std::vector<CodeRange> ranges, nearest;
  std::uint64_t least = ~std::uint64_t{0};
  for (int a = 0; a < alternatives.count; ++a) {
    code_ranges(slots, alternatives.values[static_cast<std::size_t>(a)], profile_, mode_, ranges);
    if (inside(profile_, ranges, stored)) return Accepted::as_written;
    std::uint64_t far = 0;
    for (std::size_t v = 0; v < slots.size(); ++v)
      if (!stored.free[v]) far = std::max(far, distance(stored.got[v], ranges[v]));
    if (far >= least && !nearest.empty()) continue;
    least = far;
    nearest = ranges;
  }
  SecondTier second(slots, model_, profile_);
  if (!second.exists()) return Accepted::no;
  std::call_once(all.is_rearranged_known, [&] { second.run(profile_.rearrangement, x, y, stored, mode_, all.rearranged); });
  return second.accepts(all.rearranged, stored, nearest, mode_) ? Accepted::rearranged : Accepted::no;
}

InvocationJudge::Known& InvocationJudge::known(int x, int y) const {
  const std::lock_guard lock(mutex_);
  std::unique_ptr<Known>& of = known_[{x, y}];
  if (!of) of = std::make_unique<Known>();
  return *of;
}

std::vector<char> InvocationJudge::outside(int x, int y, const std::vector<Array>& port, const port_dump::KeptForms* kept) const {
  const std::vector<Slot> slots = slots_of(case_, model_);
  Stored stored;
  stored.read(slots, case_, model_, profile_, port, x, y, kept);
  Alternatives alternatives;
  if (profile_.reference)
    alternatives.only(stored);
  else
    alternatives.run(model_, x, y, stored, model_.rounds_inside() ? narrowed(profile_, mode_) : profile_);
  std::vector<char> best(slots.size(), 1);
  std::vector<CodeRange> ranges;
  for (int a = 0; a < alternatives.count; ++a) {
    code_ranges(slots, alternatives.values[static_cast<std::size_t>(a)], profile_, mode_, ranges);
    std::vector<char> now(slots.size(), 0);
    for (std::size_t v = 0; v < slots.size(); ++v) now[v] = stored.impossible[v] || !holds(profile_, stored, v, ranges[v]);
    if (std::count(now.begin(), now.end(), 1) < std::count(best.begin(), best.end(), 1) || a == 0) best = now;
  }
  return best;
}

}  // namespace rainref::judge
