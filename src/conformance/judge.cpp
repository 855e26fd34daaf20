#include "conformance/judge.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/format.h>

#include "conformance/keyed.h"
#include "conformance/slots.h"
#include "math/replay.h"
#include "rainref/error.h"

namespace rainref::conformance {
namespace {

using capture::Array;
using capture::PassCase;
using capture::PassModel;
using enclosed::CodeRange;
using enclosed::Enclosure;

enclosed::StoreRules rules_of(const enclosed::Profile& profile, HalfMode mode, Rounding unorm) {
  enclosed::StoreRules rules = enclosed::store_rules(profile, unorm);
  rules.half = mode == HalfMode::rne ? enclosed::StoreRounding::rne : mode == HalfMode::rtz ? enclosed::StoreRounding::rtz : enclosed::StoreRounding::either;
  // What a profile says of overflow goes with the rounding that it asks for.
  if (profile.half_store != enclosed::StoreRounding::either && profile.half_store != rules.half && !profile.reference) rules.half_overflow = enclosed::StoreOverflow::either;
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
HalfMode mode_of(enclosed::StoreRounding r) {
  return r == enclosed::StoreRounding::rne ? HalfMode::rne : r == enclosed::StoreRounding::rtz ? HalfMode::rtz : HalfMode::either;
}

/// Every alternative of an invocation.
struct Alternatives {
  std::array<std::vector<Enclosure>, enclosed::Replay::max_runs> values;
  int count = 0;
  bool gave_up = false;

  void run(const PassModel& model, int x, int y, const float* port, const enclosed::Profile& profile) {
    const enclosed::ProfileScope scope(profile);
    enclosed::Replay replay;
    count = 0;
    gave_up = !replay.for_each_alternative([&] {
      std::vector<Enclosure>& out = values[static_cast<std::size_t>(count++)];
      out.assign(static_cast<std::size_t>(model.values()), Enclosure());
      model.enclose(x, y, port, out.data());
    });
  }
};

/// What an invocation stored, and what the reference does.
struct Stored {
  std::vector<std::int64_t> got, expected;
  std::vector<float> got_values;
  bool nan = false;

  void read(const std::vector<Slot>& slots, const PassCase& c, const std::vector<Array>& port, int x, int y) {
    const std::size_t n = slots.size();
    got.resize(n);
    expected.resize(n);
    got_values.resize(n);
    nan = false;
    for (std::size_t v = 0; v < n; ++v) {
      const Slot& s = slots[v];
      const std::size_t o = static_cast<std::size_t>(s.output);
      got[v] = s.code(port[o], x, y);
      expected[v] = s.code(c.outputs[o].array, x, y);
      got_values[v] = stored_value(s, s.at(port[o], x, y));
      nan |= is_nan(s.kind, s.at(port[o], x, y));
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
  for (std::size_t v = 0; v < slots.size(); ++v) out[v] = enclosed::code_range(slots[v].kind, values[v], rules_of(profile, mode, slots[v].store_rounding));
}

/// Under exact rules a march has one number of steps, too.
bool is_free(const PassModel& model, std::size_t value, const enclosed::Profile& profile) { return !profile.reference && model.is_free(static_cast<int>(value)); }

bool inside(const PassModel& model, const enclosed::Profile& profile, const std::vector<CodeRange>& ranges, const std::vector<std::int64_t>& codes) {
  for (std::size_t v = 0; v < codes.size(); ++v)
    if (!is_free(model, v, profile) && !ranges[v].contains(codes[v])) return false;
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
  std::vector<std::vector<std::uint32_t>> widths;  // of each output
};

class CaseJudge {
 public:
  CaseJudge(const PassCase& c, const PassModel& model, const std::vector<Array>& port, const JudgeOptions& options, std::vector<HalfMode> modes)
      : case_(c), model_(model), port_(port), options_(options), modes_(std::move(modes)), slots_(slots_of(c)) {
    if (static_cast<int>(slots_.size()) != model.values())
      throw Error(ExitCode::internal, fmt::format("{}: the model has {} values, the outputs {}", c.folder(), model.values(), slots_.size()));
  }

  std::vector<CaseJudgement> run() {
    constexpr int rows = 4;
    const int tiles = (model_.height() + rows - 1) / rows;
    std::vector<std::vector<Part>> parts(static_cast<std::size_t>(tiles), std::vector<Part>(modes_.size(), empty_part()));
    std::vector<CaseJudgement> whole(modes_.size(), empty_part().counts);
    for (CaseJudgement& j : whole)
      for (OutputJudgement& o : j.outputs) o.map.assign(o.records ? 0 : static_cast<std::size_t>(o.width) * static_cast<std::size_t>(o.height), 0);
    options_.executor->for_tiles(model_.width(), model_.height(), model_.width(), rows, [&](const parallel::Tile& tile) {
      Scratch scratch;
      for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) invocation(x, y, scratch, parts[static_cast<std::size_t>(tile.y0 / rows)], whole);
    });
    for (std::size_t m = 0; m < modes_.size(); ++m) {
      std::vector<std::vector<std::uint32_t>> widths(case_.outputs.size());
      for (std::vector<Part>& tile : parts) add(whole[m], tile[m], widths);
      for (std::size_t o = 0; o < widths.size(); ++o) set_widths(whole[m].outputs[o], widths[o]);
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
    s.stored.read(slots_, case_, port_, x, y);
    if (!model_.rounds_inside()) s.alternatives.run(model_, x, y, s.stored.got_values.data(), *options_.profile);
    for (std::size_t m = 0; m < modes_.size(); ++m) {
      if (model_.rounds_inside()) s.alternatives.run(model_, x, y, s.stored.got_values.data(), narrowed(*options_.profile, modes_[m]));
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
        code_ranges(slots_, values, *options_.profile, mode, s.ranges);
        bool holds_reference = true;
        std::uint64_t far = 0;
        for (std::size_t v = 0; v < n; ++v) {
          if (is_free(model_, v, *options_.profile)) continue;
          far = std::max(far, distance(s.stored.got[v], s.ranges[v]));
          enclosed::StoreRules own = rules_of(*options_.profile, slots_[v].store_rounding == Rounding::rne ? HalfMode::rne : HalfMode::rtz, slots_[v].store_rounding);
          holds_reference &= enclosed::code_range(slots_[v].kind, values[v], own).contains(s.stored.expected[v]);
        }
        if (holds_reference && reference < 0) reference = a;
        if (inside(model_, *options_.profile, s.ranges, s.stored.got) && (accepted < 0 || a == reference)) accepted = a;
        if (far < nearest_distance || nearest < 0) {
          nearest = a;
          nearest_distance = far;
          s.nearest = s.ranges;
        }
      }
    }
    const bool failed = s.stored.nan || (!s.alternatives.gave_up && accepted < 0);
    counts.failing += failed;
    counts.other_branch += !failed && reference >= 0 && accepted != reference;
    const int shown = accepted >= 0 ? accepted : nearest;
    if (shown >= 0) code_ranges(slots_, s.alternatives.values[static_cast<std::size_t>(shown)], *options_.profile, mode, s.ranges);

    bool differs = false;
    for (std::size_t v = 0; v < n; ++v) {
      const Slot& slot = slots_[v];
      OutputJudgement& out = counts.outputs[static_cast<std::size_t>(slot.output)];
      ++out.elements;
      const bool different = s.stored.got[v] != s.stored.expected[v];
      out.differing += different;
      if (different) mark(whole, slot.output, x, y, 1);
      const bool nan = is_nan(slot.kind, slot.at(port_[static_cast<std::size_t>(slot.output)], x, y));
      if (is_free(model_, v, *options_.profile) && !nan) {
        ++out.free;
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
        const double codes = r.is_vacuous() ? 4e9 : static_cast<double>(r.hi) - static_cast<double>(r.lo);
        part.widths[static_cast<std::size_t>(slot.output)].push_back(static_cast<std::uint32_t>(std::min(codes, 4e9)));
      }
      if (failed && (nan || (!s.alternatives.gave_up && !s.nearest[v].contains(s.stored.got[v])))) {
        ++out.failing;
        mark(whole, slot.output, x, y, 3);
        Failure f;
        f.x = x;
        f.y = y;
        f.channel = slot.channel;
        f.got = s.stored.got[v];
        f.expected = s.stored.expected[v];
        if (!s.alternatives.gave_up) {
          f.low = s.nearest[v].lo;
          f.high = s.nearest[v].hi;
        }
        f.not_a_number = nan;
        f.distance = nan ? ~std::uint64_t{0} : distance(f.got, s.nearest[v]);
        out.worst.push_back(f);
        if (out.worst.size() > 4 * OutputJudgement::max_failures) keep_worst(out.worst);
      }
    }
    if (!failed && differs && options_.typical && !s.alternatives.gave_up) check_typical(x, y, s, mode, counts, whole);
  }

  void check_typical(int x, int y, Scratch& s, HalfMode mode, CaseJudgement& counts, CaseJudgement& whole) const {
    s.typical.run(model_, x, y, s.stored.got_values.data(), model_.rounds_inside() ? narrowed(*options_.typical, mode) : *options_.typical);
    if (s.typical.gave_up) return;
    int best = -1;
    std::size_t fewest = slots_.size() + 1;
    for (int a = 0; a < s.typical.count; ++a) {
      code_ranges(slots_, s.typical.values[static_cast<std::size_t>(a)], *options_.typical, mode, s.nearest);
      std::size_t outside = 0;
      for (std::size_t v = 0; v < slots_.size(); ++v) outside += !is_free(model_, v, *options_.profile) && !s.nearest[v].contains(s.stored.got[v]);
      if (outside < fewest) {
        fewest = outside;
        best = a;
      }
    }
    if (fewest == 0) return;
    code_ranges(slots_, s.typical.values[static_cast<std::size_t>(best)], *options_.typical, mode, s.nearest);
    for (std::size_t v = 0; v < slots_.size(); ++v) {
      if (is_free(model_, v, *options_.profile) || s.nearest[v].contains(s.stored.got[v])) continue;
      ++counts.outputs[static_cast<std::size_t>(slots_[v].output)].atypical;
      mark(whole, slots_[v].output, x, y, 2);
    }
  }

  static void add(CaseJudgement& whole, Part& part, std::vector<std::vector<std::uint32_t>>& widths) {
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
      widths[o].insert(widths[o].end(), part.widths[o].begin(), part.widths[o].end());
    }
  }
  static void set_widths(OutputJudgement& out, std::vector<std::uint32_t>& widths) {
    if (widths.empty()) return;
    const auto at = [&](double share) {
      const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(widths.size() - 1));
      std::nth_element(widths.begin(), widths.begin() + k, widths.end());
      return static_cast<double>(widths[static_cast<std::size_t>(k)]);
    };
    out.median_width = at(0.5);
    out.p99_width = at(0.99);
  }

  const PassCase& case_;
  const PassModel& model_;
  const std::vector<Array>& port_;
  const JudgeOptions& options_;
  std::vector<HalfMode> modes_;
  std::vector<Slot> slots_;
};

/// The first channel of a texel whose bits differ, as a failure says it.
void set_first_difference(const FormatInfo& format, const std::byte* want, const std::byte* have, Failure& f) {
  const auto bytes = static_cast<std::size_t>(format.channel_bytes);
  while (std::memcmp(want + static_cast<std::size_t>(f.channel) * bytes, have + static_cast<std::size_t>(f.channel) * bytes, bytes) == 0) ++f.channel;
  const std::size_t at = static_cast<std::size_t>(f.channel) * bytes;
  f.got = enclosed::ordered_code(format.kind, have + at);
  f.expected = f.low = f.high = enclosed::ordered_code(format.kind, want + at);
  f.not_a_number = is_nan(format.kind, have + at);
  f.distance = f.not_a_number ? ~std::uint64_t{0} : std::max<std::uint64_t>(1, distance(f.got, {f.low, f.high}));
}

/// The first word of a record whose bits differ. Padding has no name, but counts.
void set_first_difference(const scene::UniformBlock& record, const std::byte* want, const std::byte* have, Failure& f) {
  std::size_t at = 0;
  while (std::memcmp(want + at, have + at, 4) == 0) at += 4;
  f.field = fmt::format("byte {}", at);
  for (const scene::Member& m : record.members) {
    if (at < m.offset || at >= m.offset + m.size()) continue;
    f.field = m.components == 1 ? m.name : fmt::format("{}.{}", m.name, "xyzw"[(at - m.offset) / 4]);
    if (m.scalar == scene::Scalar::float32) f.field_kind = FormatInfo::float32;
  }
  f.got = enclosed::ordered_code(f.field_kind, have + at);
  f.expected = f.low = f.high = enclosed::ordered_code(f.field_kind, want + at);
  f.not_a_number = is_nan(f.field_kind, have + at);
  f.distance = f.not_a_number ? ~std::uint64_t{0} : std::max<std::uint64_t>(1, distance(f.got, {f.low, f.high}));
}

/// Bits against bits, texel by texel or record by record.
void judge_bits(const capture::CaseOutput& expected, const Array& port, CaseJudgement& j) {
  OutputJudgement out;
  out.name = expected.name;
  out.format = expected.array.format;
  out.records = expected.array.is_records;
  out.width = expected.array.width;
  out.height = expected.array.height;
  const std::size_t size = expected.array.element_bytes();
  const std::vector<std::byte>&want = expected.array.levels[0], &have = port.levels[0];
  const std::size_t count = want.size() / size, found = have.size() / size;
  out.elements = static_cast<std::int64_t>(std::max(count, found));
  if (!out.records) out.map.assign(count, 0);
  for (std::size_t i = 0; i < std::max(count, found); ++i) {
    if (i < count && i < found && std::memcmp(want.data() + i * size, have.data() + i * size, size) == 0) continue;
    ++out.failing;
    ++out.differing;
    if (!out.records) out.map[i] = 3;
    if (out.worst.size() < OutputJudgement::max_failures) {
      Failure f;
      f.x = static_cast<int>(out.records ? i : i % static_cast<std::size_t>(out.width));
      f.y = out.records ? 0 : static_cast<int>(i / static_cast<std::size_t>(out.width));
      f.distance = 1;
      if (!out.records) set_first_difference(info(out.format), want.data() + i * size, have.data() + i * size, f);
      else if (i < count && i < found) set_first_difference(expected.array.record, want.data() + i * size, have.data() + i * size, f);
      out.worst.push_back(f);
    }
  }
  j.invocations = std::max(j.invocations, out.elements);
  j.failing += out.failing;
  j.outputs.push_back(std::move(out));
}

}  // namespace

const char* name(Status status) {
  constexpr const char* names[] = {"PASS", "WARN", "FAIL", "UNTESTED", "KNOWN", "DATA"};
  return names[static_cast<int>(status)];
}
const char* name(HalfMode mode) {
  constexpr const char* names[] = {"rne", "rtz", "either"};
  return names[static_cast<int>(mode)];
}
Status worse(Status a, Status b) {
  const auto rank = [](Status s) { return s == Status::fail ? 4 : s == Status::untested ? 3 : s == Status::known ? 2 : s == Status::warn ? 1 : s == Status::pass ? 0 : -1; };
  return rank(a) >= rank(b) ? a : b;
}

void conclude(CaseJudgement& j) {
  std::int64_t elements = 0, vacuous = 0, free = 0, atypical = 0;
  for (const OutputJudgement& o : j.outputs) {
    elements += o.elements;
    vacuous += o.vacuous;
    free += o.free;
    atypical += o.atypical;
  }
  if (j.failing > 0) {
    j.status = Status::fail;
  } else if (elements == 0 && j.outputs.empty()) {
    j.status = Status::untested;
    j.reason = "nothing to judge";
  } else if (vacuous * 100 > elements - free && elements > free) {
    j.status = Status::untested;
    j.reason = fmt::format("{:.2f} % of the elements have no useful bound, more than 1 %", 100.0 * static_cast<double>(vacuous) / static_cast<double>(elements - free));
  } else if (atypical > 0) {
    j.status = Status::warn;
    j.reason = fmt::format("{} elements lie inside the profile but outside what real devices do", atypical);
  } else {
    j.status = Status::pass;
  }
}

ModeJudgements judge_case(const PassCase& c, const PassModel* model, const std::vector<Array>& port, const JudgeOptions& options) {
  ModeJudgements result;
  const bool has_half = std::any_of(c.outputs.begin(), c.outputs.end(), [](const capture::CaseOutput& o) {
    return o.judge == capture::Judge::envelope && !o.array.is_records && info(o.array.format).kind == FormatInfo::float16;
  });
  const HalfMode declared = mode_of(options.profile->half_store);
  if (options.profile->reference || !has_half) result.modes = {declared == HalfMode::either ? HalfMode::rne : declared};
  else if (declared != HalfMode::either && options.half_mode == declared) result.modes = {declared};
  else if (declared != HalfMode::either) result.modes = {declared, declared == HalfMode::rne ? HalfMode::rtz : HalfMode::rne};
  else if (options.half_mode) result.modes = {*options.half_mode};
  else result.modes = {HalfMode::rne, HalfMode::rtz, HalfMode::either};

  const bool enveloped = !slots_of(c).empty();
  if (enveloped && !model) throw Error(ExitCode::internal, fmt::format("{}: no reading of this pass", c.pass));
  if (enveloped) result.judgements = CaseJudge(c, *model, port, options, result.modes).run();
  else result.judgements.assign(result.modes.size(), CaseJudgement{});
  for (CaseJudgement& j : result.judgements) {
    j.id = c.folder();
    for (std::size_t o = 0; o < c.outputs.size(); ++o)
      if (c.outputs[o].judge == capture::Judge::bits) judge_bits(c.outputs[o], port[o], j);
    std::string events;
    for (std::size_t o = 0; o < c.outputs.size(); ++o) {
      if (c.outputs[o].judge != capture::Judge::keyed) continue;
      KeyedJudgement k = judge_keyed(c.outputs[o], port[o], model ? model->keyed(c.outputs[o].name) : nullptr, *options.profile);
      j.invocations += k.groups;
      j.failing += k.failing;
      j.ambiguous += k.ambiguous;
      j.other_branch += k.other_branch;
      j.gave_up += k.gave_up;
      j.outputs.push_back(std::move(k.output));
      if (const std::string text = k.events.text(); !text.empty()) events += fmt::format("{}{}, {}", events.empty() ? "" : "; ", c.outputs[o].name, text);
    }
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
  stored.read(slots, case_, port, x, y);
  if (stored.nan) return false;
  Alternatives alternatives;
  alternatives.run(model_, x, y, stored.got_values.data(), model_.rounds_inside() ? narrowed(profile_, mode_) : profile_);
  if (alternatives.gave_up) return true;
  std::vector<CodeRange> ranges;
  for (int a = 0; a < alternatives.count; ++a) {
    code_ranges(slots, alternatives.values[static_cast<std::size_t>(a)], profile_, mode_, ranges);
    if (inside(model_, profile_, ranges, stored.got)) return true;
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

}  // namespace rainref::conformance
