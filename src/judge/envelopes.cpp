#include "judge/envelopes.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include <fmt/format.h>

#include "judge/alternatives.h"
#include "judge/beyond.h"
#include "judge/failures.h"
#include "judge/quantities.h"
#include "judge/sample.h"
#include "judge/second_tier.h"
#include "judge/short_cuts.h"
#include "judge/slots.h"
#include "judge/stored.h"
#include "judge/widths.h"
#include "rainref/error.h"

namespace rainref::judge {
namespace {

using capture::Array;
using capture::PassCase;
using capture::PassModel;
using enclosed::CodeRange;
using enclosed::Enclosure;

constexpr std::uint8_t beyond_mark = 4;  // of OutputJudgement::map, until the whole case is known

/// Counts of some rows under one rounding.
struct Part {
  CaseJudgement counts;
  std::vector<Widths> widths;                          // of each output
  std::vector<std::vector<std::uint32_t>> rearranged;  // widths of the sampled invocations
  // What fails only where there is much of it.
  struct Gross {
    std::vector<Failure> worst;
    Widths farthest;
  };
  std::vector<Gross> beyond;  // of each output
};

class CaseJudge {
 public:
  CaseJudge(const PassCase& c, const PassModel& model, const std::vector<Array>& port, const JudgeOptions& options,
            std::vector<HalfMode> modes)
      : case_(c),
        model_(model),
        port_(port),
        options_(options),
        modes_(std::move(modes)),
        slots_(slots_of(c, model)),
        // Exact rules compare bits, which is as quick.
        sample_(c, model, options.profile->reference ? 0 : options.sample),
        short_cuts_(c, model, port, options, slots_, modes_) {
    if (static_cast<int>(slots_.size()) != model.values())
      throw Error(ExitCode::internal,
                  fmt::format("{}: the model has {} values, the outputs {}", c.folder(), model.values(), slots_.size()));
    for (std::size_t v = 0; v < slots_.size(); ++v) free_.push_back(free_range(model, v, *options.profile).has_value());
  }

  std::vector<CaseJudgement> run() {
    short_cuts_.prepare(sample_);
    constexpr int rows = 4;
    const int tiles = (model_.height() + rows - 1) / rows;
    std::vector<std::vector<Part>> parts(static_cast<std::size_t>(tiles), std::vector<Part>(modes_.size(), empty_part()));
    std::vector<CaseJudgement> whole(modes_.size(), empty_part().counts);
    for (CaseJudgement& j : whole)
      for (OutputJudgement& o : j.outputs) o.map.assign(static_cast<std::size_t>(o.width) * static_cast<std::size_t>(o.height), 0);
    options_.executor->for_tiles(model_.width(), model_.height(), model_.width(), rows, [&](const parallel::Tile& tile) {
      Scratch scratch(short_cuts_, SecondTier(slots_, model_, *options_.profile),
                      SecondTier(slots_, model_, options_.typical ? *options_.typical : *options_.profile));
      if (options_.typical) scratch.coarse.emplace(slots_, model_, *options_.profile);
      for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) invocation(x, y, scratch, parts[static_cast<std::size_t>(tile.y0 / rows)], whole);
    });
    for (std::size_t m = 0; m < modes_.size(); ++m) {
      std::vector<Widths> widths(case_.outputs.size());
      std::vector<std::vector<std::uint32_t>> rearranged(case_.outputs.size());
      std::vector<Part::Gross> beyond(case_.outputs.size());
      for (std::vector<Part>& tile : parts) add(whole[m], tile[m], widths, rearranged, beyond);
      settle_beyond(whole[m], widths, beyond);
      for (std::size_t o = 0; o < widths.size(); ++o) {
        OutputJudgement& out = whole[m].outputs[o];
        widths[o].summarize(out);
        if (rearranged[o].empty()) continue;
        out.rearranged_median_width = quantile(rearranged[o], 0.5);
        out.rearranged_p99_width = quantile(rearranged[o], 0.99);
      }
      whole[m].with_bits = short_cuts_.counted(m);
      whole[m].stride = sample_.stride();
      whole[m].unbounded_margin = sample_.margin(static_cast<double>(std::count(free_.begin(), free_.end(), 0)));
    }
    return whole;
  }
  /// Whether what was asked leaves open if what is beyond every device is much: that is a share of all that the profile leaves open.
  bool needs_all() const { return needs_all_; }

