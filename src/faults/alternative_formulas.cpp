// Whether a port computes what a pass does by another formula, one that real arithmetic makes equal.
#include <algorithm>

#include "faults/texel_replay.h"
#include "judge/alternatives.h"
#include "judge/evaluations.h"
#include "judge/stored.h"
#include "rainref/error.h"

namespace rainref::faults {
namespace {

/// Whether the formula may give what the port stored at a texel, and bounds it.
bool holds(const capture::PassModel& model, const std::vector<judge::Slot>& slots, const capture::PassCase& c,
           const std::vector<capture::Array>& port, const enclosed::Profile& profile, judge::HalfMode mode, Texel at) {
  judge::Stored stored;
  stored.read(slots, c, model, profile, port, at.x, at.y);
  if (stored.any_impossible) return false;
  judge::Alternatives alternatives;
  alternatives.run(model, at.x, at.y, stored.got_values.data(), model.rounds_inside() ? judge::narrowed(profile, mode) : profile);
  if (alternatives.gave_up) return false;
  std::vector<enclosed::CodeRange> ranges;
  for (int a = 0; a < alternatives.count; ++a) {
    const std::vector<enclosed::Enclosure>& values = alternatives.values[static_cast<std::size_t>(a)];
    judge::code_ranges(slots, values, profile, mode, ranges);
    bool is_held = judge::inside(profile, ranges, stored);
    for (std::size_t v = 0; v < slots.size() && is_held; ++v)
      is_held = stored.free[v] || !judge::bound_of(slots[v], values[v], ranges[v]).vacuous;
    if (is_held) return true;
  }
  return false;
}

}  // namespace

std::optional<judge::Cause> alternative_formula(const capture::PassCase& c, const std::vector<capture::Array>& port,
                                                const enclosed::Profile& profile, judge::HalfMode mode, const std::vector<Texel>& failing,
                                                const std::vector<Texel>& passing) {
  const capture::PassEvaluations* evaluations = judge::evaluations_of(c.effect, c.pass);
  if (!evaluations || profile.reference || failing.empty()) return std::nullopt;
  for (const capture::AlternativeFormula& formula : evaluations->alternatives) {
    try {
      const std::unique_ptr<capture::PassModel> model = formula.bind(c);
      if (!model) continue;
      const std::vector<judge::Slot> slots = judge::slots_of(c, *model);
      const auto held = [&](const std::vector<Texel>& texels) {
        return std::count_if(texels.begin(), texels.end(), [&](Texel t) { return holds(*model, slots, c, port, profile, mode, t); });
      };
      const auto inside = static_cast<std::int64_t>(held(failing));
      if (inside * 10 < static_cast<std::int64_t>(failing.size()) * 9) continue;
      if (held(passing) * 10 < static_cast<std::ptrdiff_t>(passing.size()) * 9) continue;
      const auto of = static_cast<std::int64_t>(failing.size());
      return Tried(What{Kind::another_formula, {formula.name, formula.sentence}}, {"", "", 0, of, inside, false, of >= 4});
    } catch (const Error&) {
      continue;  // the case has not what the other formula takes
    }
  }
  return std::nullopt;
}

}  // namespace rainref::faults
