#include "judge/judge.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/format.h>

#include "judge/bits.h"
#include "judge/conclude.h"
#include "judge/keyed.h"
#include "judge/slots.h"
#include "judge/widths.h"
#include "math/path_enumeration.h"
#include "rainref/error.h"

namespace rainref::judge {
namespace {

using capture::Array;
using capture::PassCase;
using capture::PassModel;
using enclosed::CodeRange;
using enclosed::Enclosure;

enclosed::StoreRules rules_of(const enclosed::Profile& profile, HalfMode mode, Rounding unorm) {
  enclosed::StoreRules rules = enclosed::store_rules(profile, unorm);
  rules.half = mode == HalfMode::rne   ? enclosed::StoreRounding::rne
               : mode == HalfMode::rtz ? enclosed::StoreRounding::rtz
                                       : enclosed::StoreRounding::either;
  // What a profile says of overflow goes with the rounding that it asks for.
  if (profile.half_store != enclosed::StoreRounding::either && profile.half_store != rules.half && !profile.reference)
    rules.half_overflow = enclosed::StoreOverflow::either;
  return rules;
}
/// The profile of a device whose stores round like this.
enclosed::Profile narrowed(const enclosed::Profile& profile, HalfMode mode) {
  enclosed::Profile out = profile;
  const enclosed::StoreRules rules = rules_of(profile, mode, Rounding::rne);
  out.half_store = rules.half;
  out.half_overflow = rules.half_overflow;
  return out;
}

/// Every alternative of an invocation.
struct Alternatives {
  std::array<std::vector<Enclosure>, enclosed::PathEnumeration::max_runs> values;
  int count = 0;
  bool gave_up = false;

  /// What the reference stored, and nothing else.
  void only(const std::vector<float>& expected) {
    count = 1;
    gave_up = false;
    values.front().clear();
    for (const float x : expected) values.front().emplace_back(x, x);
  }
  void run(const PassModel& model, int x, int y, const float* port, const enclosed::Profile& profile) {
    const enclosed::ProfileScope scope(profile);
    enclosed::PathEnumeration paths;
    count = 0;
    gave_up = !paths.for_each_alternative([&] {
      std::vector<Enclosure>& out = values[static_cast<std::size_t>(count++)];
      out.assign(static_cast<std::size_t>(model.values()), Enclosure());
      model.enclose(x, y, port, out.data());
    });
  }
};

/// Under exact rules a march has one number of steps, too.
std::optional<std::array<double, 2>> free_range(const PassModel& model, std::size_t value, const enclosed::Profile& profile) {
  return profile.reference ? std::nullopt : model.free_range(static_cast<int>(value));
}

/// What an invocation stored, and what the reference does.
struct Stored {
  std::vector<std::int64_t> got, expected;
  std::vector<float> got_values, expected_values;
  std::vector<char> same;        ///< the reference's bits: -0 is not +0
  std::vector<char> free;        ///< declared as not reproducible
  std::vector<char> impossible;  ///< not a number, or free and outside what it may be
  bool any_impossible = false;

  void read(const std::vector<Slot>& slots, const PassCase& c, const PassModel& model, const enclosed::Profile& profile,
            const std::vector<Array>& port, int x, int y) {
    const std::size_t n = slots.size();
    got.resize(n);
    expected.resize(n);
    got_values.resize(n);
    expected_values.resize(n);
    same.resize(n);
    free.resize(n);
    impossible.resize(n);
    any_impossible = false;
    for (std::size_t v = 0; v < n; ++v) {
      const Slot& s = slots[v];
      const std::size_t o = static_cast<std::size_t>(s.output);
      const std::byte *have = s.at(port[o], x, y), *want = s.at(c.outputs[o].array, x, y);
      got[v] = enclosed::ordered_code(s.kind, have);
      expected[v] = enclosed::ordered_code(s.kind, want);
      got_values[v] = stored_value(s, have);
      expected_values[v] = stored_value(s, want);
      same[v] = std::memcmp(have, want, static_cast<std::size_t>(s.channel_bytes)) == 0;
      const auto range = free_range(model, v, profile);
      free[v] = range.has_value();
      impossible[v] = is_nan(s.kind, have) || (range && !(got_values[v] >= (*range)[0] && got_values[v] <= (*range)[1]));
      any_impossible |= impossible[v] != 0;
    }
  }
};

std::uint64_t distance(std::int64_t code, const CodeRange& r) {
  if (r.contains(code)) return 0;
  return code < r.lo ? static_cast<std::uint64_t>(r.lo) - static_cast<std::uint64_t>(code)
                     : static_cast<std::uint64_t>(code) - static_cast<std::uint64_t>(r.hi);
}

/// The codes of one alternative under one rounding.
void code_ranges(const std::vector<Slot>& slots, const std::vector<Enclosure>& values, const enclosed::Profile& profile, HalfMode mode,
                 std::vector<CodeRange>& out) {
  out.resize(slots.size());
  for (std::size_t v = 0; v < slots.size(); ++v)
    out[v] = enclosed::code_range(slots[v].kind, values[v], rules_of(profile, mode, slots[v].store_rounding));
}

/// Whether an alternative of these codes holds a value: exact rules compare bits.
bool holds(const enclosed::Profile& profile, const Stored& stored, std::size_t v, const CodeRange& range) {
  if (profile.reference) return stored.same[v];
  return stored.free[v] ? !stored.impossible[v] : range.contains(stored.got[v]);
}
bool inside(const enclosed::Profile& profile, const std::vector<CodeRange>& ranges, const Stored& stored) {
  for (std::size_t v = 0; v < ranges.size(); ++v)
    if (!holds(profile, stored, v, ranges[v])) return false;
  return true;
}

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