 private:
  struct Scratch {
    Alternatives alternatives, others;
    Stored stored;
    std::vector<CodeRange> ranges, nearest, other_ranges;
    std::vector<char> vacuous;        ///< of each value
    bool is_open = false;             ///< some alternative leaves a value without a bound
    bool is_sampled = true;           ///< it counts in widths and shares
    SecondTier second, other_second;  ///< by the profile, and by what known devices do

    std::optional<Beyond> coarse;  ///< where devices are known
    ShortCuts::Work short_cut;

    Scratch(const ShortCuts& short_cuts, const SecondTier& tier, const SecondTier& other)
        : second(tier), other_second(other), short_cut(short_cuts) {}
  };

  Part empty_part() const {
    Part p;
    p.counts.id = case_.folder();
    for (const capture::CaseOutput& out : case_.outputs) {
      OutputJudgement o;
      o.name = out.name;
      o.format = out.array.format;
      o.records = out.array.is_records;
      o.counted = o.records ? Counted::fields : Counted::values;
      o.width = out.array.width;
      o.height = out.array.height;
      p.counts.outputs.push_back(o);
      p.widths.emplace_back();
      p.rearranged.emplace_back();
      p.beyond.emplace_back();
    }
    return p;
  }

  void invocation(int x, int y, Scratch& s, std::vector<Part>& parts, std::vector<CaseJudgement>& whole) const {
    s.is_sampled = sample_.has(x, y);
    if (!s.is_sampled && short_cuts_.lies_inside(x, y, s.stored, s.short_cut)) {
      for (std::size_t m = 0; m < modes_.size(); ++m) without_envelope(x, y, parts[m], whole[m], s.short_cut.is_held[m]);
      return;
    }
    if (s.is_sampled) s.stored.read(slots_, case_, model_, *options_.profile, port_, x, y);
    const bool is_exact = options_.profile->reference, each_rounds = model_.rounds_inside() && !is_exact;
    if (is_exact)
      s.alternatives.only(s.stored.expected_values);
    else if (!each_rounds)
      s.alternatives.run(model_, x, y, s.stored.got_values.data(), *options_.profile);
    for (std::size_t m = 0; m < modes_.size(); ++m) {
      if (each_rounds) s.alternatives.run(model_, x, y, s.stored.got_values.data(), narrowed(*options_.profile, modes_[m]));
      one_mode(x, y, s, modes_[m], parts[m], whole[m]);
    }
  }

  /// Counts one that no envelope is asked of.
  void without_envelope(int x, int y, Part& part, CaseJudgement& whole, bool is_decided) const {
    CaseJudgement& counts = part.counts;
    ++counts.invocations;
    counts.undecided += !is_decided;
    for (std::size_t v = 0; v < slots_.size(); ++v) {
      const Slot& slot = slots_[v];
      const auto o = static_cast<std::size_t>(slot.output);
      OutputJudgement& out = counts.outputs[o];
      ++out.elements;
      if (std::memcmp(slot.at(port_[o], x, y), slot.at(case_.outputs[o].array, x, y), static_cast<std::size_t>(slot.channel_bytes)) != 0) {
        ++out.differing;
        mark(whole, slot.output, x, y, 1);
      }
      if (free_[v]) {
        ++out.free;
        part.widths[o].add_free(slot.channel);
      } else {
        ++out.unsampled;
        part.widths[o].add_unsampled(slot.channel);
      }
    }
  }

  void mark(CaseJudgement& whole, int output, int x, int y, std::uint8_t what) const {
    OutputJudgement& o = whole.outputs[static_cast<std::size_t>(output)];
    std::uint8_t& texel = o.map[static_cast<std::size_t>(y) * static_cast<std::size_t>(o.width) + static_cast<std::size_t>(x)];
    texel = std::max(texel, what);
  }

