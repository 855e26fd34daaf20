#include "faults/diagnose.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "faults/alternative_formulas.h"
#include "faults/fault.h"
#include "faults/failing_texels.h"
#include "faults/hypotheses.h"
#include "faults/where.h"
#include "image/code_range.h"
#include "judge/judge.h"
#include "judge/keyed.h"
#include "judge/reference_outputs.h"
#include "math/path_enumeration.h"
#include "rainref/error.h"

namespace rainref::faults {
namespace {

using capture::Array;
using judge::Bind;
using judge::CaseJudgement;
using judge::Cause;
using judge::HalfMode;
using judge::is_enveloped;
using judge::keyed_outputs;
using judge::OutputJudgement;
using judge::reference_outputs;
using judge::Slot;
using judge::slots_of;
using judge::stored_value;

/// Texels that passed.
std::vector<Texel> passing_texels(const capture::PassModel& model, const std::vector<Texel>& failing) {
  std::vector<Texel> out;
  auto next = failing.begin();
  for (int y = 0; y < model.height(); ++y)
    for (int x = 0; x < model.width(); ++x) {
      if (next != failing.end() && next->x == x && next->y == y)
        ++next;
      else
        out.push_back({x, y});
    }
  return out;
}

/// How a fault's texel compares with the port's.
struct Match {
  bool exact = false;  ///< the same bits
  bool near = false;   ///< as near as a device's own differences, and much nearer than the reference
  bool tells = false;  ///< so near, or so much nearer than the reference, that it is no chance
};

std::int64_t gap(std::int64_t a, std::int64_t b) { return a < b ? b - a : a - b; }

/// How far a conforming device may be from the reference, roughly: in codes as the case's envelopes are, in values as the
/// texel's own is.
struct Leeway {
  std::vector<std::int64_t> codes;          // of each slot
  std::vector<std::vector<double>> values;  // of each texel and slot
};
Leeway leeway_of(const std::vector<Slot>& slots, const capture::PassCase& c, const capture::PassModel& model,
                 const std::vector<Array>& reference, const CaseJudgement& j, const enclosed::Profile& profile,
                 const std::vector<Texel>& texels) {
  Leeway out;
  for (const Slot& s : slots) {
    const std::string& name = c.outputs[static_cast<std::size_t>(s.output)].name;
    const auto found = std::find_if(j.outputs.begin(), j.outputs.end(), [&](const OutputJudgement& o) { return o.name == name; });
    // What 99 % of the envelopes stay below, unless these few are far wider than most.
    const double width = found == j.outputs.end() ? 0 : std::min(found->p99_width, 4 * found->median_width + 4);
    out.codes.push_back(1 + static_cast<std::int64_t>(width));
  }
  const enclosed::ProfileScope scope(profile);
  std::vector<enclosed::Enclosure> values(slots.size());
  std::vector<float> stored(slots.size());
  for (const Texel t : texels) {
    for (std::size_t v = 0; v < slots.size(); ++v)
      stored[v] = stored_value(slots[v], slots[v].at(reference[static_cast<std::size_t>(slots[v].output)], t.x, t.y));
    std::vector<double>& widths = out.values.emplace_back(slots.size(), 0.0);
    enclosed::PathEnumeration paths;
    paths.for_each_alternative([&] {
      model.enclose(t.x, t.y, stored.data(), values.data());
      // A bound that is hardly one would let everything count as near.
      for (std::size_t v = 0; v < slots.size(); ++v)
        if (!values[v].is_vacuous())
          widths[v] = std::max(widths[v], std::min(static_cast<double>(values[v].hi) - values[v].lo, slots[v].range / 64));
    });
  }
  return out;
}

/// Of texel number k.
Match compare(const std::vector<Slot>& slots, const capture::PassModel& model, const std::vector<Array>& faulty,
              const std::vector<Array>& port, const std::vector<Array>& reference, const Leeway& leeway, const std::vector<Texel>& texels,
              std::size_t k) {
  Match m{true, true, true};
  bool nearer = false;
  for (std::size_t v = 0; v < slots.size(); ++v) {
    if (model.is_free(static_cast<int>(v))) continue;
    const Slot& s = slots[v];
    const std::size_t o = static_cast<std::size_t>(s.output);
    const std::byte *got = s.at(port[o], texels[k].x, texels[k].y), *guess = s.at(faulty[o], texels[k].x, texels[k].y),
                    *base = s.at(reference[o], texels[k].x, texels[k].y);
    const auto code = [&](const std::byte* at) { return enclosed::ordered_code(s.kind, at); };
    const std::int64_t far = gap(code(got), code(guess)), before = gap(code(got), code(base));
    const double off = std::abs(static_cast<double>(stored_value(s, got)) - stored_value(s, guess));
    m.exact &= far == 0;
    m.near &= far <= leeway.codes[v] || off <= leeway.values[k][v];
    nearer |= far < before && 4 * far <= before;
    m.tells &= far == 0 || 16 * far <= before;
  }
  m.exact &= nearer;  // else the reference gives the same bits, and the fault explains nothing
  m.near &= nearer;
  m.tells &= m.near;
  return m;
}

/// Share of the texels that passed and where the fault would store clearly other codes than the port did.
double contradicted(const std::vector<Slot>& slots, const capture::PassModel& model, const FaultyPass& faulty,
                    const std::vector<Array>& port, const std::vector<Array>& reference, const Leeway& leeway,
                    const std::vector<Texel>& passing) {
  std::vector<Array> stored = reference;
  std::int64_t against = 0;
  for (const Texel t : passing) {
    faulty.store(t, stored);
    against += std::any_of(slots.begin(), slots.end(), [&](const Slot& s) {
      const std::size_t o = static_cast<std::size_t>(s.output), v = static_cast<std::size_t>(&s - slots.data());
      if (model.is_free(static_cast<int>(v))) return false;
      const auto code = [&](const std::vector<Array>& a) { return enclosed::ordered_code(s.kind, s.at(a[o], t.x, t.y)); };
      return gap(code(stored), code(port)) > 2 * leeway.codes[v] + gap(code(reference), code(port));
    });
  }
  return passing.empty() ? 0 : static_cast<double>(against) / static_cast<double>(passing.size());
}

}  // namespace

std::vector<Cause> diagnose_texels(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before, Bind bind,
                                   const capture::PassModel& model, const std::vector<Array>& port, const CaseJudgement& judgement,
                                   const enclosed::Profile& profile, HalfMode mode, const parallel::Executor& executor) {
  const std::vector<Texel> all_failing = failing_texels(judgement), failing = spread(all_failing, 400);
  if (failing.empty()) return {};
  const std::vector<Slot> slots = slots_of(c);
  const std::vector<Array> reference = reference_outputs(c, model, executor, mode);
  const Leeway leeway = leeway_of(slots, c, model, reference, judgement, profile, failing);
  const std::vector<Texel> passing = passing_texels(model, all_failing), few_passing = spread(passing, 400),
                           many_passing = spread(passing, 20000);
  const double passing_per_failing = static_cast<double>(passing.size()) / static_cast<double>(all_failing.size());
  const std::vector<Fault> all = hypotheses({pass, c, bind, model}, before, port, reference, failing);
  // Most hypotheses are none after a few texels; what explains too few of these is not tried on all.
  std::vector<std::size_t> few(std::min<std::size_t>(failing.size(), 24));
  for (std::size_t k = 0; k < few.size(); ++k) few[k] = k * failing.size() / few.size();
  std::vector<Cause> causes(all.size());

  executor.for_range(static_cast<std::int64_t>(all.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k) {
      const Fault& d = all[static_cast<std::size_t>(k)];
      Cause& cause = causes[static_cast<std::size_t>(k)];
      cause.name = d.name;
      cause.sentence = d.sentence;
      cause.of = static_cast<std::int64_t>(failing.size());
      try {
        const FaultyPass faulty(d, c, bind, model, mode, reference);
        if (!faulty.applies()) continue;
        std::vector<Array> stored = reference;
        const auto match_at = [&](std::size_t t) {
          faulty.store(failing[t], stored);
          return compare(slots, model, stored, port, reference, leeway, failing, t);
        };
        const auto matching = std::count_if(few.begin(), few.end(), [&](std::size_t t) { return match_at(t).near; });
        if (static_cast<std::size_t>(matching) * 6 < few.size()) continue;
        std::int64_t telling = 0;
        for (std::size_t t = 0; t < failing.size(); ++t) {
          const Match m = match_at(t);
          cause.explained += m.exact;
          cause.inside += m.near;
          telling += m.tells;
        }
        // In a buffer that is nearly empty a mirror image, too, has zero wherever the port lost something. A cause must not
        // break about as many texels as it explains.
        const double broken = contradicted(slots, model, faulty, port, reference, leeway, d.is_evaluated() ? few_passing : many_passing) *
                              passing_per_failing;
        if (broken * 4 > 1) cause.explained = cause.inside = 0;
        cause.is_likely = telling * 10 >= cause.of * 9;
      } catch (const Error&) {
        cause.explained = cause.inside = 0;  // the altered case is none that the pass can run
      }
    }
  });
  std::vector<Cause> best = best_causes(std::move(causes));
  // What gives the very bits is a better word than a formula that could have given them.
  const bool is_exact = !best.empty() && best.front().is_likely && best.front().explained * 10 >= best.front().of * 9;
  if (is_exact) return best;
  if (std::optional<Cause> other = alternative_formula(c, port, profile, mode, failing, few_passing)) {
    for (Cause& cause : best) cause.is_likely = false;
    best.insert(best.begin(), std::move(*other));
    if (best.size() > 3) best.pop_back();
  }
  return best;
}