  void one_mode(int x, int y, Scratch& s, HalfMode mode, Part& part, CaseJudgement& whole) const {
    CaseJudgement& counts = part.counts;
    const std::size_t n = slots_.size();
    ++counts.invocations;
    counts.ambiguous += s.alternatives.count > 1 && !s.alternatives.gave_up;
    counts.gave_up += s.alternatives.gave_up;

    // The alternative that accepts what was stored: the reference's if it does, else the first; or the nearest.
    int accepted = -1, reference = -1, nearest = -1;
    std::uint64_t nearest_distance = ~std::uint64_t{0};
    if (!s.alternatives.gave_up) {
      for (int a = 0; a < s.alternatives.count; ++a) {
        const std::vector<Enclosure>& values = s.alternatives.values[static_cast<std::size_t>(a)];
        ranges_of(s, a, mode);
        bool holds_reference = true;
        std::uint64_t far = 0;
        for (std::size_t v = 0; v < n; ++v) {
          if (s.stored.free[v]) continue;
          far = std::max(far, distance(s.stored.got[v], s.ranges[v]));
          enclosed::StoreRules own = rules_of(*options_.profile, slots_[v].store_rounding == Rounding::rne ? HalfMode::rne : HalfMode::rtz,
                                              slots_[v].store_rounding);
          holds_reference &= enclosed::code_range(slots_[v].kind, values[v], own).contains(s.stored.expected[v]);
        }
        if (holds_reference && reference < 0) reference = a;
        if (inside(*options_.profile, s.ranges, s.stored) && (accepted < 0 || a == reference)) accepted = a;
        if (far < nearest_distance || nearest < 0) {
          nearest = a;
          nearest_distance = far;
          s.nearest = s.ranges;
        }
      }
    }
    const bool failed = s.stored.any_impossible || (!s.alternatives.gave_up && accepted < 0);
    counts.failing += failed;
    counts.other_branch += !failed && reference >= 0 && accepted != reference;
    const int shown = accepted >= 0 ? accepted : nearest;
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
        if (impossible) add_failure(x, y, v, s, part, whole);
        continue;
      }
      differs |= different;
      if (s.alternatives.gave_up) {
        ++out.vacuous;
        ++out.loose;
      } else {
        const Enclosure& e = s.alternatives.values[static_cast<std::size_t>(shown)][v];
        const CodeRange& r = s.ranges[v];
        const double width = static_cast<double>(e.hi) - e.lo;
        // Of a value beyond the declared range (a lamp in a radiance) its own size counts.
        const double scale = std::max(slot.range, e.magnitude());
        const bool vacuous = r.is_vacuous() || width > scale / 16;
        out.vacuous += vacuous;
        out.loose += vacuous || width > scale / 256;
        part.widths[static_cast<std::size_t>(slot.output)].add(r);
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

HalfMode half_mode_of(const enclosed::Profile& profile) {
  return profile.half_store == enclosed::StoreRounding::rne   ? HalfMode::rne
         : profile.half_store == enclosed::StoreRounding::rtz ? HalfMode::rtz
                                                              : HalfMode::either;
}

ModeJudgements judge_case(const PassCase& c, const PassModel* model, const std::vector<Array>& port, const JudgeOptions& options) {
  ModeJudgements result;
  const bool has_half = std::any_of(c.outputs.begin(), c.outputs.end(), [](const capture::CaseOutput& o) {
    return o.judge == capture::Judge::envelope && !o.array.is_records && info(o.array.format).kind == FormatInfo::float16;
  });
  const HalfMode declared = half_mode_of(*options.profile);
  if (options.profile->reference || !has_half)
    result.modes = {declared == HalfMode::either ? HalfMode::rne : declared};
  else if (declared != HalfMode::either && options.half_mode == declared)
    result.modes = {declared};
  else if (declared != HalfMode::either)
    result.modes = {declared, declared == HalfMode::rne ? HalfMode::rtz : HalfMode::rne};
  else if (options.half_mode)
    result.modes = {*options.half_mode};
  else
    result.modes = {HalfMode::rne, HalfMode::rtz, HalfMode::either};

  const bool enveloped = !slots_of(c).empty();
  if (enveloped && !model) throw Error(ExitCode::internal, fmt::format("{}: no evaluation of this pass", c.pass));
  if (enveloped)
    result.judgements = CaseJudge(c, *model, port, options, result.modes).run();
  else
    result.judgements.assign(result.modes.size(), CaseJudgement{});
  for (CaseJudgement& j : result.judgements) {
    j.id = c.folder();
    std::vector<OutputJudgement> outputs;  // each judged output once, in the case's order
    std::string events;
    for (std::size_t o = 0; o < c.outputs.size(); ++o) {
      if (c.outputs[o].judge == capture::Judge::envelope && enveloped) outputs.push_back(std::move(j.outputs[o]));
      if (c.outputs[o].judge == capture::Judge::bits) {
        outputs.push_back(judge_bits(c.outputs[o], port[o]));
        j.invocations = std::max(j.invocations, outputs.back().elements);
        j.failing += outputs.back().failing;
      }
      if (c.outputs[o].judge != capture::Judge::keyed) continue;
      KeyedJudgement k = judge_keyed(c.outputs[o], port[o], model ? model->keyed(c.outputs[o].name) : nullptr, *options.profile);
      j.invocations += k.groups;
      j.failing += k.failing;
      j.ambiguous += k.ambiguous;
      j.other_branch += k.other_branch;
      j.gave_up += k.gave_up;
      outputs.push_back(std::move(k.output));
      if (const std::string text = k.events.text(); !text.empty())
        events += fmt::format("{}{}, {}", events.empty() ? "" : "; ", c.outputs[o].name, text);
    }
    j.outputs = std::move(outputs);
    conclude(j);
    if (!events.empty()) j.reason = events;
    if (std::all_of(c.outputs.begin(), c.outputs.end(), [](const auto& o) { return o.judge == capture::Judge::input_only; })) {
      j.status = Status::data;
      j.reason = "taken as data: no GPU can reproduce it";
    }
  }
  return result;
}

InvocationJudge::InvocationJudge(const PassCase& c, const PassModel& model, const enclosed::Profile& profile, HalfMode mode)
    : case_(c), model_(model), profile_(profile), mode_(mode) {}

bool InvocationJudge::accepts(int x, int y, const std::vector<Array>& port) const {
  const std::vector<Slot> slots = slots_of(case_);
  Stored stored;
  stored.read(slots, case_, model_, profile_, port, x, y);
  if (stored.any_impossible) return false;
  if (profile_.reference) return std::all_of(stored.same.begin(), stored.same.end(), [](char same) { return same; });
  Alternatives alternatives;
  alternatives.run(model_, x, y, stored.got_values.data(), model_.rounds_inside() ? narrowed(profile_, mode_) : profile_);
  if (alternatives.gave_up) return true;
  std::vector<CodeRange> ranges;
  for (int a = 0; a < alternatives.count; ++a) {
    code_ranges(slots, alternatives.values[static_cast<std::size_t>(a)], profile_, mode_, ranges);
    if (inside(profile_, ranges, stored)) return true;
  }
  return false;
}

std::vector<Array> reference_outputs(const PassCase& c, const PassModel& model, const parallel::Executor& executor, HalfMode mode) {
  const std::vector<Slot> slots = slots_of(c);
  std::vector<Array> out;
  for (const capture::CaseOutput& o : c.outputs) {
    Array& array = out.emplace_back(o.array);
    const capture::KeyedModel* keyed = o.judge == capture::Judge::keyed ? model.keyed(o.name) : nullptr;
    const auto records = keyed ? keyed->reference() : std::nullopt;
    if (!records) continue;
    array.width = static_cast<int>(records->size() / array.element_bytes());
    array.levels = {*records};
  }
  if (slots.empty()) return out;
  executor.for_tiles(model.width(), model.height(), model.width(), 4, [&](const parallel::Tile& tile) {
    std::vector<plain::Plain<float>> values(slots.size());
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        model.evaluate(x, y, values.data());
        for (std::size_t v = 0; v < slots.size(); ++v) {
          const Slot& s = slots[v];
          store_value(s, values[v].v, rounding_of(s, mode), out[static_cast<std::size_t>(s.output)].levels[0].data() + s.offset(x, y));
        }
      }
    }
  });
  return out;
}

}  // namespace rainref::judge
