#include "faults/replay.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "faults/diagnose.h"
#include "faults/members.h"
#include "rainref/error.h"

namespace rainref::faults {
namespace {

using judge::Cause;

double score(const Cause& c) { return static_cast<double>(c.explained + c.inside) / static_cast<double>(std::max<std::int64_t>(c.of, 1)); }
bool is_explained(const std::vector<Tried>& causes) {
  // A cause that is fitted to lost records, or that says that nothing was done, may have its reason in the text. So may an unset number,
  // for which a few records are weak evidence.
  constexpr std::int64_t few = 8;
  const auto is_symptom = [](const Tried& c) {
    return c.what.is(trait::lost | trait::late | trait::symptom) || (c.of_records && c.what.is(trait::empty)) ||
           (c.what.is(trait::unset) && c.of < few);
  };
  return std::any_of(causes.begin(), causes.end(),
                     [&](const Tried& c) { return c.is_likely && score(c) >= 1.9 && !is_symptom(c) && !is_fitted(c); });
}

using Names = std::set<std::string>;
/// Names of causes found by solving.
Names solved_of(const std::vector<Tried>& causes) {
  Names out;
  for (const Tried& c : causes)
    if (is_solved(c)) out.insert(c.name);
  return out;
}
/// The faults of a run with these names. `solved`: names that only solving finds.
std::vector<Fault> named(Replay& run, const Names& names, const Names& solved) {
  Names found;
  std::vector<Fault> out;
  const auto take_named = [&](std::vector<Fault> all) {
    for (Fault& d : all)
      if (std::string name = name_of(d); names.contains(name)) out.push_back(std::move(d)), found.insert(std::move(name));
  };
  take_named(run.plain());
  if (found.size() == names.size()) return out;
  take_named(run.deeper());
  const auto is_found_by_solving = [&](const std::string& name) { return solved.contains(name); };
  if (std::any_of(names.begin(), names.end(), is_found_by_solving)) take_named(run.solved());
  return out;
}

/// Adds how well the causes that explain something explain another run.
void check_in(Replay& other, std::vector<Tried>& causes, std::vector<Fault>& all) {
  Names names;
  bool is_any_fitted = false;
  for (const Tried& c : causes) {
    if (c.inside * 2 < c.of && c.explained * 4 < c.of) continue;
    names.insert(c.name);
    is_any_fitted |= is_fitted(c);
  }
  if (names.empty()) return;
  all = named(other, names, solved_of(causes));
  if (is_any_fitted)
    for (Fault& d : other.fitted())
      if (names.contains(name_of(d))) all.push_back(std::move(d));
  std::map<std::string, Tried> there;
  for (Tried& c : other.causes(all)) {
    const auto [at, is_new] = there.emplace(c.name, c);
    if (!is_new && score(c) > score(at->second)) at->second = c;
  }
  double best = 0;
  for (const auto& [name, c] : there) best = std::max(best, score(c));
  if (best < 1) return;  // there the mistake has another effect
  for (Tried& c : causes) {
    const auto found = there.find(c.name);
    if (found == there.end()) {
      c.is_likely = false;
      c.is_untested = true;
      if (is_solved(c)) c.of += there.begin()->second.of;  // it was searched for there, and not found
      continue;
    }
    c.explained += found->second.explained;
    c.inside += found->second.inside;
    c.of += found->second.of;
    c.bad += found->second.bad;
    c.is_likely &= found->second.is_likely;
    c.misfit = std::max(c.misfit, found->second.misfit);
    c.other_fault = found->second.fault;
  }
}

bool same(float a, float b) {
  const double size = std::max(std::abs(static_cast<double>(a)), std::abs(static_cast<double>(b)));
  return a == b || (std::isnan(a) && std::isnan(b)) || std::abs(static_cast<double>(a) - b) <= 0x1p-10 * size + 0x1p-20;
}
/// True if two mistakes give the same numbers, up to rounding, wherever either differs from `right`.
bool alike(const std::vector<float>& a, const std::vector<float>& b, const std::vector<float>& right) {
  if (a.size() != b.size()) return false;
  std::size_t alike = 0, shown = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (right.size() == a.size() && same(a[k], right[k]) && same(b[k], right[k])) continue;
    ++shown;
    alike += same(a[k], b[k]);
  }
  return shown > 0 && alike * 50 >= shown * 49;
}

/// Values of the mistakes of these names in a run.
std::map<std::string, std::vector<std::vector<float>>> given_by(Replay& run, const Names& names, const Names& solved) {
  std::map<std::string, std::vector<std::vector<float>>> given;
  for (const Fault& d : named(run, names, solved))
    if (std::vector<float> numbers = run.given(d); !numbers.empty()) given[name_of(d)].push_back(std::move(numbers));
  return given;
}
/// How other causes compare with the first, in this run and with other numbers.
struct Compared {
  bool has_rival = false;  ///< one of them is another mistake at another place
  Names alike;             ///< those that give the same values, in this run and elsewhere
};
Compared compared(Replay& run, const Tried& best, const Names& others, const Names& solved) {
  const std::string& first = best.name;
  Compared out;
  if (others.empty()) return out;
  const std::unique_ptr<Replay> elsewhere = run.elsewhere();
  if (!elsewhere) return out;
  Names names = others;
  names.insert(first);
  const auto alike_in = [&](Replay& where, const Names& asked, Names& unknown) {
    Names same;
    const auto given = given_by(where, asked, solved);
    const std::vector<float> right = where.given(Fault{});
    const auto own = given.find(first);
    for (const std::string& name : asked) {
      const auto theirs = given.find(name);
      if (own == given.end() || theirs == given.end())
        unknown.insert(name);
      else if (std::any_of(theirs->second.begin(), theirs->second.end(), [&](const std::vector<float>& b) {
                 return std::any_of(own->second.begin(), own->second.end(),
                                    [&](const std::vector<float>& a) { return alike(a, b, right); });
               }))
        same.insert(name);
    }
    return same;
  };
  Names unknown;
  out.alike = alike_in(*elsewhere, names, unknown);
  // Solved causes cannot be tested elsewhere.
  if (unknown.contains(first)) {
    out.alike.clear();
    out.has_rival = is_solved(best);
    return out;
  }
  out.alike.erase(first);
  for (const std::string& name : others) out.has_rival |= !out.alike.contains(name) && !unknown.contains(name);
  if (out.has_rival || out.alike.empty()) return out;
  // With other numbers both may reach the same bounds: causes that differ here are not equal.
  Names here = out.alike, unused;
  here.insert(first);
  const Names same = alike_in(run, here, unused);
  std::erase_if(out.alike, [&](const std::string& name) { return !same.contains(name) && !unused.contains(name); });
  return out;
}

/// Adds causes with equal values everywhere to the first one's text, in order of plausibility: the port has one of them.
void say_one_of(Tried& first, std::vector<Tried> causes, Names others, int most = 2, const char* word = "; or, which gives the same, ",
                std::string own = "") {
  std::stable_sort(causes.begin(), causes.end(), [](const Tried& a, const Tried& b) { return far_fetched(a) < far_fetched(b); });
  int said = 0;
  if (own.empty()) own = first.sentence;
  Names heads{head_of(first.what)};
  for (const bool is_new_sort : {true, false})
    for (const Tried& c : causes) {
      if (said >= most || c.sentence == own || !others.contains(c.name) || (is_new_sort && !heads.insert(head_of(c.what)).second)) continue;
      others.erase(c.name);
      first.sentence += (said == 0 ? word : "; or ") + c.sentence;
      ++said;
    }
}

/// The kind of a draw, for ranking; its texts are in a list of their own.
Kind kind_of(const random::Draws& d) {
  const random::Draws right;
  const auto is_one = [](int off) { return off == 1 || off == -1; };
  const bool is_one_off = (is_one(d.counters_off[0]) && d.counters_off[1] == 0) || (is_one(d.counters_off[1]) && d.counters_off[0] == 0) ||
                          is_one(d.purpose_off);
  if (d.moved != right.moved) return Kind::drawn_with_factor_moved;
  if (is_one_off && d.only == right.only) return Kind::drawn_by_one;
  return d.mixing ? Kind::drawn_otherwise : Kind::drawn;
}

/// True if a kind is left out: RAINREF_LEAVE_OUT gives their numbers, "17-23", for scripts/full/ablation.
bool is_left_out(Kind kind) {
  static const std::pair<int, int> range = [] {
    std::pair<int, int> out{0, -1};
    char dash;
    if (const char* const text = std::getenv("RAINREF_LEAVE_OUT")) std::istringstream(text) >> out.first >> dash >> out.second;
    return out;
  }();
  return range.first <= static_cast<int>(kind) && static_cast<int>(kind) <= range.second;
}

}  // namespace

