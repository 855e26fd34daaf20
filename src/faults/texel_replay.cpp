#include "faults/texel_replay.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "faults/generators.h"
#include "faults/hypotheses.h"
#include "faults/solver.h"
#include "image/code_range.h"
#include "judge/reference_outputs.h"
#include "judge/sample.h"
#include "math/path_enumeration.h"
#include "rainref/error.h"

namespace rainref::faults {

using capture::Array;
using judge::CaseJudgement;
using judge::Cause;
using judge::OutputJudgement;
using judge::reference_outputs;
using judge::Slot;
using judge::slots_of;
using judge::stored_value;

namespace {

/// Texels that were judged and passed.
std::vector<Texel> passing_texels(const capture::PassModel& model, const std::vector<Texel>& failing, const CaseJudgement& j) {
  const auto judged = std::find_if(j.outputs.begin(), j.outputs.end(), [](const OutputJudgement& o) { return !o.map.empty(); });
  const auto is_judged = [&](int x, int y) {
    return !j.is_of_sample || judged->map[static_cast<std::size_t>(y * judged->width + x)] != OutputJudgement::not_judged;
  };
  std::vector<Texel> out;
  auto next = failing.begin();
  for (int y = 0; y < model.height(); ++y)
    for (int x = 0; x < model.width(); ++x) {
      if (next != failing.end() && next->x == x && next->y == y)
        ++next;
      else if (is_judged(x, y))
        out.push_back({x, y});
    }
  return out;
}

/// The reference's outputs with a rounding of halves. The case has those with its own rounding.
std::vector<Array> finished_outputs(const capture::PassCase& c, const capture::PassModel& model, const parallel::Executor& executor,
                                    judge::HalfMode mode) {
  if (!judge::is_own_rounding(slots_of(c), mode)) return reference_outputs(c, model, executor, mode);
  std::vector<Array> out;
  for (const capture::CaseOutput& o : c.outputs) out.push_back(o.array);
  return out;
}

/// Compares a fault's texel with the port's.
struct Match {
  bool exact = false;  ///< equal bits
  bool near = false;   ///< within a device's own differences, and much nearer than the reference
  bool close = false;  ///< the same, by the envelope alone
  bool tells = false;  ///< so near, or so much nearer than the reference, that it is not chance
  double left = 1;     ///< share of the port's difference from the reference that remains: 0 to 1
};

std::int64_t gap(std::int64_t a, std::int64_t b) { return a < b ? b - a : a - b; }

/// The tolerance at these texels.
Leeway leeway_of(const std::vector<Slot>& slots, const capture::PassCase& c, const capture::PassModel& model,
                 const std::vector<Array>& reference, const std::vector<Array>& port, const CaseJudgement& j,
                 const enclosed::Profile& profile, const std::vector<Texel>& texels) {
  Leeway out;
  for (const Slot& s : slots) {
    const std::string& name = c.outputs[static_cast<std::size_t>(s.output)].name;
    const auto found = std::find_if(j.outputs.begin(), j.outputs.end(), [&](const OutputJudgement& o) { return o.name == name; });
    // The 99 % quantile of the envelopes' widths, unless these few are far wider than most.
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
    int alternatives = 0;
    paths.for_each_alternative([&] {
      model.enclose(t.x, t.y, stored.data(), values.data());
      const bool is_open = ++alternatives > 1;
      // A very wide bound would make everything near.
      for (std::size_t v = 0; v < slots.size(); ++v)
        if (!values[v].is_vacuous())
          widths[v] = std::max(widths[v], std::min(static_cast<double>(values[v].hi) - values[v].lo, slots[v].range / 64));
      // If the arithmetic leaves a decision open, a port may take the other side, whatever else is wrong with it.
      for (std::size_t v = 0; is_open && v < slots.size(); ++v) {
        const float other = stored_value(slots[v], slots[v].at(port[static_cast<std::size_t>(slots[v].output)], t.x, t.y));
        if (!values[v].is_vacuous() && values[v].lo <= other && other <= values[v].hi)
          widths[v] = std::max(widths[v], std::abs(static_cast<double>(other) - stored[v]));
      }
    });
  }
  return out;
}

/// For texel number k.
Match compare(const std::vector<Slot>& slots, const capture::PassModel& model, const StoredTexel& faulty, const std::vector<Array>& port,
              const std::vector<Array>& reference, const Leeway& leeway, const std::vector<Texel>& texels, std::size_t k) {
  Match m{true, true, true, true};
  bool nearer = false;
  double off_with = 0, off_before = 0;
  for (std::size_t v = 0; v < slots.size(); ++v) {
    if (model.is_free(static_cast<int>(v))) continue;
    const Slot& s = slots[v];
    const std::size_t o = static_cast<std::size_t>(s.output);
    const std::byte *got = s.at(port[o], texels[k].x, texels[k].y), *guess = faulty[v].data(),
                    *base = s.at(reference[o], texels[k].x, texels[k].y);
    // NaN has many codes; a machine may store any of them.
    const bool are_no_numbers = judge::is_nan(s.kind, got) && judge::is_nan(s.kind, guess);
    const auto code = [&](const std::byte* at) { return enclosed::ordered_code(s.kind, at); };
    const std::int64_t far = are_no_numbers ? 0 : gap(code(got), code(guess)), before = gap(code(got), code(base));
    const double off = std::abs(static_cast<double>(stored_value(s, got)) - stored_value(s, guess));
    off_with += static_cast<double>(far);
    off_before += static_cast<double>(before);
    m.exact &= far == 0;
    // A small rest of a large difference may come from the device's own lookup at the other position.
    const bool is_close = far <= leeway.codes[v] || off <= leeway.values[k][v];
    m.close &= is_close;
    m.near &= is_close || 48 * far <= before;
    nearer |= far < before && 4 * far <= before;
    m.tells &= far == 0 || 16 * far <= before;
  }
  m.exact &= nearer;  // otherwise the reference has the same bits, and the fault explains nothing
  m.close &= nearer;
  m.near &= nearer;
  m.tells &= m.near;
  m.left = off_before > 0 ? std::min(1.0, off_with / off_before) : 1;
  return m;
}

/// Effect of a fault on texels that passed.
struct Passing {
  double contradicted = 0;  ///< share of them where the fault would store clearly different codes than the port did
  std::int64_t bad = 0;     ///< number that it moves by more than a few codes, away from the port's values
};
Passing passing_with(const std::vector<Slot>& slots, const capture::PassModel& model, const FaultyPass& faulty,
                     const std::vector<Array>& port, const std::vector<Array>& reference, const Leeway& leeway,
                     const std::vector<Texel>& passing) {
  constexpr std::int64_t few_codes = 3;
  StoredTexel stored;
  Passing out;
  std::int64_t against = 0;
  for (const Texel t : passing) {
    faulty.store(t, stored);
    bool is_against = false;
    std::int64_t moved = 0, before = 0, after = 0;
    for (std::size_t v = 0; v < slots.size(); ++v) {
      if (model.is_free(static_cast<int>(v))) continue;
      const auto code = [&](const std::vector<Array>& a) {
        return enclosed::ordered_code(slots[v].kind, slots[v].at(a[static_cast<std::size_t>(slots[v].output)], t.x, t.y));
      };
      const std::int64_t with = enclosed::ordered_code(slots[v].kind, stored[v].data()), without = code(reference), got = code(port);
      is_against |= gap(with, got) > 2 * leeway.codes[v] + gap(without, got);
      moved += gap(with, without);
      before += gap(without, got);
      after += gap(with, got);
    }
    against += is_against;
    if (moved <= few_codes) continue;
    out.bad += 4 * before < moved && 2 * after > moved;
  }
  if (!passing.empty()) out.contradicted = static_cast<double>(against) / static_cast<double>(passing.size());
  return out;
}

}  // namespace

TexelReplay::TexelReplay(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before, judge::Bind bind,
                         const capture::PassModel& model, const std::vector<Array>& port, const CaseJudgement& judgement,
                         const enclosed::Profile& profile, judge::HalfMode mode, const parallel::Executor& executor)
    : probed_{pass, c, bind, model},
      before_(before),
      mode_(mode),
      executor_(executor),
      slots_(slots_of(c)),
      port_(port),
      reference_(finished_outputs(c, model, executor, mode)) {
  const std::vector<Texel> failing = failing_texels(judgement), passing = passing_texels(model, failing, judgement);
  // So many show a share to a hundredth, and the search takes most of its time with mistakes that are tried on all of them.
  constexpr std::size_t most = 128;
  failing_ = spread(failing, most);
  few_passing_ = spread(passing, most);
  many_passing_ = spread(passing, 20000);
  leeway_ = leeway_of(slots_, c, model, reference_, port, judgement, profile, failing_);
  constexpr std::size_t long_pass = 1500;
  if (!failing_.empty() && trace_of(model, failing_.front()).nodes.size() > long_pass) patience_ = 4;
  passing_per_failing_ = static_cast<double>(passing.size()) / static_cast<double>(std::max<std::size_t>(failing.size(), 1));
}

std::vector<Fault> TexelReplay::plain() {
  if (failing_.empty()) return {};
  Hypotheses all = hypotheses(probed_, before_, failing_);
  constants_ = std::move(all.constants);
  orders_ = std::move(all.orders);
  probes_ = std::move(all.probes);
  known_ = std::move(all.known);
  return std::move(all.faults);
}
std::vector<Fault> TexelReplay::solved() {
  std::vector<Solvable> texels;
  const auto add = [&](const Probe& probe, std::size_t number) {
    const Texel t = failing_[number];
    Solvable& one = texels.emplace_back(Solvable{probe, {}, {}, {}});
    one.evaluate = [this, t] {
      std::vector<perturbed::Perturbed> values(slots_.size());
      probed_.model.evaluate(t.x, t.y, values.data());
      std::vector<float> out;
      for (const perturbed::Perturbed& v : values) out.push_back(v.v);
      return out;
    };
    for (std::size_t v = 0; v < slots_.size(); ++v) {
      const Slot& s = slots_[v];
      const float stored = judge::middle_value(s, s.at(port_[static_cast<std::size_t>(s.output)], t.x, t.y), mode_);
      // Half a step is the store's own rounding.
      const double step = s.kind == FormatInfo::unorm8    ? 1 / 255.0
                          : s.kind == FormatInfo::float16 ? std::abs(stored) * 0x1p-10 + 0x1p-24
                                                          : std::abs(stored) * 0x1p-23 + 0x1p-40;
      one.port.push_back(stored);
      one.leeway.push_back(std::max(0.75 * step, leeway_.values[number][v] + 0.5 * step));
      if (probed_.model.is_free(static_cast<int>(v))) one.leeway.back() = HUGE_VAL;
    }
  };
  for (const Probe& probe : probes_) {
    const auto same = [&](Texel t) { return t.x == probe.at.x && t.y == probe.at.y; };
    const auto number = static_cast<std::size_t>(std::find_if(failing_.begin(), failing_.end(), same) - failing_.begin());
    if (number < leeway_.values.size()) add(probe, number);
  }
  // More texels, so that few candidates fit by chance.
  constexpr std::size_t most = 10;
  const std::size_t step = std::max<std::size_t>(1, failing_.size() / most);
  for (std::size_t k = step / 2; !texels.empty() && k < failing_.size(); k += step) add(probes_[0], k);
  std::vector<Fault> out;
  add_solved_substitutions(out, probed_, texels, known_, {executor_, [this] { return is_time_over(); }});
  return out;
}
std::vector<Fault> TexelReplay::decidable() const {
  return failing_.empty() ? std::vector<Fault>() : decidable_faults(probed_, port_, failing_.front());
}
std::vector<Fault> TexelReplay::of_finished() const {
  std::vector<Fault> out;
  add_output_faults(out, probed_.c, before_);
  return out;
}
std::vector<Fault> TexelReplay::fitted() { return fits(probed_, constants_, port_, reference_, failing_, mode_); }

std::optional<Cause> TexelReplay::alternative_formula(const enclosed::Profile& profile) const {
  if (failing_.empty()) return {};
  return faults::alternative_formula(probed_.c, port_, profile, mode_, failing_, few_passing_);
}

bool TexelReplay::widen() { return probed_.model.chooses_records() && !std::exchange(is_wide_, true); }

Tried TexelReplay::cause(const Fault& given) const {
  std::optional<Fault> wide;
  if (is_wide_ && given.is_evaluated()) wide.emplace(given).behaviour.reaches_all = true;
  const Fault& d = wide ? *wide : given;
  Tried cause = untried(d, failing_.size(), false, 1);
  const FaultyPass faulty(d, probed_.c, probed_.bind, probed_.model, mode_, reference_);
  if (!faulty.applies()) return cause;
  StoredTexel stored;
  const auto match_at = [&](std::size_t t) {
    faulty.store(failing_[t], stored);
    return compare(slots_, probed_.model, stored, port_, reference_, leeway_, failing_, t);
  };
  // Most hypotheses fail after a few texels, in an order that is spread over all of them; what explains too few of these is not tried on
  // all.
  const std::size_t few = std::min<std::size_t>(failing_.size(), 24);
  std::size_t matching = 0;
  for (std::size_t k = 0; k < few && matching * 6 < few; ++k) {
    if (matching == 0 && k >= (d.is_one_of_many ? std::min(patience_, 5u) : patience_)) return cause;
    const std::size_t number = few == 24 ? k * 7 % few : k;
    matching += match_at(number * failing_.size() / few).close;
  }
  if (matching * 6 < few) return cause;
  std::int64_t telling = 0;
  double left = 0;
  for (std::size_t t = 0; t < failing_.size(); ++t) {
    const Match m = match_at(t);
    cause.explained += m.exact;
    cause.inside += m.near;
    telling += m.tells;
    left += m.left;
  }
  // In a nearly empty buffer a mirrored image also has zero wherever the port lost something. A cause must not break about as many texels
  // as it explains.
  const std::vector<Texel>& passing = d.is_evaluated() ? few_passing_ : many_passing_;
  const Passing there = passing_with(slots_, probed_.model, faulty, port_, reference_, leeway_, passing);
  if (there.contradicted * passing_per_failing_ * 4 > 1) cause.explained = cause.inside = 0;
  cause.bad = there.bad;
  cause.is_likely = telling * 10 >= cause.of * 9;
  cause.misfit = left / static_cast<double>(failing_.size());
  return cause;
}

std::vector<Tried> TexelReplay::causes(const std::vector<Fault>& all) const {
  return tried(*this, executor_, all, failing_.size(), false, [&](const Fault& d) { return cause(d); });
}

TexelReplay::TexelReplay(const TexelReplay& of, const capture::PassCase& c, const capture::PassModel& model)
    : probed_{of.probed_.pass, c, of.probed_.bind, model},
      before_(of.before_),
      mode_(of.mode_),
      executor_(of.executor_),
      slots_(of.slots_),
      port_(of.port_),
      reference_(of.reference_),
      failing_(spread(of.failing_, 64)) {
  for (const Texel t : spread(of.few_passing_, 32)) failing_.push_back(t);
}

std::unique_ptr<Replay> TexelReplay::elsewhere() const {
  try {
    auto c = std::make_unique<capture::PassCase>(varied(probed_.pass, probed_.c));
    std::unique_ptr<capture::PassModel> model = probed_.bind(*c);
    return std::make_unique<OwnReplay<TexelReplay>>(*this, std::move(c), std::move(model));
  } catch (const Error&) {
    return nullptr;  // the pass rejects such numbers
  }
}

std::vector<float> TexelReplay::given(const Fault& d) const {
  std::vector<float> out;
  try {
    const FaultyPass faulty(d, probed_.c, probed_.bind, probed_.model, mode_, reference_);
    if (!faulty.applies()) return out;
    StoredTexel stored;
    for (const Texel t : failing_) {
      faulty.store(t, stored);
      for (std::size_t v = 0; v < slots_.size(); ++v) out.push_back(stored_value(slots_[v], stored[v].data()));
    }
  } catch (const Error&) {
    out.clear();
  }
  return out;
}

}  // namespace rainref::faults
