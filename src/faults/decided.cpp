// What is decided before any search: how bytes lie, a list read beyond its end, what is not a number.
#include "faults/diagnose.h"

#include <algorithm>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "faults/list_faults.h"
#include "faults/texel_replay.h"
#include "judge/bits.h"
#include "judge/keyed.h"
#include "judge/slots.h"

namespace rainref::faults {

using capture::Array;
using judge::Cause;
using judge::FailedRun;

namespace {

std::int64_t points(const Cause& c) { return c.explained + c.inside; }
/// Nearly all of it, and so near that it is no chance.
bool is_decisive(const Tried& c) {
  constexpr std::int64_t least = 8;
  return c.of >= least && c.is_likely && c.inside * 20 >= c.of * 19;
}

/// Failing elements of a list, were this what the port stored.
std::int64_t failing_with(const FailedRun& f, std::size_t output, const Array& list) {
  const capture::CaseOutput& expected = f.run.c.outputs[output];
  if (expected.judge == capture::Judge::bits) return judge::judge_bits(expected, list).failing;
  return judge::judge_keyed(expected, list, f.model ? f.model->keyed(expected.name) : nullptr, *f.options.profile).failing;
}

/// Whether all that an output holds at a texel is a number.
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
  for (const Tried& c : run.causes(run.decidable()))
    if (is_decisive(c) && (!best || points(c) > points(*best))) best = c;
  if (!best) return std::nullopt;
  for (const Tried& c : run.causes(run.of_finished()))
    if (points(c) * 50 >= points(*best) * 49) return std::nullopt;
  if (other) {
    // Of one name there may be several ways, of which one is the port's.
    std::optional<Tried> there;
    for (const Tried& c : other->causes(other->decidable()))
      if (c.name == best->name && (!there || points(c) > points(*there))) there = c;
    if (!there || there->inside * 10 < there->of * 9) return std::nullopt;
    best->explained += there->explained;
    best->inside += there->inside;
    best->of += there->of;
  }
  return *best;
}

std::optional<Cause> read_beyond_end(const FailedRun& f, std::size_t output) {
  const capture::CaseOutput& expected = f.run.c.outputs[output];
  const Array& stored = f.run.stored[output];
  if (!expected.array.is_records || stored.width <= expected.array.width) return std::nullopt;
  const Records all = records_of(stored);
  const auto right = static_cast<std::size_t>(expected.array.width);
  // How many are live: those before what is all zero, before copies of the last one, or as many as there should be.
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
    // The worst come first, and nothing is worse than what is no number.
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

}  // namespace rainref::faults