Tried::Tried(What made, Cause figures, double how_far) : Cause(std::move(figures)), what(std::move(made)), misfit(how_far) {
  name = name_of(what);
  sentence = sentence_of(what);
}

Tried untried(const Fault& d, std::size_t of, bool of_records, double misfit) {
  What what = d;
  if (d.draws) what.kind = kind_of(*d.draws);
  return {std::move(what), {"", "", 0, static_cast<std::int64_t>(of), 0, of_records}, misfit};
}
std::vector<Tried> tried(const Replay& replay, const parallel::Executor& executor, const std::vector<Fault>& all, std::size_t of,
                         bool of_records, const std::function<Tried(const Fault&)>& try_one) {
  std::vector<Tried> out(all.size());
  executor.for_range(static_cast<std::int64_t>(all.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k) {
      const Fault& d = all[static_cast<std::size_t>(k)];
      Tried& made = out[static_cast<std::size_t>(k)];
      try {
        made = is_left_out(d.kind) || replay.is_time_over() ? untried(d, of, of_records) : try_one(d);
      } catch (const Error&) {
        made = untried(d, of, of_records);  // the pass cannot run on the altered case
      }
      made.fault = &d;
    }
  });
  return out;
}

namespace {
constexpr std::size_t most_lines = 3;
/// Adds a line of the port's shader to those of a cause.
void add_line(Cause& to, const Replay& run, const FoundLine& found) {
  if (const std::optional<judge::ShaderLine> line = run.line(found);
      line && to.lines.size() < most_lines && std::find(to.lines.begin(), to.lines.end(), *line) == to.lines.end())
    to.lines.push_back(*line);
}
/// Where the port's shader departs from the reference.
std::vector<FoundLine> departures_of(const Replay& run) {
  std::vector<Followed> failing, passing;
  run.follow_right(failing, passing);
  return failing.empty() ? std::vector<FoundLine>() : departures(failing, passing);
}
}  // namespace

