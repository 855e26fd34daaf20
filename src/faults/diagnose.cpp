#include "faults/diagnose.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "faults/bits_replay.h"
#include "faults/diagnosis.h"
#include "faults/list_replay.h"
#include "faults/texel_replay.h"
#include "faults/text.h"
#include "judge/evaluations.h"
#include "judge/judge.h"
#include "judge/keyed.h"

namespace rainref::faults {

using judge::Cause;
using judge::FailedRun;

namespace {

TexelReplay texels_of(const FailedRun& f) {
  return {f.pass, f.run.c, f.before, f.bind, *f.model, f.run.stored, f.judgement, *f.options.profile, f.half_mode, *f.options.executor};
}

/// Causes for the lists of a run, one list at a time.
std::vector<Cause> causes_of_lists(const FailedRun& f, const SearchLimit& limit) {
  std::vector<Cause> found;
  for (const std::size_t o : judge::keyed_outputs(f.run.c)) {
    const auto replay_of = [o](const FailedRun& r) {
      return ListReplay(r.pass, r.run.c, r.before, r.model, r.run.stored[o], o, *r.options.profile, *r.options.executor);
    };
    ListReplay run = replay_of(f);
    if (!run.fails()) continue;
    std::optional<ListReplay> other;
    if (std::optional<Cause> beyond = read_beyond_end(f, o)) {
      found.push_back(std::move(*beyond));
      continue;
    }
    if (f.other) other.emplace(replay_of(*f.other));
    if (f.list_program) {
      run.take(*f.list_program);
      if (other) other->take(*f.list_program);
    }
    run.limit(limit);
    if (other) other->limit(limit);
    std::vector<Cause> causes = diagnosed(run, other && other->fails() ? &*other : nullptr);
    if (causes.empty())
      if (std::optional<Cause> unknown = unknown_cause(run, true)) causes.push_back(*std::move(unknown));
    for (Cause& c : causes) found.push_back(std::move(c));
  }
  return found;
}

/// Causes for lists of integer passes, which are judged by bits in order.
std::vector<Cause> causes_of_bits(const FailedRun& f, const SearchLimit& limit) {
  std::vector<Cause> found;
  const capture::PassEvaluations* evaluations = judge::evaluations_of(f.run.c.effect, f.run.c.pass);
  if (!evaluations || !evaluations->recompute) return found;
  for (std::size_t o = 0; o < f.run.c.outputs.size(); ++o) {
    if (!f.run.c.outputs[o].array.is_records) continue;
    const auto replay_of = [&](const FailedRun& r) {
      return BitsReplay(r.pass, r.run.c, r.before, *evaluations, r.run.stored[o], o, *r.options.executor);
    };
    BitsReplay run = replay_of(f);
    if (!run.fails()) continue;
    if (std::optional<Cause> beyond = read_beyond_end(f, o)) {
      found.push_back(std::move(*beyond));
      continue;
    }
    std::optional<BitsReplay> other;
    if (f.other) other.emplace(replay_of(*f.other));
    run.limit(limit);
    if (other) other->limit(limit);
    for (Cause& c : diagnosed(run, other && other->fails() ? &*other : nullptr)) found.push_back(std::move(c));
  }
  return found;
}

/// A run and the next, with the port's own programs, and a search for their mistake.
struct TexelSearch {
  /// `judged`: f, or f.otherwise.
  TexelSearch(const FailedRun& f, const FailedRun& judged, const SearchLimit& limit) : run(texels_of(judged)) {
    if (judged.other) other.emplace(texels_of(*judged.other));
    const bool is_swapped = &judged.run != &f.run;
    const auto give = [](TexelReplay& to, const FailedRun& of) {
      if (of.program) to.take(*of.program);
    };
    give(run, is_swapped ? *f.other : f);
    if (other) give(*other, is_swapped ? f : *f.other);
    run.limit(limit);
    if (other) other->limit(limit);
    diagnosis.emplace(run, other && other->fails() ? &*other : nullptr);
  }
  TexelSearch(const TexelSearch&) = delete;
  TexelSearch& operator=(const TexelSearch&) = delete;

