#include "judge/envelopes.h"

#include <algorithm>

#include <fmt/format.h>

#include "judge/alternatives.h"
#include "judge/bits.h"
#include "judge/quantities.h"
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

bool better(const Failure& a, const Failure& b) {
  if (a.distance != b.distance) return a.distance > b.distance;
  if (a.y != b.y) return a.y < b.y;
  return a.x != b.x ? a.x < b.x : a.channel < b.channel;
}
void keep_worst(std::vector<Failure>& worst) {
  std::sort(worst.begin(), worst.end(), better);
  if (worst.size() > OutputJudgement::max_failures) worst.resize(OutputJudgement::max_failures);
}

/// Counts of some rows under one rounding.
struct Part {
  CaseJudgement counts;
  std::vector<Widths> widths;  // of each output
};

class CaseJudge {
 public:
  CaseJudge(const PassCase& c, const PassModel& model, const std::vector<Array>& port, const JudgeOptions& options,
            std::vector<HalfMode> modes)
      : case_(c), model_(model), port_(port), options_(options), modes_(std::move(modes)), slots_(slots_of(c)) {
    if (static_cast<int>(slots_.size()) != model.values())
      throw Error(ExitCode::internal,
                  fmt::format("{}: the model has {} values, the outputs {}", c.folder(), model.values(), slots_.size()));
  }

