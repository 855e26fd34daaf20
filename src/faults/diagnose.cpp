#include "faults/diagnose.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "faults/deviations.h"
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

std::vector<Texel> failing_texels(const CaseJudgement& j) {
  std::vector<Texel> all;
  for (const OutputJudgement& o : j.outputs)
    for (std::size_t i = 0; i < o.map.size(); ++i)
      if (o.map[i] == 3) all.push_back({static_cast<int>(i) % o.width, static_cast<int>(i) / o.width});
  std::sort(all.begin(), all.end(), [](Texel a, Texel b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  all.erase(std::unique(all.begin(), all.end(), [](Texel a, Texel b) { return a.x == b.x && a.y == b.y; }), all.end());
  return all;
}
/// At most so many, spread evenly.
std::vector<Texel> spread(const std::vector<Texel>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<Texel> some;
  for (std::size_t k = 0; k < most; ++k) some.push_back(all[k * all.size() / most]);
  return some;
}
/// Texels where the port stored the reference's bits.
std::vector<Texel> equal_texels(const std::vector<Slot>& slots, const capture::PassModel& model, const std::vector<Array>& port,
                                const std::vector<Array>& reference) {
  std::vector<Texel> out;
  for (int y = 0; y < model.height(); ++y)
    for (int x = 0; x < model.width(); ++x) {
      const bool same = std::all_of(slots.begin(), slots.end(), [&](const Slot& s) {
        const std::size_t o = static_cast<std::size_t>(s.output);
        return std::memcmp(s.at(port[o], x, y), s.at(reference[o], x, y), static_cast<std::size_t>(s.channel_bytes)) == 0;
      });
      if (same) out.push_back({x, y});
    }
  return out;
}

/// How a deviation's texel compares with the port's.
struct Match {
  bool exact = false;  ///< the same bits
  bool near = false;   ///< as near as a device's own differences, and much nearer than the reference
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
    out.codes.push_back(1 + (found == j.outputs.end() ? 0 : static_cast<std::int64_t>(found->p99_width)));
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
Match compare(const std::vector<Slot>& slots, const capture::PassModel& model, const std::vector<Array>& deviated,
              const std::vector<Array>& port, const std::vector<Array>& reference, const Leeway& leeway, const std::vector<Texel>& texels,
              std::size_t k) {
  Match m{true, true};
  bool nearer = false;
  for (std::size_t v = 0; v < slots.size(); ++v) {
    if (model.is_free(static_cast<int>(v))) continue;
    const Slot& s = slots[v];
    const std::size_t o = static_cast<std::size_t>(s.output);
    const std::byte *got = s.at(port[o], texels[k].x, texels[k].y), *guess = s.at(deviated[o], texels[k].x, texels[k].y),
                    *base = s.at(reference[o], texels[k].x, texels[k].y);
    const auto code = [&](const std::byte* at) { return enclosed::ordered_code(s.kind, at); };
    const std::int64_t far = gap(code(got), code(guess)), before = gap(code(got), code(base));
    const double off = std::abs(static_cast<double>(stored_value(s, got)) - stored_value(s, guess));
    m.exact &= far == 0;
    m.near &= far <= leeway.codes[v] || off <= leeway.values[k][v];
    nearer |= far < before && 4 * far <= before;
  }
  m.exact &= nearer;  // else the reference gives the same bits, and the deviation explains nothing
  m.near &= nearer;
  return m;
}

/// Share of the texels where the port has the reference's bits and the deviation would store clearly other ones.
double contradicted(const std::vector<Slot>& slots, const DeviatedPass& deviated, const std::vector<Array>& reference, const Leeway& leeway,
                    const std::vector<Texel>& equal) {
  std::vector<Array> stored = reference;
  std::int64_t against = 0;
  for (const Texel t : equal) {
    deviated.store(t, stored);
    against += std::any_of(slots.begin(), slots.end(), [&](const Slot& s) {
      const std::size_t o = static_cast<std::size_t>(s.output), v = static_cast<std::size_t>(&s - slots.data());
      const auto code = [&](const std::vector<Array>& a) { return enclosed::ordered_code(s.kind, s.at(a[o], t.x, t.y)); };
      return gap(code(stored), code(reference)) > 2 * leeway.codes[v];
    });
  }
  return equal.empty() ? 0 : static_cast<double>(against) / static_cast<double>(equal.size());
}

}  // namespace

std::vector<Cause> diagnose_texels(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before, Bind bind,
                                   const capture::PassModel& model, const std::vector<Array>& port, const CaseJudgement& judgement,
                                   const enclosed::Profile& profile, HalfMode mode, const parallel::Executor& executor) {
  const std::vector<Texel> all_failing = failing_texels(judgement), failing = spread(all_failing, 400);
  if (failing.empty()) return {};
  const std::vector<Slot> slots = slots_of(c);
  const std::vector<Deviation> all = deviations_of(pass, c, model, before);
  const std::vector<Array> reference = reference_outputs(c, model, executor, mode);
  const Leeway leeway = leeway_of(slots, c, model, reference, judgement, profile, failing);
  const std::vector<Texel> equal = equal_texels(slots, model, port, reference), few_equal = spread(equal, 400),
                           many_equal = spread(equal, 20000);
  const double equal_per_failing = static_cast<double>(equal.size()) / static_cast<double>(all_failing.size());
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
        for (std::size_t t = 0; t < failing.size(); ++t) {
          deviated.store(failing[t], stored);
          const Match m = compare(slots, model, stored, port, reference, leeway, failing, t);
          cause.explained += m.exact;
          cause.inside += m.near;
        }
        // In a buffer that is nearly empty a mirror image, too, has zero wherever the port lost something. A cause must not
        // break about as many texels as it explains.
        const double broken =
            contradicted(slots, deviated, reference, leeway, d.is_evaluated() ? few_equal : many_equal) * equal_per_failing;
        if (broken * 4 > 1) cause.explained = cause.inside = 0;
      } catch (const Error&) {
        cause.explained = cause.inside = 0;  // the altered case is none that the pass can run
      }
    }
  });
  return best_causes(std::move(causes));
}

std::vector<Cause> diagnose(const judge::FailedRun& failed) {
  const capture::PassCase& c = failed.run.c;
  const judge::JudgeOptions& options = failed.options;
  if (!keyed_outputs(c).empty()) {
    std::vector<Cause> causes =
        diagnose_lists(failed.pass, c, failed.before, failed.model, failed.run.stored, *options.profile, *options.executor);
    if (!causes.empty() || !failed.bind || !is_enveloped(c)) return causes;
  }
  return diagnose_texels(failed.pass, c, failed.before, failed.bind, *failed.model, failed.run.stored, failed.judgement, *options.profile,
                         failed.half_mode, *options.executor);
}

std::vector<Cause> best_causes(std::vector<Cause> causes) {
  // A deviation that explains some texels of many explains nothing; a wrong cause would be worse than none.
  std::erase_if(causes, [](const Cause& c) { return c.inside * 2 < c.of && c.explained * 4 < c.of; });
  std::stable_sort(causes.begin(), causes.end(),
                   [](const Cause& a, const Cause& b) { return a.inside != b.inside ? a.inside > b.inside : a.explained > b.explained; });
  if (causes.size() > 3) causes.resize(3);
  return causes;
}

}  // namespace rainref::faults