  TexelReplay run;
  std::optional<TexelReplay> other;
  std::optional<Diagnosis> diagnosis;
};

/// The causes after a search, or a formula that only allows what the port stored: a cause that reproduces the bits is better.
std::vector<Cause> causes_found(TexelSearch& search, const FailedRun& f, const SearchLimit& limit) {
  std::vector<Cause> best = search.diagnosis->causes();
  const bool is_exact = !best.empty() && best.front().is_likely && best.front().explained * 10 >= best.front().of * 9;
  if (is_exact || limit.is_over()) return best;
  if (std::optional<Cause> formula = search.run.alternative_formula(*f.options.profile)) {
    for (Cause& cause : best) cause.is_likely = false;
    best.insert(best.begin(), std::move(*formula));
    if (best.size() > 3) best.pop_back();
  }
  return best;
}

/// How good the causes of a search are: the score of the first, and whether it is likely.
std::pair<double, bool> worth(const std::vector<Cause>& causes) {
  return causes.empty() ? std::pair(-1.0, false) : std::pair(score(causes.front()), causes.front().is_likely);
}

std::vector<Cause> causes_of_texels(const FailedRun& f, const SearchLimit& limit, bool& is_otherwise) {
  TexelSearch search(f, f, limit);
  if (std::optional<Cause> sure = decided(search.run, search.other ? &*search.other : nullptr)) return {std::move(*sure)};
  search.diagnosis->search(f.is_warned);
  if (f.is_warned) return search.diagnosis->causes();
  std::vector<Cause> best = causes_found(search, f, limit);
  // A likely cause that gives nearly all bits tells the rounding too.
  const bool gives_bits = !best.empty() && best.front().is_likely && best.front().explained * 50 >= best.front().of * 49;
  if (f.otherwise && !gives_bits && !limit.is_over())
    if (TexelSearch second(f, *f.otherwise, limit); second.run.fails()) {
      second.diagnosis->search_among(*search.diagnosis, &f.run != &f.otherwise->run);
      if (std::vector<Cause> causes = causes_found(second, *f.otherwise, limit); worth(causes) > worth(best)) {
        is_otherwise = true;
        return causes;
      }
    }
  if (best.empty())
    if (std::optional<Cause> unknown = unknown_cause(search.run, false)) best.push_back(*std::move(unknown));
  return best;
}

std::vector<Cause> causes_of(const FailedRun& failed, const SearchLimit& limit, bool& is_otherwise) {
  const capture::PassCase& c = failed.run.c;
  if (!judge::keyed_outputs(c).empty()) {
    std::vector<Cause> causes = causes_of_lists(failed, limit);
    if (std::any_of(causes.begin(), causes.end(), std::mem_fn(&Cause::is_found)) || !failed.bind || !judge::is_enveloped(c)) return causes;
  }
  return judge::is_enveloped(c) ? causes_of_texels(failed, limit, is_otherwise) : causes_of_bits(failed, limit);
}

}  // namespace

void keep_found(std::vector<Cause>& causes) {
  if (std::any_of(causes.begin(), causes.end(), std::mem_fn(&Cause::is_found)))
    std::erase_if(causes, std::not_fn(std::mem_fn(&Cause::is_found)));
}

judge::Explanation diagnose(const FailedRun& failed) { return diagnose_within(SearchLimit(0), failed); }
judge::Explanation diagnose_within(const SearchLimit& limit, const FailedRun& failed) {
  judge::Explanation why;
  if (failed.is_warned) {
    if (judge::is_enveloped(failed.run.c)) why.causes = causes_of_texels(failed, limit, why.is_otherwise);
    return why;
  }
  why.causes = causes_of(failed, limit, why.is_otherwise);
  why.where = where_it_fails(failed);
  if (std::optional<Cause> none = not_numbers(failed)) why.causes.push_back(*std::move(none));
  keep_found(why.causes);
  return why;
}

std::vector<Cause> diagnose_lists(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before,
                                  const capture::PassModel* model, const std::vector<capture::Array>& port,
                                  const enclosed::Profile& profile, const parallel::Executor& executor) {
  std::vector<Cause> found;
  for (const std::size_t o : judge::keyed_outputs(c)) {
    ListReplay run(pass, c, before, model, port[o], o, profile, executor);
    if (!run.fails()) continue;
    for (Cause& cause : diagnosed(run, nullptr)) found.push_back(std::move(cause));
  }
  return found;
}

int far_fetched(const Tried& c) {
  const What& what = c.what;
  if (c.of_records && what.is(trait::lost | trait::empty)) return 8;
  if (c.of_records && what.is(trait::late)) return 4;
  if (what.is(trait::symptom)) return 1;
  // If few records fail, 0 is more likely a wrong number.
  constexpr std::int64_t few = 8;
  if (what.is(trait::unset) && c.of_records && c.of < few) return 1;
  const int weight = weight_of(what), much_left_out = gaps_in_name(what) > 3;
  if (what.is(trait::bare)) return weight;
  // A pass has few places for these kinds and many terms and factors, so they are more often meant if causes explain as much.
  if (weight < -1) return -1 + much_left_out;
  // For a plain number, a condition is plausible; for a computed value, another reason is more likely.
  return weight < 0 && !names_plain_numbers(what) ? 1 : weight + much_left_out;
}

std::vector<Tried> best_causes(std::vector<Tried> causes) {
  // A fault that explains some of many texels explains nothing; a wrong cause is worse than none.
  std::erase_if(causes, [](const Cause& c) { return c.inside * 2 < c.of && c.explained * 4 < c.of; });
  if (causes.empty()) return {};
  // Bits count twice, because they are also near. Causes within 2 % of the best explain equally much.
  // A number can be fitted to many failures: it is accepted only if no named mistake comes near all of them.
  const auto is_full = [](const Tried& c) { return c.inside * 50 >= c.of * 49 && c.misfit <= 0.1; };
  if (std::any_of(causes.begin(), causes.end(), [&](const Tried& c) { return !is_fitted(c) && is_full(c); }))
    for (Tried& c : causes)
      if (is_fitted(c) && c.explained * 10 < c.of * 9) c.explained = c.inside = 0;
  // Among thousands of faults, some match many of the port's bits by chance. Bits of a less plausible, solved or fitted fault count only as
  // much as those of a plainer one that is as near, unless it matches nearly all.
  std::vector<int> how_far;
  std::vector<bool> is_sought;
  for (const Tried& c : causes) how_far.push_back(far_fetched(c)), is_sought.push_back(is_fitted(c) || is_solved(c));
  std::vector<std::int64_t> most(causes.size(), -1);
  for (std::size_t k = 0; k < causes.size(); ++k) {
    const Tried& c = causes[k];
    if (c.explained * 10 >= c.inside * 9) continue;
    for (std::size_t o = 0; o < causes.size(); ++o) {
      const Tried& other = causes[o];
      const bool is_plainer = !is_sought[o] && how_far[o] <= how_far[k] - (is_sought[k] ? 0 : 1);
      if (is_plainer && other.inside * 100 >= c.inside * 98 && other.misfit <= 2 * c.misfit + 0.05)
        most[k] = std::max(most[k], other.explained);
    }
  }
  for (std::size_t k = 0; k < causes.size(); ++k)
    if (most[k] >= 0) causes[k].explained = std::min(causes[k].explained, most[k]);
  double best = 0, most_bits = 0;
  for (const Cause& c : causes) {
    best = std::max(best, score(c));
    most_bits = std::max(most_bits, static_cast<double>(c.explained) / static_cast<double>(std::max<std::int64_t>(c.of, 1)));
  }
  // A device whose arithmetic rarely gives the reference's bits matches them by chance.
  const double margin = most_bits < 0.5 ? 0.08 : 0.04;
  // Records are few, and rounding does not change which of them exist: here the better cause explains more.
  const auto explains_most = [&](const Cause& c) { return score(c) >= best - (c.of_records ? 0 : margin); };
  double least = 1;
  for (const Tried& c : causes)
    if (explains_most(c)) least = std::min(least, c.misfit);
  // A device may cause some of the remaining failures. Solved or fitted faults are chosen from thousands, so they set no standard.
  const bool is_any_tested = std::any_of(causes.begin(), causes.end(), [&](const Tried& c) { return explains_most(c) && !c.is_untested; });
  double fewest = HUGE_VAL;
  for (const Tried& c : causes)
    if (explains_most(c) && !is_fitted(c) && !is_solved(c) && !c.is_untested) fewest = std::min(fewest, against(c));
  // An envelope may be wide enough for several causes; the right one leaves hardly any failures.
  const auto is_best = [&](const Tried& c) {
    return explains_most(c) && c.misfit <= 2 * least + 0.02 && !(c.is_untested && is_any_tested) &&
           (c.of_records || against(c) <= 1.4 * fewest + 1.5);
  };
  const auto rank = [&](const Tried& c) { return is_best(c) ? 3.0 : score(c); };
  // If an unset number is only a term, then "term left out" is preferred.
  std::set<std::string> terms;
  for (const Tried& c : causes)
    if (is_best(c) && c.what.kind == Kind::term_left_out) terms.insert(first_name(c.what.of[1]));
  const auto far = [&](const Tried& c) {
    const bool is_left_out = c.what.kind == Kind::uniform_is_zero && terms.contains(c.what.of[0]);
    return far_fetched(c) + (c.is_untested ? 3 : 0) + (is_left_out ? 1 : 0);
  };
  std::stable_sort(causes.begin(), causes.end(), [&](const Tried& a, const Tried& b) {
    if (rank(a) != rank(b)) return rank(a) > rank(b);
    return is_best(a) && is_best(b) && far(a) < far(b);
  });
  // A mistake in all components of a vector is the plainer one, if it explains as much as the same in one of them.
  const auto is_whole_vector = [&](const Tried& c) {
    const Tried& first = causes.front();
    return c.what.kind == first.what.kind && c.what.of == first.what.of && is_best(c) && c.explained >= first.explained &&
           c.inside >= first.inside && (c.what.reach == Reach::both || c.what.reach == Reach::all);
  };
  if (causes.front().what.reach == Reach::one)
    if (const auto vector = std::find_if(causes.begin(), causes.end(), is_whole_vector); vector != causes.end())
      std::rotate(causes.begin(), vector, std::next(vector));
  std::vector<Tried> out;
  for (const Tried& c : causes)
    if (score(c) > 0 && out.size() < 3 && std::none_of(out.begin(), out.end(), [&](const Tried& o) { return o.name == c.name; }))
      out.push_back(c);
  // What a list lacks is said beside the reasons, as far as it explains as much.
  const auto is_symptom = [](const Tried& c) { return c.what.is(trait::symptom); };
  const auto symptom = std::find_if(causes.begin(), causes.end(), [&](const Tried& c) { return is_symptom(c) && is_best(c); });
  if (symptom != causes.end() && out.size() == 3 && std::none_of(out.begin(), out.end(), is_symptom)) out.back() = *symptom;
  // At most one cause is likely: the first of those marked so, if enough fails that it is not chance. If a whole part of a pass vanishes,
  // dozens of mistakes explain it equally well: its failures cannot distinguish them.
  constexpr std::ptrdiff_t most_rivals = 20;
  const auto rivals = std::count_if(causes.begin(), causes.end(), [&](const Tried& c) {
    // These two are other descriptions of the same places.
    return is_best(c) && !is_solved(c) && !c.what.is_of_all_components() && !c.what.is_of_each_place();
  });
  // If a list is unchanged, anything that prevents the pass from working is an equally good cause.
  if (std::any_of(causes.begin(), causes.end(), [](const Tried& c) { return c.of_records && c.what.is(trait::late) && c.inside == c.of; }))
    for (Tried& c : out) c.is_likely = false;
  // An empty list is a symptom, not a cause, and so is a record that the pass left as it was.
  for (Tried& c : out) c.is_likely &= !(c.of_records && c.what.is(trait::empty | trait::symptom));
  for (Tried& c : out) c.is_likely &= &c == &out.front() && (c.of_records || (c.of >= 4 && rivals <= most_rivals));
  return out;
}

}  // namespace rainref::faults