  /// Numbers of alternatives, or -1. Sets s.nearest to the codes of the nearest.
  struct Choice {
    int accepted = -1;   ///< that accepts what was stored: the reference's if it does, else the first
    int reference = -1;  ///< that holds what the reference stores
    int nearest = -1;
  };
  Choice choose(Scratch& s, HalfMode mode) const {
    Choice c;
    s.is_open = s.alternatives.gave_up;
    if (s.alternatives.gave_up) return c;
    std::uint64_t nearest_distance = ~std::uint64_t{0};
    for (int a = 0; a < s.alternatives.count; ++a) {
      const std::vector<Enclosure>& values = s.alternatives.values[static_cast<std::size_t>(a)];
      ranges_of(s, a, mode);
      bool holds_reference = true;
      std::uint64_t far = 0;
      for (std::size_t v = 0; v < slots_.size(); ++v) {
        if (s.stored.free[v]) continue;
        s.is_open |= bound_of(slots_[v], values[v], s.ranges[v]).vacuous;
        far = std::max(far, distance(s.stored.got[v], s.ranges[v]));
        enclosed::StoreRules own = rules_of(*options_.profile, slots_[v].store_rounding == Rounding::rne ? HalfMode::rne : HalfMode::rtz,
                                            slots_[v].store_rounding);
        holds_reference &= enclosed::code_range(slots_[v].kind, values[v], own).contains(s.stored.expected[v]);
      }
      if (holds_reference && c.reference < 0) c.reference = a;
      if (inside(*options_.profile, s.ranges, s.stored) && (c.accepted < 0 || a == c.reference)) c.accepted = a;
      if (far < nearest_distance || c.nearest < 0) {
        c.nearest = a;
        nearest_distance = far;
        s.nearest = s.ranges;
      }
    }
    return c;
  }

  void one_mode(int x, int y, Scratch& s, HalfMode mode, Part& part, CaseJudgement& whole) const {
    CaseJudgement& counts = part.counts;
    const std::size_t n = slots_.size();
    ++counts.invocations;
    counts.ambiguous += s.is_sampled && s.alternatives.count > 1 && !s.alternatives.gave_up;
    counts.gave_up += s.is_sampled && s.alternatives.gave_up;

    const Choice choice = choose(s, mode);
    bool failed = s.stored.any_impossible || (!s.alternatives.gave_up && choice.accepted < 0);
    const bool is_rearranged = failed && !s.stored.any_impossible && s.second.exists() && only_rearranged(x, y, s, mode, counts);
    failed &= !is_rearranged;
    counts.failing += failed;
    counts.rearranged += is_rearranged;
    counts.other_branch += s.is_sampled && !failed && choice.reference >= 0 && choice.accepted >= 0 && choice.accepted != choice.reference;
    const int shown = choice.accepted >= 0 ? choice.accepted : choice.nearest;
    if (shown >= 0) ranges_of(s, shown, mode);

    bool differs = false, any_vacuous = false;
    s.vacuous.assign(n, 0);
    for (std::size_t v = 0; v < n; ++v) {
      const Slot& slot = slots_[v];
      OutputJudgement& out = counts.outputs[static_cast<std::size_t>(slot.output)];
      ++out.elements;
      const bool different = !s.stored.same[v], impossible = s.stored.impossible[v];
      out.differing += different;
      if (different) mark(whole, slot.output, x, y, 1);
      if (s.stored.free[v]) {
        ++out.free;
        part.widths[static_cast<std::size_t>(slot.output)].add_free(slot.channel);
        if (impossible) add_failure(x, y, v, s, part, whole);
        continue;
      }
      differs |= different;
      out.open += s.is_open;
      const Bound bound = count_bound(v, shown, s, part);
      s.vacuous[v] = bound.vacuous;
      any_vacuous |= bound.vacuous;
      if (impossible && failed) {
        add_failure(x, y, v, s, part, whole);
      } else if (!s.alternatives.gave_up && (failed || is_rearranged) && !holds(*options_.profile, s.stored, v, s.nearest[v])) {
        if (failed) {
          add_failure(x, y, v, s, part, whole);
        } else {
          ++out.rearranged;
          counts.rearranged_distance = std::max(counts.rearranged_distance, distance(s.stored.got[v], s.nearest[v]));
          mark(whole, slot.output, x, y, 2);
        }
      }
    }
    if (!failed && !is_rearranged && (differs || any_vacuous)) check_typical(x, y, s, mode, part, whole);
    if (s.is_sampled && s.second.exists() && (static_cast<std::int64_t>(y) * model_.width() + x) % 64 == 0)
      sample_rearranged(x, y, s, mode, part);
  }