std::optional<Cause> unknown_cause(const Replay& run, bool of_records) {
  What unknown;
  unknown.kind = Kind::unknown;
  Tried out(std::move(unknown), {"", "", 0, 0, 0, of_records});
  for (const FoundLine& found : departures_of(run)) add_line(out, run, found);
  return out.lines.empty() ? std::nullopt : std::optional<Cause>(out);
}

void add_lines(const Replay& run, const Replay* other, std::vector<Tried>& best, const std::vector<Tried>& causes,
               const std::set<std::string>& alike) {
  constexpr std::size_t most_causes = 8;
  Tried& first = best.front();
  const auto add_all = [&](const std::vector<FoundLine>& all) {
    for (const FoundLine& found : all) add_line(first, run, found);
  };
  std::vector<FoundLine> functions_and_calls;
  const auto add_lines_of = [&](const Tried& c) {
    std::vector<Followed> followed;
    run.follow(*c.fault, followed);
    if (other && c.other_fault && !followed.empty()) other->follow(*c.other_fault, followed);
    if (followed.empty()) return;
    const FoundLines found = lines_of_mistake(followed, c.what.is_of_function());
    add_all(found.lines);
    functions_and_calls.insert(functions_and_calls.end(), found.function_and_call.begin(), found.function_and_call.end());
  };
  const auto explains_much = [](const Tried& c) { return c.inside * 3 >= c.of; };
  std::vector<const Tried*> asked;
  for (const Tried& c : causes)
    if (c.fault && (c.name == first.name || alike.contains(c.name)) && explains_much(first) && explains_much(c)) asked.push_back(&c);
  std::stable_sort(asked.begin(), asked.end(), [&](const Tried* a, const Tried* b) {
    if ((a->name == first.name) != (b->name == first.name)) return a->name == first.name;
    return far_fetched(*a) < far_fetched(*b);
  });
  asked.resize(std::min(asked.size(), most_causes));
  for (const Tried* c : asked) {
    if (first.lines.size() >= most_lines) break;
    add_lines_of(*c);
  }
  if (first.is_likely) return;
  for (std::size_t k = 1; k < best.size() && first.lines.size() < most_lines; ++k)
    if (best[k].fault && explains_much(best[k])) add_lines_of(best[k]);
  add_all(functions_and_calls);
  if (first.lines.size() < most_lines) add_all(departures_of(run));
}

