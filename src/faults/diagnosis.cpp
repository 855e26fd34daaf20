#include "faults/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "faults/diagnose.h"

namespace rainref::faults {
namespace {

using judge::Cause;

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

/// The faults of another run that are those of the causes that explain something.
std::vector<Fault> faults_in(Replay& other, const std::vector<Tried>& causes) {
  Names names;
  bool is_any_fitted = false;
  double best = 0;
  for (const Tried& c : causes) best = std::max(best, score(c));
  for (const Tried& c : causes) {
    // A cause that explains far less than the best here is not tried there.
    if ((c.inside * 2 < c.of && c.explained * 4 < c.of) || score(c) < 0.6 * best) continue;
    names.insert(c.name);
    is_any_fitted |= is_fitted(c);
  }
  if (names.empty()) return {};
  std::vector<Fault> all = named(other, names, solved_of(causes));
  if (is_any_fitted)
    for (Fault& d : other.fitted())
      if (names.contains(name_of(d))) all.push_back(std::move(d));
  return all;
}
/// Adds how well causes explain another run, whose faults are `all`.
void check_in(const Replay& other, std::vector<Tried>& causes, const std::vector<Fault>& all) {
  if (all.empty()) return;
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

/// Adds causes with equal values everywhere to the first one's text, in order of plausibility: the port has one of them. Returns their
/// names.
Names say_one_of(Tried& first, std::vector<Tried> causes, Names others, int most = 2, const char* word = "; or, which gives the same, ",
                 std::string own = "") {
  std::stable_sort(causes.begin(), causes.end(), [](const Tried& a, const Tried& b) { return far_fetched(a) < far_fetched(b); });
  Names said;
  if (own.empty()) own = first.sentence;
  Names heads{head_of(first.what)};
  for (const bool is_new_sort : {true, false})
    for (const Tried& c : causes) {
      if (std::ssize(said) >= most || c.sentence == own || !others.contains(c.name) ||
          (is_new_sort && !heads.insert(head_of(c.what)).second))
        continue;
      others.erase(c.name);
      first.sentence += (said.empty() ? word : "; or ") + c.sentence;
      said.insert(c.name);
    }
  return said;
}

}  // namespace

void Diagnosis::try_all(std::vector<Fault> all, bool is_sought) {
  faults_.push_back(std::move(all));
  for (Tried& c : run_.causes(faults_.back())) {
    if (is_sought) sought_.insert(c.name);
    causes_.push_back(std::move(c));
  }
}

void Diagnosis::search(bool is_plain) {
  try_all(run_.plain(), false);
  // If plain faults explain nearly all failures, less plain ones are not tried.
  for (const auto more : {&Replay::deeper, &Replay::solved, &Replay::fitted})
    if (!is_plain && !is_explained(causes_) && !run_.is_time_over()) try_all((run_.*more)(), true);
  const auto explains_little = [&] { return std::none_of(causes_.begin(), causes_.end(), [](const Tried& c) { return score(c) >= 1.5; }); };
  if (!is_plain && !run_.is_time_over() && explains_little() && run_.widen()) {
    is_wide_ = true;
    if (other_) other_->widen();
    try_all(run_.plain(), false);
  }
  for (const Tried& c : causes_)
    if (c.fault && (c.inside * 8 >= c.of || c.explained * 8 >= c.of)) promising_[sought_.contains(c.name)].push_back(c.fault);
  if (!other_ || run_.is_time_over()) return;
  faults_in_other_ = faults_in(*other_, causes_);
  check_in(*other_, causes_, faults_in_other_);
}

void Diagnosis::search_among(const Diagnosis& first, bool is_swapped) {
  if (first.is_wide_) {
    run_.widen();
    if (other_) other_->widen();
  }
  const Names solved = solved_of(first.causes_);
  for (const bool is_sought : {false, true}) {
    if (is_explained(causes_)) break;
    std::vector<Fault> all;
    Names names;
    for (const Fault* d : first.promising_[is_sought]) {
      names.insert(name_of(*d));
      if (!is_swapped) all.push_back(*d);
    }
    if (is_swapped && !names.empty()) all = named(run_, names, solved);
    try_all(std::move(all), is_sought);
  }
  if (!other_ || run_.is_time_over()) return;
  faults_in_other_ = is_swapped ? faults_in(*other_, causes_) : first.faults_in_other_;
  check_in(*other_, causes_, faults_in_other_);
}

std::vector<Cause> Diagnosis::causes() {
  std::vector<Tried> best = best_causes(causes_);
  if (best.empty()) return {};
  const Names solved = solved_of(causes_);
  const auto said = [&] { return std::vector<Cause>(best.begin(), best.end()); };
  if (run_.is_time_over()) {
    // Untried faults may be as good.
    for (Tried& c : best) c.is_likely = false;
    return said();
  }
  static constexpr const char* as_much = "; or, which explains as much here, ";
  // Causes that leave clearly more unexplained, or that would break more, are rejected.
  const double least_against = [&] {
    double out = HUGE_VAL;
    for (const Tried& c : causes_)
      if (c.name == best.front().name) out = std::min(out, against(c));
    return out;
  }();
  const auto is_rival = [&](const Tried& c) { return c.of_records || against(c) <= 1.4 * least_against + 1.5; };
  if (!best.front().is_likely) {
    // Causes that this run cannot distinguish are named together.
    Names same;
    for (const Tried& c : causes_)
      if (c.of > 0 && score(c) >= score(best.front()) - 0.005 && is_rival(c) && c.name != best.front().name && !is_fitted(c))
        same.insert(c.name);
    // Those that also give the same values with other numbers are other names for the cause; of the rest, only those at least as plausible
    // are kept.
    const bool explains_most = score(best.front()) >= 1.8;
    const Names alike = explains_most ? compared(run_, best.front(), same, solved).alike : Names();
    for (const Tried& c : causes_)
      if (alike.contains(c.name) || far_fetched(c) > far_fetched(best.front())) same.erase(c.name);
    const std::string own = best.front().sentence;
    add_lines(run_, other_, best, causes_, alike);
    say_one_of(best.front(), causes_, alike);
    say_one_of(best.front(), causes_, same, 2, as_much, own);
    return said();
  }
  Names others;
  const double least = score(best.front()) - (best.front().of_records ? 0 : 0.02);
  for (const Tried& c : causes_)
    if (c.of > 0 && score(c) >= least && c.misfit <= 0.05 && is_rival(c) && c.name != best.front().name && !is_fitted(c))
      others.insert(c.name);
  const Compared there = compared(run_, best.front(), others, solved);
  best.front().is_likely = !there.has_rival;
  // Among thousands of faults, one may come within an envelope by chance: a fault from a search must reproduce the port's bits.
  if (sought_.contains(best.front().name) && best.front().explained * 10 < best.front().of * 9) best.front().is_likely = false;
  // A fitted number must fit all but a few exactly: near a wrong one, the port's bits are often met.
  if ((is_fitted(best.front()) || best.front().what.is_odd_number()) && best.front().explained * 50 < best.front().of * 49)
    best.front().is_likely = false;
  // Causes that could not be tested elsewhere are not reported as giving the same values.
  add_lines(run_, other_, best, causes_, there.alike);
  if (best.front().is_likely) {
    const Names named = say_one_of(best.front(), causes_, there.alike);
    for (Tried& c : best) c.repeats_first = named.contains(c.name);
  } else {
    say_one_of(best.front(), causes_, others, 2, as_much);
  }
  return said();
}

std::vector<Cause> diagnosed(Replay& run, Replay* other) {
  Diagnosis all(run, other);
  all.search();
  return all.causes();
}

}  // namespace rainref::faults