  std::vector<CaseJudgement> run() {
    constexpr int rows = 4;
    const int tiles = (model_.height() + rows - 1) / rows;
    std::vector<std::vector<Part>> parts(static_cast<std::size_t>(tiles), std::vector<Part>(modes_.size(), empty_part()));
    std::vector<CaseJudgement> whole(modes_.size(), empty_part().counts);
    for (CaseJudgement& j : whole)
      for (OutputJudgement& o : j.outputs)
        o.map.assign(o.records ? 0 : static_cast<std::size_t>(o.width) * static_cast<std::size_t>(o.height), 0);
    options_.executor->for_tiles(model_.width(), model_.height(), model_.width(), rows, [&](const parallel::Tile& tile) {
      Scratch scratch;
      for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) invocation(x, y, scratch, parts[static_cast<std::size_t>(tile.y0 / rows)], whole);
    });
    for (std::size_t m = 0; m < modes_.size(); ++m) {
      std::vector<Widths> widths(case_.outputs.size());
      for (std::vector<Part>& tile : parts) add(whole[m], tile[m], widths);
      for (std::size_t o = 0; o < widths.size(); ++o) widths[o].summarize(whole[m].outputs[o]);
    }
    return whole;
  }

 private:
  struct Scratch {
    Alternatives alternatives, typical;
    Stored stored;
    std::vector<CodeRange> ranges, nearest;
  };

  Part empty_part() const {
    Part p;
    p.counts.id = case_.folder();
    for (const capture::CaseOutput& out : case_.outputs) {
      OutputJudgement o;
      o.name = out.name;
      o.format = out.array.format;
      o.records = out.array.is_records;
      o.width = out.array.width;
      o.height = out.array.height;
      p.counts.outputs.push_back(o);
      p.widths.emplace_back();
    }
    return p;
  }

  void invocation(int x, int y, Scratch& s, std::vector<Part>& parts, std::vector<CaseJudgement>& whole) const {
    s.stored.read(slots_, case_, model_, *options_.profile, port_, x, y);
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
    if (s.alternatives.gave_up) return c;
    std::uint64_t nearest_distance = ~std::uint64_t{0};
    for (int a = 0; a < s.alternatives.count; ++a) {
      const std::vector<Enclosure>& values = s.alternatives.values[static_cast<std::size_t>(a)];
      ranges_of(s, a, mode);
      bool holds_reference = true;
      std::uint64_t far = 0;
      for (std::size_t v = 0; v < slots_.size(); ++v) {
        if (s.stored.free[v]) continue;
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
    counts.ambiguous += s.alternatives.count > 1 && !s.alternatives.gave_up;
    counts.gave_up += s.alternatives.gave_up;

    const Choice choice = choose(s, mode);
    const bool failed = s.stored.any_impossible || (!s.alternatives.gave_up && choice.accepted < 0);
    counts.failing += failed;
    counts.other_branch += !failed && choice.reference >= 0 && choice.accepted != choice.reference;
    const int shown = choice.accepted >= 0 ? choice.accepted : choice.nearest;
    if (shown >= 0) ranges_of(s, shown, mode);

    bool differs = false;
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
      if (s.alternatives.gave_up) {
        ++out.vacuous;
        ++out.loose;
        part.widths[static_cast<std::size_t>(slot.output)].add_unbounded(slot.channel);
      } else {
        const Enclosure& e = s.alternatives.values[static_cast<std::size_t>(shown)][v];
        const CodeRange& r = s.ranges[v];
        const double width = static_cast<double>(e.hi) - e.lo;
        // Of a value beyond the declared range (a lamp in a radiance) its own size counts.
        const double scale = std::max(slot.range, e.magnitude());
        const bool vacuous = r.is_vacuous() || width > scale / 16;
        out.vacuous += vacuous;
        out.loose += vacuous || width > scale / 256;
        part.widths[static_cast<std::size_t>(slot.output)].add(slot.channel, r, width, vacuous, width > scale / 256);
      }
      if (failed && (impossible || (!s.alternatives.gave_up && !holds(*options_.profile, s.stored, v, s.nearest[v]))))
        add_failure(x, y, v, s, part, whole);
    }
    if (!failed && differs && options_.typical && !s.alternatives.gave_up) check_typical(x, y, s, mode, counts, whole);
  }

  void add_failure(int x, int y, std::size_t v, const Scratch& s, Part& part, CaseJudgement& whole) const {
    const Slot& slot = slots_[v];
    const std::size_t o = static_cast<std::size_t>(slot.output);
    OutputJudgement& out = part.counts.outputs[o];
    ++out.failing;
    mark(whole, slot.output, x, y, 3);
    Failure f;
    f.x = x;
    f.y = y;
    f.channel = slot.channel;
    set_unequal(slot.kind, slot.at(case_.outputs[o].array, x, y), slot.at(port_[o], x, y), f);
    if (!options_.profile->reference) {
      f.low = f.high = 0;
      if (const auto range = free_range(model_, v, *options_.profile)) {
        const CodeRange free = enclosed::code_range(slot.kind, Enclosure(static_cast<float>((*range)[0]), static_cast<float>((*range)[1])),
                                                    rules_of(*options_.profile, HalfMode::rne, slot.store_rounding));
        f.low = free.lo;
        f.high = free.hi;
      } else if (!s.alternatives.gave_up) {
        f.low = s.nearest[v].lo;
        f.high = s.nearest[v].hi;
      }
      if (!f.not_a_number) f.distance = distance(f.got, {f.low, f.high});
    }
    part.widths[o].add_failing(slot.channel, value_distance(slot.kind, f));
    out.worst.push_back(f);
    if (out.worst.size() > 4 * OutputJudgement::max_failures) keep_worst(out.worst);
  }

  /// The codes of alternative a, into s.ranges.
  void ranges_of(Scratch& s, int a, HalfMode mode) const {
    if (!options_.profile->reference)
      return code_ranges(slots_, s.alternatives.values[static_cast<std::size_t>(a)], *options_.profile, mode, s.ranges);
    s.ranges.clear();
    for (const std::int64_t code : s.stored.expected) s.ranges.push_back({code, code});
  }

  void check_typical(int x, int y, Scratch& s, HalfMode mode, CaseJudgement& counts, CaseJudgement& whole) const {
    s.typical.run(model_, x, y, s.stored.got_values.data(), model_.rounds_inside() ? narrowed(*options_.typical, mode) : *options_.typical);
    if (s.typical.gave_up) return;
    int best = -1;
    std::size_t fewest = slots_.size() + 1;
    for (int a = 0; a < s.typical.count; ++a) {
      code_ranges(slots_, s.typical.values[static_cast<std::size_t>(a)], *options_.typical, mode, s.nearest);
      std::size_t outside = 0;
      for (std::size_t v = 0; v < slots_.size(); ++v) outside += !s.stored.free[v] && !s.nearest[v].contains(s.stored.got[v]);
      if (outside < fewest) {
        fewest = outside;
        best = a;
      }
    }
    if (fewest == 0) return;
    code_ranges(slots_, s.typical.values[static_cast<std::size_t>(best)], *options_.typical, mode, s.nearest);
    for (std::size_t v = 0; v < slots_.size(); ++v) {
      if (s.stored.free[v] || s.nearest[v].contains(s.stored.got[v])) continue;
      ++counts.outputs[static_cast<std::size_t>(slots_[v].output)].atypical;
      mark(whole, slots_[v].output, x, y, 2);
    }
  }

  static void add(CaseJudgement& whole, const Part& part, std::vector<Widths>& widths) {
    whole.invocations += part.counts.invocations;
    whole.failing += part.counts.failing;
    whole.ambiguous += part.counts.ambiguous;
    whole.other_branch += part.counts.other_branch;
    whole.gave_up += part.counts.gave_up;
    for (std::size_t o = 0; o < whole.outputs.size(); ++o) {
      OutputJudgement& to = whole.outputs[o];
      const OutputJudgement& from = part.counts.outputs[o];
      for (auto counter : {&OutputJudgement::elements, &OutputJudgement::failing, &OutputJudgement::differing, &OutputJudgement::vacuous,
                           &OutputJudgement::loose, &OutputJudgement::atypical, &OutputJudgement::free})
        to.*counter += from.*counter;
      to.worst.insert(to.worst.end(), from.worst.begin(), from.worst.end());
      keep_worst(to.worst);
      widths[o].append(part.widths[o]);
    }
  }

  const PassCase& case_;
  const PassModel& model_;
  const std::vector<Array>& port_;
  const JudgeOptions& options_;
  std::vector<HalfMode> modes_;
  std::vector<Slot> slots_;
};

}  // namespace

std::vector<CaseJudgement> judge_envelopes(const PassCase& c, const PassModel& model, const std::vector<Array>& port,
                                           const JudgeOptions& options, const std::vector<HalfMode>& modes) {
  return CaseJudge(c, model, port, options, modes).run();
}

}  // namespace rainref::judge