  /// What a value is bounded by in the alternative that is shown; of a sampled one it is counted.
  Bound count_bound(std::size_t v, int shown, const Scratch& s, Part& part) const {
    const Slot& slot = slots_[v];
    const auto o = static_cast<std::size_t>(slot.output);
    OutputJudgement& out = part.counts.outputs[o];
    Bound bound{true, true};
    double width = 0;
    if (!s.alternatives.gave_up) {
      const Enclosure& e = s.alternatives.values[static_cast<std::size_t>(shown)][v];
      bound = bound_of(slot, e, s.ranges[v]);
      width = static_cast<double>(e.hi) - e.lo;
    }
    if (!s.is_sampled) {
      ++out.unsampled;
      part.widths[o].add_unsampled(slot.channel);
      return bound;
    }
    out.vacuous += bound.vacuous;
    out.loose += bound.loose;
    if (s.alternatives.gave_up)
      part.widths[o].add_unbounded(slot.channel);
    else
      part.widths[o].add(slot.channel, s.ranges[v], width, bound.vacuous, bound.loose);
    return bound;
  }

  /// The profile that an evaluation of one invocation takes.
  enclosed::Profile as_stored(const enclosed::Profile& profile, HalfMode mode) const {
    return model_.rounds_inside() ? narrowed(profile, mode) : profile;
  }

  /// Asked about an invocation that the formula as written does not hold.
  bool only_rearranged(int x, int y, Scratch& s, HalfMode mode, CaseJudgement& counts) const {
    const enclosed::Rearrangement own = options_.profile->rearrangement, most = enclosed::Rearrangement::expanded;
    if (s.second.accepts(own, x, y, s.stored, s.nearest, mode)) return true;
    if (own != most && s.second.is_near(s.stored, s.nearest, mode))
      counts.expanded += s.second.accepts(most, x, y, s.stored, s.nearest, mode);
    return false;
  }
  void sample_rearranged(int x, int y, Scratch& s, HalfMode mode, Part& part) const {
    const std::vector<CodeRange>* codes = s.second.codes(x, y, s.stored, mode);
    for (std::size_t v = 0; codes && v < slots_.size(); ++v)
      if (!s.stored.free[v]) part.rearranged[static_cast<std::size_t>(slots_[v].output)].push_back(width_of((*codes)[v]));
  }

  void add_failure(int x, int y, std::size_t v, const Scratch& s, Part& part, CaseJudgement& whole) const {
    const Slot& slot = slots_[v];
    const std::size_t o = static_cast<std::size_t>(slot.output);
    OutputJudgement& out = part.counts.outputs[o];
    ++out.failing;
    mark(whole, slot.output, x, y, 3);
    CodeRange accepted{0, 0};
    if (const auto range = free_range(model_, v, *options_.profile))
      accepted = enclosed::code_range(slot.kind, Enclosure(static_cast<float>((*range)[0]), static_cast<float>((*range)[1])),
                                      rules_of(*options_.profile, HalfMode::rne, slot.store_rounding));
    else if (!s.alternatives.gave_up)
      accepted = s.nearest[v];
    out.worst.push_back(failure(x, y, v, options_.profile->reference ? nullptr : &accepted));
    part.widths[o].add_failing(slot.channel, value_distance(slot.kind, out.worst.back()));
    if (out.worst.size() > 4 * OutputJudgement::max_failures) keep_worst(out.worst);
  }

