#include "judge/envelopes.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "judge/alternatives.h"
#include "judge/beyond.h"
#include "judge/failures.h"
#include "judge/part.h"
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
        // Under exact rules bits are compared, which is as fast.
        sample_(c, model, options.profile->reference ? 0 : options.sample),
        short_cuts_(c, model, port, options, slots_, modes_) {
    if (static_cast<int>(slots_.size()) != model.values())
      throw Error(ExitCode::internal,
                  fmt::format("{}: the model has {} values, the outputs {}", c.folder(), model.values(), slots_.size()));
    for (std::size_t v = 0; v < slots_.size(); ++v) free_.push_back(free_range(model, v, *options.profile).has_value());
  }

  std::vector<CaseJudgement> run() {
    short_cuts_.find_rounding(sample_);
    std::vector<CaseJudgement> whole(modes_.size(), Part(case_).counts);
    for (CaseJudgement& j : whole)
      for (OutputJudgement& o : j.outputs) o.map.assign(static_cast<std::size_t>(o.width) * static_cast<std::size_t>(o.height), 0);
    std::vector<std::vector<Part>> parts;
    if (!sample_.is_whole()) judge_sample(parts, whole);
    const bool is_enough = fails_enough(parts);
    if (is_enough) {
      leave_rest(whole);
    } else {
      short_cuts_.prepare(sample_);
      judge_rest(parts, whole);
    }
    for (std::size_t m = 0; m < modes_.size(); ++m) {
      Part sum(case_);
      for (std::size_t o = 0; o < sum.counts.outputs.size(); ++o) sum.counts.outputs[o].map = std::move(whole[m].outputs[o].map);
      for (const std::vector<Part>& part : parts) sum.add(part[m]);
      needs_all_ |= !sample_.is_whole() && !is_enough && sum.may_be_gross() != sum.is_gross();
      sum.settle_beyond();
      sum.summarize();
      whole[m] = std::move(sum.counts);
      whole[m].is_of_sample = is_enough;
      whole[m].with_bits = short_cuts_.counted(m);
      whole[m].stride = sample_.stride();
      whole[m].unbounded_margin = sample_.margin(static_cast<double>(std::count(free_.begin(), free_.end(), 0)));
    }
    return whole;
  }
  /// True if the sample leaves open whether a large share of the elements that the profile leaves open is beyond every device.
  bool needs_all() const { return needs_all_; }

 private:
  struct Scratch {
    Alternatives alternatives, others;
    Stored stored;
    std::vector<CodeRange> ranges, nearest, other_ranges;
    std::vector<char> vacuous;        ///< of each value
    bool is_open = false;             ///< some alternative leaves a value without a bound
    bool is_sampled = true;           ///< counts in widths and shares
    SecondTier second, other_second;  ///< under the profile, and under what known devices do

    std::optional<Beyond> coarse;  ///< if there is a profile of known devices
    ShortCuts::Work short_cut;

    explicit Scratch(const CaseJudge& of)
        : second(of.slots_, of.model_, *of.options_.profile),
          other_second(of.slots_, of.model_, of.options_.typical ? *of.options_.typical : *of.options_.profile),
          short_cut(of.short_cuts_) {
      if (of.options_.typical) coarse.emplace(of.slots_, of.model_, *of.options_.profile);
    }
  };

  /// Judges the sampled invocations in blocks.
  void judge_sample(std::vector<std::vector<Part>>& parts, std::vector<CaseJudgement>& whole) const {
    constexpr std::int64_t strata = 64;
    parts.assign(static_cast<std::size_t>((sample_.size() + strata - 1) / strata), std::vector<Part>(modes_.size(), Part(case_)));
    options_.executor->for_range(static_cast<std::int64_t>(parts.size()), 1, [&](std::int64_t begin, std::int64_t end) {
      Scratch s(*this);
      for (std::int64_t k = begin; k < end; ++k)
        sample_.each_of(k * strata, std::min((k + 1) * strata, sample_.size()),
                        [&](int x, int y) { invocation(x, y, true, s, parts[static_cast<std::size_t>(k)], whole); });
    });
  }
  /// The number of invocations of a row that are compared at once. More would find fewer pieces without a difference.
  static constexpr int together = 64;
  /// Judges the invocations outside the sample; all, if the sample is complete.
  void judge_rest(std::vector<std::vector<Part>>& parts, std::vector<CaseJudgement>& whole) const {
    constexpr int rows = 4;
    const std::size_t before = parts.size();
    parts.resize(before + static_cast<std::size_t>((model_.height() + rows - 1) / rows), std::vector<Part>(modes_.size(), Part(case_)));
    options_.executor->for_tiles(model_.width(), model_.height(), model_.width(), rows, [&](const parallel::Tile& tile) {
      Scratch s(*this);
      std::vector<Part>& part = parts[before + static_cast<std::size_t>(tile.y0 / rows)];
      const std::int64_t width = model_.width();
      for (int y = tile.y0; sample_.is_whole() && y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) invocation(x, y, true, s, part, whole);
      sample_.each_left_out(tile.y0 * width, tile.y1 * width, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t at = begin; at < end;) {
          const auto x = static_cast<int>(at % width), y = static_cast<int>(at / width);
          const auto count = static_cast<int>(std::min({end - at, width - x, std::int64_t{together}}));
          beside_sample(x, y, count, s, part, whole);
          at += count;
        }
      });
    });
  }
  /// Judges some invocations of a row. If all of them have the reference's bits, as in most ports, it only counts them.
  void beside_sample(int x, int y, int count, Scratch& s, std::vector<Part>& parts, std::vector<CaseJudgement>& whole) const {
    if (!short_cuts_.lie_inside(x, y, count, s.short_cut)) {
      for (int k = 0; k < count; ++k) invocation(x + k, y, false, s, parts, whole);
      return;
    }
    for (std::size_t m = 0; m < modes_.size(); ++m) {
      CaseJudgement& counts = parts[m].counts;
      counts.invocations += count;
      counts.undecided += s.short_cut.is_held[m] ? 0 : count;
      for (std::size_t v = 0; v < slots_.size(); ++v) {
        counts.outputs[static_cast<std::size_t>(slots_[v].output)].elements += count;
        add_unasked(v, count, parts[m]);
      }
    }
  }
  /// True if the sample has so many failures under each rounding that the rest cannot change the verdict.
  bool fails_enough(const std::vector<std::vector<Part>>& sampled) const {
    for (std::size_t m = 0; m < modes_.size(); ++m) {
      std::int64_t failing = 0;
      for (const std::vector<Part>& part : sampled) failing += part[m].counts.failing;
      if (failing < enough_failing) return false;
    }
    return true;
  }
  /// Marks the invocations outside the sample.
  void leave_rest(std::vector<CaseJudgement>& whole) const {
    std::set<int> outputs;
    for (const Slot& slot : slots_) outputs.insert(slot.output);
    for (int y = 0; y < model_.height(); ++y)
      for (int x = 0; x < model_.width(); ++x)
        for (std::size_t k = 0; !sample_.has(x, y) && k < whole.size(); ++k)
          for (const int o : outputs) mark(whole[k], o, x, y, OutputJudgement::not_judged);
  }

  void invocation(int x, int y, bool is_sampled, Scratch& s, std::vector<Part>& parts, std::vector<CaseJudgement>& whole) const {
    s.is_sampled = is_sampled;
    if (!s.is_sampled && short_cuts_.lies_inside(x, y, s.stored, s.short_cut)) {
      for (std::size_t m = 0; m < modes_.size(); ++m) without_envelope(x, y, parts[m], whole[m], s.short_cut.is_held[m]);
      return;
    }
    if (s.is_sampled) s.stored.read(slots_, case_, model_, *options_.profile, port_, x, y, options_.kept);
    const bool is_exact = options_.profile->reference, each_rounds = model_.rounds_inside() && !is_exact;
    if (is_exact)
      s.alternatives.only(s.stored);
    else if (!each_rounds)
      s.alternatives.run(model_, x, y, s.stored, *options_.profile);
    for (std::size_t m = 0; m < modes_.size(); ++m) {
      if (each_rounds) s.alternatives.run(model_, x, y, s.stored, narrowed(*options_.profile, modes_[m]));
      one_mode(x, y, s, modes_[m], parts[m], whole[m]);
    }
  }

  /// Counts an invocation whose envelope is not computed.
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
      add_unasked(v, 1, part);
    }
  }
  /// Counts so many values that no bound is asked of.
  void add_unasked(std::size_t v, std::int64_t count, Part& part) const {
    const auto o = static_cast<std::size_t>(slots_[v].output);
    OutputJudgement& out = part.counts.outputs[o];
    if (free_[v]) {
      out.free += count;
      part.widths[o].add_free(slots_[v].channel, count);
    } else {
      out.unsampled += count;
      part.widths[o].add_unsampled(slots_[v].channel, count);
    }
  }

  void mark(CaseJudgement& whole, int output, int x, int y, std::uint8_t what) const {
    OutputJudgement& o = whole.outputs[static_cast<std::size_t>(output)];
    std::uint8_t& texel = o.map[static_cast<std::size_t>(y) * static_cast<std::size_t>(o.width) + static_cast<std::size_t>(x)];
    texel = std::max(texel, what);
  }

  /// Indices of alternatives, or -1. Sets s.nearest to the codes of the nearest.
  struct Choice {
    int accepted = -1;   ///< accepts the stored values: the reference's alternative if it does, else the first
    int reference = -1;  ///< contains the reference's values
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

  /// Returns the bound of a value in alternative `shown`; counts it if the invocation is sampled.
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

  /// The profile for evaluating one invocation.
  enclosed::Profile as_stored(const enclosed::Profile& profile, HalfMode mode) const {
    return model_.rounds_inside() ? narrowed(profile, mode) : profile;
  }

  /// Called for an invocation that the formula as written does not accept.
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

  /// `accepted`: the nearest codes; null if there are none.
  Failure failure(int x, int y, std::size_t v, const CodeRange* accepted) const {
    const Slot& slot = slots_[v];
    const std::size_t o = static_cast<std::size_t>(slot.output);
    Failure f = failure_of(slot, x, y, case_.outputs[o].array, port_[o], accepted);
    if (!case_.outputs[o].array.is_records) return f;
    f.field = quantities_of(case_.outputs[o])[static_cast<std::size_t>(slot.channel)].name;
    f.field_kind = slot.kind;
    return f;
  }

  /// Writes the codes of alternative a to s.ranges.
  void ranges_of(Scratch& s, int a, HalfMode mode) const {
    if (!options_.profile->reference)
      return code_ranges(slots_, s.alternatives.values[static_cast<std::size_t>(a)], *options_.profile, mode, s.ranges);
    code_ranges(slots_, s.alternatives.values[static_cast<std::size_t>(a)], *options_.profile, mode, s.ranges);
    for (std::size_t v = 0; v < slots_.size(); ++v)
      if (s.stored.is_known(v)) s.ranges[v] = {s.stored.expected[v], s.stored.expected[v]};
  }

  /// Compares with what known devices do. Values without a useful bound in the profile must lie inside that, with the formula as written.
  /// Other values outside it only give a warning, unless an allowed rearrangement reaches them.
  void check_typical(int x, int y, Scratch& s, HalfMode mode, Part& part, CaseJudgement& whole) const {
    CaseJudgement& counts = part.counts;
    int best = -1;
    bool is_rearranged = false, is_atypical = false;
    if (options_.typical) {
      s.others.run(model_, x, y, s.stored, as_stored(*options_.typical, mode));
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
      mark(whole, slots_[v].output, x, y, Part::beyond_mark);
      Part::Gross& to = part.beyond[o];
      to.worst.push_back(failure(x, y, v, &s.coarse->codes(v)));
      to.farthest.add_failing(slots_[v].channel, value_distance(slots_[v].kind, to.worst.back()));
      if (to.worst.size() > 4 * OutputJudgement::max_failures) keep_worst(to.worst);
    }
  }

  const PassCase& case_;
  const PassModel& model_;
  const std::vector<Array>& port_;
  const JudgeOptions& options_;
  std::vector<HalfMode> modes_;
  std::vector<Slot> slots_;
  std::vector<char> free_;  // for each slot, as Stored::free
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