judge::Explanation diagnose(const judge::FailedRun& failed) {
  const capture::PassCase& c = failed.run.c;
  const judge::JudgeOptions& options = failed.options;
  judge::Explanation why{{}, where_it_fails(failed)};
  if (!keyed_outputs(c).empty()) {
    why.causes = diagnose_lists(failed.pass, c, failed.before, failed.model, failed.run.stored, *options.profile, *options.executor);
    if (!why.causes.empty() || !failed.bind || !is_enveloped(c)) return why;
  }
  why.causes = diagnose_texels(failed.pass, c, failed.before, failed.bind, *failed.model, failed.run.stored, failed.judgement,
                               *options.profile, failed.half_mode, *options.executor);
  return why;
}

std::vector<Cause> best_causes(std::vector<Cause> causes) {
  // A fault that explains some texels of many explains nothing; a wrong cause would be worse than none.
  std::erase_if(causes, [](const Cause& c) { return c.inside * 2 < c.of && c.explained * 4 < c.of; });
  if (causes.empty()) return causes;
  // Bits count twice: what gives them is also near. Within 2 % of the best, causes explain as much as each other.
  const auto score = [](const Cause& c) {
    return static_cast<double>(c.explained + c.inside) / static_cast<double>(std::max<std::int64_t>(c.of, 1));
  };
  double best = 0;
  for (const Cause& c : causes) best = std::max(best, score(c));
  // Records are few, and no device blurs which of them are there: of these the better explains more.
  const auto is_best = [&](const Cause& c) { return score(c) >= best - (c.of_records ? 0 : 0.04); };
  const auto rank = [&](const Cause& c) { return is_best(c) ? 2.0 : score(c); };
  std::stable_sort(causes.begin(), causes.end(), [&](const Cause& a, const Cause& b) { return rank(a) > rank(b); });
  std::vector<Cause> out;
  for (Cause& c : causes)
    if (out.size() < 3 && std::none_of(out.begin(), out.end(), [&](const Cause& o) { return o.name == c.name; })) out.push_back(c);
  // Likely is one cause at most: the first, of those that say so of themselves, where enough fails that it is no chance. Of what
  // makes a whole part of a pass vanish dozens of mistakes are the cause as well as the first: its failures cannot tell.
  constexpr std::ptrdiff_t most_rivals = 20;
  const auto rivals = std::count_if(causes.begin(), causes.end(), is_best);
  for (Cause& c : out) c.is_likely &= &c == &out.front() && (c.of_records || (c.of >= 4 && rivals <= most_rivals));
  return out;
}

}  // namespace rainref::faults