std::vector<Cause> diagnosed(Replay& run, Replay* other, bool is_plain) {
  std::deque<std::vector<Fault>> faults;  // owns faults that causes point to
  std::vector<Tried> causes;
  const auto try_all = [&](std::vector<Fault> all) {
    faults.push_back(std::move(all));
    return run.causes(faults.back());
  };
  causes = try_all(run.plain());
  // If plain faults explain nearly all failures, less plain ones are not tried.
  Names sought;
  const auto explains_little = [&] { return std::none_of(causes.begin(), causes.end(), [](const Tried& c) { return score(c) >= 1.5; }); };
  for (const auto more : {&Replay::deeper, &Replay::solved, &Replay::fitted}) {
    if (is_plain || is_explained(causes) || run.is_time_over()) continue;
    for (Tried& c : try_all((run.*more)())) {
      sought.insert(c.name);
      causes.push_back(std::move(c));
    }
  }
  if (!is_plain && !run.is_time_over() && explains_little() && run.widen()) {
    if (other) other->widen();
    for (const auto again : {&Replay::plain, &Replay::deeper})
      for (Tried& c : try_all((run.*again)())) causes.push_back(std::move(c));
  }
  if (other && !run.is_time_over()) check_in(*other, causes, faults.emplace_back());
  std::vector<Tried> best = best_causes(causes);
  if (best.empty()) return {};
  const Names solved = solved_of(causes);
  const auto said = [&] { return std::vector<Cause>(best.begin(), best.end()); };
  if (run.is_time_over()) {
    // Untried faults may be as good.
    for (Tried& c : best) c.is_likely = false;
    return said();
  }
  static constexpr const char* as_much = "; or, which explains as much here, ";
  // Causes that leave clearly more unexplained, or that would break more, are rejected.
  const double least_against = [&] {
    double out = HUGE_VAL;
    for (const Tried& c : causes)
      if (c.name == best.front().name) out = std::min(out, against(c));
    return out;
  }();
  const auto is_rival = [&](const Tried& c) { return c.of_records || against(c) <= 1.4 * least_against + 1.5; };
  if (!best.front().is_likely) {
    // Causes that this run cannot distinguish are named together.
    Names same;
    for (const Tried& c : causes)
      if (c.of > 0 && score(c) >= score(best.front()) - 0.005 && is_rival(c) && c.name != best.front().name && !is_fitted(c))
        same.insert(c.name);
    // Those that also give the same values with other numbers are other names for the cause; of the rest, only those at least as plausible
    // are kept.
    const bool explains_most = score(best.front()) >= 1.8;
    const Names alike = explains_most ? compared(run, best.front(), same, solved).alike : Names();
    for (const Tried& c : causes)
      if (alike.contains(c.name) || far_fetched(c) > far_fetched(best.front())) same.erase(c.name);
    const std::string own = best.front().sentence;
    add_lines(run, other, best, causes, alike);
    say_one_of(best.front(), causes, alike);
    say_one_of(best.front(), causes, same, 2, as_much, own);
    return said();
  }
  Names others;
  const double least = score(best.front()) - (best.front().of_records ? 0 : 0.02);
  for (const Tried& c : causes)
    if (c.of > 0 && score(c) >= least && c.misfit <= 0.05 && is_rival(c) && c.name != best.front().name && !is_fitted(c))
      others.insert(c.name);
  const Compared there = compared(run, best.front(), others, solved);
  best.front().is_likely = !there.has_rival;
  // Among thousands of faults, one may come within an envelope by chance: a fault from a search must reproduce the port's bits.
  if (sought.contains(best.front().name) && best.front().explained * 10 < best.front().of * 9) best.front().is_likely = false;
  // A fitted number must fit all but a few exactly: near a wrong one, the port's bits are often met.
  if ((is_fitted(best.front()) || best.front().what.is_odd_number()) && best.front().explained * 50 < best.front().of * 49)
    best.front().is_likely = false;
  // Causes that could not be tested elsewhere are not reported as giving the same values.
  add_lines(run, other, best, causes, there.alike);
  if (best.front().is_likely)
    say_one_of(best.front(), causes, there.alike);
  else
    say_one_of(best.front(), causes, others, 2, as_much);
  return said();
}