  /// `accepted`: the codes that come nearest; null where there are none.
  Failure failure(int x, int y, std::size_t v, const CodeRange* accepted) const {
    const Slot& slot = slots_[v];
    const std::size_t o = static_cast<std::size_t>(slot.output);
    Failure f = failure_of(slot, x, y, case_.outputs[o].array, port_[o], accepted);
    if (!case_.outputs[o].array.is_records) return f;
    f.field = quantities_of(case_.outputs[o])[static_cast<std::size_t>(slot.channel)].name;
    f.field_kind = slot.kind;
    return f;
  }

  /// The codes of alternative a, into s.ranges.
  void ranges_of(Scratch& s, int a, HalfMode mode) const {
    if (!options_.profile->reference)
      return code_ranges(slots_, s.alternatives.values[static_cast<std::size_t>(a)], *options_.profile, mode, s.ranges);
    s.ranges.clear();
    for (const std::int64_t code : s.stored.expected) s.ranges.push_back({code, code});
  }

  /// What the profile leaves without a useful bound is held to what known devices do with the formula as written; what it bounds only warns
  /// by it, where they do not come to it by a rearrangement that the profile allows either.
  void check_typical(int x, int y, Scratch& s, HalfMode mode, Part& part, CaseJudgement& whole) const {
    CaseJudgement& counts = part.counts;
    int best = -1;
    bool is_rearranged = false, is_atypical = false;
    if (options_.typical) {
      s.others.run(model_, x, y, s.stored.got_values.data(), as_stored(*options_.typical, mode));
      std::size_t fewest = slots_.size() + 1;
      for (int a = 0; a < s.others.count && !s.others.gave_up; ++a) {
        code_ranges(slots_, s.others.values[static_cast<std::size_t>(a)], *options_.typical, mode, s.other_ranges);
        std::size_t outside = 0;
        for (std::size_t v = 0; v < slots_.size(); ++v) outside += !s.stored.free[v] && !s.other_ranges[v].contains(s.stored.got[v]);
        if (outside >= fewest) continue;
        fewest = outside;
        best = a;
      }
    }
    if (best >= 0) {
      code_ranges(slots_, s.others.values[static_cast<std::size_t>(best)], *options_.typical, mode, s.other_ranges);
      bool is_outside = false;
      for (std::size_t v = 0; v < slots_.size(); ++v)
        is_outside |= !s.stored.free[v] && !s.vacuous[v] && !s.other_ranges[v].contains(s.stored.got[v]);
      is_rearranged =
          is_outside && s.second.exists() && s.other_second.accepts(options_.profile->rearrangement, x, y, s.stored, s.other_ranges, mode);
    }
    for (std::size_t v = 0; v < slots_.size(); ++v) {
      if (s.stored.free[v]) continue;
      OutputJudgement& out = counts.outputs[static_cast<std::size_t>(slots_[v].output)];
      const bool is_bounded =
          best >= 0 && !bound_of(slots_[v], s.others.values[static_cast<std::size_t>(best)][v], s.other_ranges[v]).vacuous;
      if (best >= 0 && !s.other_ranges[v].contains(s.stored.got[v]) && (s.vacuous[v] || !is_rearranged)) {
        ++out.atypical;
        is_atypical = true;
        mark(whole, slots_[v].output, x, y, 2);
      } else if (s.vacuous[v] && s.is_sampled) {
        ++(is_bounded ? out.typical : out.unbounded);
      }
    }
    if (!is_atypical || !s.is_open || !s.coarse || !s.coarse->finds(x, y, s.stored, mode)) return;
    ++counts.beyond;
    for (std::size_t v = 0; v < slots_.size(); ++v) {
      if (!s.coarse->is_beyond(v)) continue;
      const std::size_t o = static_cast<std::size_t>(slots_[v].output);
      ++counts.outputs[o].beyond;
      mark(whole, slots_[v].output, x, y, beyond_mark);
      Part::Gross& to = part.beyond[o];
      to.worst.push_back(failure(x, y, v, &s.coarse->codes(v)));
      to.farthest.add_failing(slots_[v].channel, value_distance(slots_[v].kind, to.worst.back()));
      if (to.worst.size() > 4 * OutputJudgement::max_failures) keep_worst(to.worst);
    }
  }

