// Causes that are found without a search: byte layout, a list read beyond its end, NaN, or another formula that is equal in real
// arithmetic.
#include <algorithm>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "faults/diagnose.h"
#include "faults/list_faults.h"
#include "faults/texel_replay.h"
#include "judge/alternatives.h"
#include "judge/bits.h"
#include "judge/evaluations.h"
#include "judge/keyed.h"
#include "judge/slots.h"
#include "judge/stored.h"
#include "rainref/error.h"

namespace rainref::faults {

using capture::Array;
using judge::Cause;
using judge::FailedRun;

namespace {

std::int64_t points(const Cause& c) { return c.explained + c.inside; }
/// It explains nearly all failures, so well that this is not chance.
bool is_decisive(const Tried& c) {
  constexpr std::int64_t least = 8;
  return c.of >= least && c.is_likely && c.inside * 20 >= c.of * 19;
}

/// Number of failing elements of a list if the port had stored `list`.
std::int64_t failing_with(const FailedRun& f, std::size_t output, const Array& list) {
  const capture::CaseOutput& expected = f.run.c.outputs[output];
  if (expected.judge == capture::Judge::bits) return judge::judge_bits(expected, list).failing;
  return judge::judge_keyed(expected, list, f.model ? f.model->keyed(expected.name) : nullptr, *f.options.profile).failing;
}

/// True if all values of an output at a texel are numbers.
bool is_a_number(const FailedRun& f, const judge::OutputJudgement& o, Texel t) {
  for (const judge::Slot& s : judge::slots_of(f.run.c)) {
    const auto output = static_cast<std::size_t>(s.output);
    if (f.run.c.outputs[output].name == o.name && judge::is_nan(s.kind, s.at(f.run.stored[output], t.x, t.y))) return false;
  }
  return true;
}

}  // namespace

std::optional<Cause> decided(const TexelReplay& run, const TexelReplay* other) {
  std::optional<Tried> best;
  const std::vector<Fault> faults = run.decidable();
  for (const Tried& c : run.causes(faults))
    if (is_decisive(c) && (!best || points(c) > points(*best))) best = c;
  if (!best) return std::nullopt;
  for (const Tried& c : run.causes(run.of_finished()))
    if (points(c) * 50 >= points(*best) * 49) return std::nullopt;
  if (other) {
    // One name may cover several variants, of which one is the port's.
    std::optional<Tried> there;
    for (const Tried& c : other->causes(other->decidable()))
      if (c.name == best->name && (!there || points(c) > points(*there))) there = c;
    if (!there || there->inside * 10 < there->of * 9) return std::nullopt;
    best->explained += there->explained;
    best->inside += there->inside;
    best->of += there->of;
  }
  std::vector<Tried> found{*best};
  add_lines(run, nullptr, found, found, {});
  return found.front();
}

std::optional<Cause> read_beyond_end(const FailedRun& f, std::size_t output) {
  const capture::CaseOutput& expected = f.run.c.outputs[output];
  const Array& stored = f.run.stored[output];
  if (!expected.array.is_records || stored.width <= expected.array.width) return std::nullopt;
  const Records all = records_of(stored);
  const auto right = static_cast<std::size_t>(expected.array.width);
  // Number of live records: those before all-zero records, before copies of the last one, or the expected number.
  const auto last_unlike = [&](const std::vector<std::byte>& dead) {
    return static_cast<std::size_t>(std::find_if(all.rbegin(), all.rend(), [&](const auto& r) { return r != dead; }).base() - all.begin());
  };
  const std::size_t before_zeros = last_unlike(std::vector<std::byte>(stored.record.size)), before_copies = last_unlike(all.back());
  const std::int64_t failing = failing_with(f, output, stored);
  for (const std::size_t live : std::set<std::size_t>{before_zeros, before_copies, right}) {
    if (live >= all.size() || failing_with(f, output, array_of({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(live)}, stored)) > 0)
      continue;
    const Kind kind = live == before_zeros    ? Kind::list_read_into_zeros
                      : live == before_copies ? Kind::list_read_into_copies
                                              : Kind::list_read_beyond_end;
    Tried cause(What{kind, {expected.name, std::to_string(live), std::to_string(all.size() - live)}},
                {"", "", failing, failing, failing, true, true});
    return cause;
  }
  return std::nullopt;
}

std::optional<Cause> not_numbers(const FailedRun& f) {
  std::int64_t failing = 0;
  for (const judge::OutputJudgement& o : f.judgement.outputs) {
    failing += o.failing;
    // The worst come first, and NaN is the worst.
    if (o.failing > 0 && (o.worst.empty() || !o.worst.back().not_a_number)) return std::nullopt;
    for (std::size_t i = 0; i < o.map.size(); ++i)
      if (o.map[i] == 3 && is_a_number(f, o, {static_cast<int>(i) % o.width, static_cast<int>(i) / o.width})) return std::nullopt;
  }
  if (failing == 0) return std::nullopt;
  for (const judge::CaseJudgement& c : f.judged.cases)
    for (const judge::OutputJudgement& o : c.outputs) {
      if (o.worst.empty() || !o.worst.front().not_a_number) continue;
      const judge::Failure& first = o.worst.front();
      const std::string place = o.records ? fmt::format("{} of record {}", first.field, first.x)
                                          : fmt::format("({}, {}).{}", first.x, first.y, "xyzw"[first.channel & 3]);
      Tried cause(What{Kind::not_a_number, {place, o.name, c.id}}, {"", "", failing, failing, failing, o.records, true});
      return cause;
    }
  return std::nullopt;
}

namespace {

/// True if the formula allows what the port stored at a texel, and bounds it.
bool holds(const capture::PassModel& model, const std::vector<judge::Slot>& slots, const capture::PassCase& c,
           const std::vector<capture::Array>& port, const enclosed::Profile& profile, judge::HalfMode mode, Texel at) {
  judge::Stored stored;
  stored.read(slots, c, model, profile, port, at.x, at.y);
  if (stored.any_impossible) return false;
  judge::Alternatives alternatives;
  alternatives.run(model, at.x, at.y, stored, model.rounds_inside() ? judge::narrowed(profile, mode) : profile);
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
      continue;  // the case lacks an input of the other formula
    }
  }
  return std::nullopt;
}

}  // namespace rainref::faults