std::optional<judge::ShaderLine> Replay::line(const FoundLine& found) const {
  if (!source_) return {};
  const auto number = [](const capture::SourceLine& l) { return static_cast<int>(l.line); };
  capture::SourceLine first = source_->line(found.at), last = source_->line(found.until);
  if (first.file == last.file && last.line < first.line) std::swap(first, last);
  if (first.file != last.file) last = first;
  judge::ShaderLine out{first.file, number(first), first.text, 0};
  if (last.line != first.line) out.until = number(last);
  return out.line == 0 ? std::nullopt : std::optional(out);
}

capture::PassCase varied(const capture::PackPass& pass, const capture::PassCase& c) {
  capture::PassCase out = c;
  const auto vary = [](std::byte* at, std::size_t k) {
    float v;
    std::memcpy(&v, at, 4);
    v = v == 0 ? 0.37f : v * (1 + 0.04f * static_cast<float>(1 + k * 7 % 6));
    std::memcpy(at, &v, 4);
  };
  std::size_t number = 0;
  for (const scene::Member& m : pass.block.members)
    for (int k = 0; m.scalar == scene::Scalar::float32 && k < m.components; ++k)
      vary(out.uniforms.data() + m.offset + 4 * static_cast<std::size_t>(k), number++);
  for (capture::CaseInput& in : out.inputs) {
    if (in.array.is_records) {
      std::vector<std::byte>& all = in.array.levels[0].edit();
      for (std::size_t r = 0; r + in.array.record.size <= all.size(); r += in.array.record.size)
        for (const scene::Member& m : in.array.record.members)
          for (int k = 0; m.scalar == scene::Scalar::float32 && !is_padding(m) && k < m.components; ++k)
            vary(all.data() + r + m.offset + 4 * static_cast<std::size_t>(k), number++);
      continue;
    }
    for (capture::Bytes& shared : in.array.levels) {
      std::vector<std::byte>& level = shared.edit();
      const std::size_t texels = level.size() / in.array.element_bytes(), by = texels / 3 + texels / 7;
      std::rotate(level.begin(), level.begin() + static_cast<std::ptrdiff_t>(by * in.array.element_bytes()), level.end());
    }
  }
  return out;
}

}  // namespace rainref::faults