  /// Lets what is beyond every device fail where there is much of it; else it stays a warning.
  void settle_beyond(CaseJudgement& j, std::vector<Widths>& widths, const std::vector<Part::Gross>& beyond) {
    std::int64_t count = 0, open = 0, most_open = 0;
    for (const OutputJudgement& o : j.outputs) count += o.beyond, open += o.open, most_open += o.elements - o.free;
    const bool fails = is_gross(count, open);
    needs_all_ |= !sample_.is_whole() && fails != is_gross(count, most_open);
    if (fails) {
      j.failing += j.beyond;
    } else {
      if (j.undecided > 0) j.undecided += j.beyond;
      j.beyond = 0;
    }
    for (std::size_t o = 0; o < j.outputs.size(); ++o) {
      OutputJudgement& out = j.outputs[o];
      for (std::uint8_t& texel : out.map)
        if (texel == beyond_mark) texel = fails ? 3 : 2;
      if (!fails) continue;
      out.failing += out.beyond;
      out.atypical = std::max<std::int64_t>(0, out.atypical - out.beyond);
      out.worst.insert(out.worst.end(), beyond[o].worst.begin(), beyond[o].worst.end());
      keep_worst(out.worst);
      widths[o].append(beyond[o].farthest);
    }
  }

  static void add(CaseJudgement& whole, const Part& part, std::vector<Widths>& widths, std::vector<std::vector<std::uint32_t>>& rearranged,
                  std::vector<Part::Gross>& beyond) {
    whole.invocations += part.counts.invocations;
    whole.failing += part.counts.failing;
    whole.ambiguous += part.counts.ambiguous;
    whole.other_branch += part.counts.other_branch;
    whole.gave_up += part.counts.gave_up;
    whole.rearranged += part.counts.rearranged;
    whole.rearranged_distance = std::max(whole.rearranged_distance, part.counts.rearranged_distance);
    whole.expanded += part.counts.expanded;
    whole.beyond += part.counts.beyond;
    whole.undecided += part.counts.undecided;
    for (std::size_t o = 0; o < whole.outputs.size(); ++o) {
      OutputJudgement& to = whole.outputs[o];
      const OutputJudgement& from = part.counts.outputs[o];
      for (auto counter : {&OutputJudgement::elements, &OutputJudgement::failing, &OutputJudgement::differing, &OutputJudgement::vacuous,
                           &OutputJudgement::loose, &OutputJudgement::atypical, &OutputJudgement::typical, &OutputJudgement::unbounded,
                           &OutputJudgement::rearranged, &OutputJudgement::free, &OutputJudgement::open, &OutputJudgement::beyond,
                           &OutputJudgement::unsampled})
        to.*counter += from.*counter;
      to.worst.insert(to.worst.end(), from.worst.begin(), from.worst.end());
      keep_worst(to.worst);
      widths[o].append(part.widths[o]);
      rearranged[o].insert(rearranged[o].end(), part.rearranged[o].begin(), part.rearranged[o].end());
      beyond[o].worst.insert(beyond[o].worst.end(), part.beyond[o].worst.begin(), part.beyond[o].worst.end());
      keep_worst(beyond[o].worst);
      beyond[o].farthest.append(part.beyond[o].farthest);
    }
  }

  const PassCase& case_;
  const PassModel& model_;
  const std::vector<Array>& port_;
  const JudgeOptions& options_;
  std::vector<HalfMode> modes_;
  std::vector<Slot> slots_;
  std::vector<char> free_;  // of each slot, as Stored::free
  Sample sample_;
  ShortCuts short_cuts_;
  bool needs_all_ = false;
};

}  // namespace

std::vector<CaseJudgement> judge_envelopes(const PassCase& c, const PassModel& model, const std::vector<Array>& port,
                                           const JudgeOptions& options, const std::vector<HalfMode>& modes) {
  CaseJudge judge(c, model, port, options, modes);
  std::vector<CaseJudgement> judged = judge.run();
  if (!judge.needs_all()) return judged;
  JudgeOptions all = options;
  all.sample = 0;
  return CaseJudge(c, model, port, all, modes).run();
}

}  // namespace rainref::judge
