#include "faults/diagnose.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "faults/bits_replay.h"
#include "faults/decided.h"
#include "faults/list_replay.h"
#include "faults/texel_replay.h"
#include "faults/where.h"
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

/// What explains the lists of a run, one by one.
std::vector<Cause> causes_of_lists(const FailedRun& f) {
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
    for (Cause& c : diagnosed(run, other && other->fails() ? &*other : nullptr)) found.push_back(std::move(c));
  }
  return found;
}

/// What explains lists that are whole numbers' work, judged by bits in their order.
std::vector<Cause> causes_of_bits(const FailedRun& f) {
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
    for (Cause& c : diagnosed(run, other && other->fails() ? &*other : nullptr)) found.push_back(std::move(c));
  }
  return found;
}

std::vector<Cause> causes_of_texels(const FailedRun& f) {
  TexelReplay run = texels_of(f);
  std::optional<TexelReplay> other;
  if (f.other) other.emplace(texels_of(*f.other));
  if (std::optional<Cause> sure = decided(run, other ? &*other : nullptr)) return {std::move(*sure)};
  std::vector<Cause> best = diagnosed(run, other ? &*other : nullptr, f.is_warned);
  if (f.is_warned) return best;
  // What gives the very bits is a better word than a formula that could have given them.
  const bool is_exact = !best.empty() && best.front().is_likely && best.front().explained * 10 >= best.front().of * 9;
  if (is_exact) return best;
  if (std::optional<Cause> formula = run.alternative_formula(*f.options.profile)) {
    for (Cause& cause : best) cause.is_likely = false;
    best.insert(best.begin(), std::move(*formula));
    if (best.size() > 3) best.pop_back();
  }
  return best;
}

std::vector<Cause> causes_of(const FailedRun& failed) {
  const capture::PassCase& c = failed.run.c;
  if (!judge::keyed_outputs(c).empty()) {
    std::vector<Cause> causes = causes_of_lists(failed);
    if (!causes.empty() || !failed.bind || !judge::is_enveloped(c)) return causes;
  }
  return judge::is_enveloped(c) ? causes_of_texels(failed) : causes_of_bits(failed);
}

}  // namespace

judge::Explanation diagnose(const FailedRun& failed) {
  if (failed.is_warned) return {judge::is_enveloped(failed.run.c) ? causes_of_texels(failed) : std::vector<Cause>(), ""};
  judge::Explanation why{causes_of(failed), where_it_fails(failed)};
  if (std::optional<Cause> none = not_numbers(failed)) why.causes.push_back(*std::move(none));
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

int far_fetched(const Cause& c) {
  int parts = 0;
  for (std::size_t at = c.name.find("..."); at != std::string::npos; at = c.name.find("...", at + 3)) ++parts;
  if (c.of_records && (c.name.ends_with("without a record") || c.name.ends_with("not written"))) return 8;
  if (c.of_records && c.name.ends_with("one step late")) return 4;
  // A channel that is never written is as plain as what can be left out in few places.
  static constexpr std::string_view channel = " without its ";  // and its letter
  const bool is_channel =
      c.name.size() > channel.size() + 1 && c.name.compare(c.name.size() - channel.size() - 1, channel.size(), channel) == 0;
  if (!c.name.starts_with("input ") && is_channel) return -1;
  // Channels of a result that hold the same by chance.
  if (!c.name.starts_with("input ") && c.name.find(" with its ") != std::string::npos) return 3;
  // Where one of two channels is read, the other one in its place is plainer than both exchanged.
  if (c.name.ends_with("first two channels swapped")) return 1;
  // Half or twice a number is rather a term or factor of what it stands in; and where few records fail, 0 rather another number.
  if (c.name.ends_with(" halved") || c.name.ends_with(" doubled")) return 1 + (parts > 3);
  if (c.name.ends_with(" is zero") && c.of_records && c.of < 8) return 1;
  // Nobody takes a fraction, x - floor(x), the other way.
  if (c.name.starts_with("difference the other way") && c.name.find("- floor(") != std::string::npos) return 1;
  static constexpr std::pair<std::string_view, int> rare[] = {{"condition left out", -1},
                                                              {"condition never holds", -1},
                                                              {"not squared in a length", 2},
                                                              {"not squared", -2},
                                                              {"root left out", -2},
                                                              {"abs left out", -2},
                                                              {"fract left out", -2},
                                                              {"floor left out", -2},
                                                              {"clamp left out", -1},
                                                              {"held: ", 1},
                                                              {"decoded from sRGB", 1},
                                                              {"encoded as sRGB", 1},
                                                              {"to the power", 1},
                                                              {"tone mapped", 1},
                                                              {"unpacked by", 1},
                                                              {"packed by", 1},
                                                              {"less a half", 3},
                                                              {"divisor of the whole sum", 1},
                                                              {"taken for its root", 1},
                                                              {"taken as 1", 1},
                                                              {"exchanged between", 1},
                                                              {"without squares", 1},
                                                              {"factor of another", 1},
                                                              {"blended for", 1},
                                                              {"and a half", 2},
                                                              {"rounded to 8 bits: ", 2},
                                                              {"moved outward", 2},
                                                              {"moved inward", 1},
                                                              {"limit of ", 1},
                                                              {"function of", 1},
                                                              {"0 in ", 2},
                                                              {"1 in ", 2},
                                                              {"order of ", 1},
                                                              {"loop over ", 1},
                                                              {"normalize missing", -2},
                                                              {"difference the other way", -2},
                                                              {"atan2 arguments", -2},
                                                              {"wrong value", 2},
                                                              {"factor too many", 2},
                                                              {"term too many", 2},
                                                              {"precision", 2},
                                                              {"rounded", 3},
                                                              {"clamp too many", 2},
                                                              {"max too many", 3},
                                                              {"min too many", 3},
                                                              {"max for sum", 3},
                                                              {"min for sum", 3},
                                                              {"sum for max", 3},
                                                              {"sum for min", 3},
                                                              {"choice left out", 1},
                                                              {"value of before", 2},
                                                              {"equal weights", 0},
                                                              {"weights exchanged", 1},
                                                              {"value of after", 2},
                                                              {"exchanged: ", 1},
                                                              {"components exchanged", 1},
                                                              {"turned ", 2},
                                                              {"matrix ", 1},
                                                              {"matrix' other", 2},
                                                              {"another member", 1},
                                                              {"factor 2 pi", 1},
                                                              {"factor pi", 2},
                                                              {"degrees", 2},
                                                              {"radians", 2},
                                                              {"condition too many", 3},
                                                              {"another condition", 3},
                                                              {"branch left out", 1},
                                                              {"one constant for all", 1},
                                                              {"constants exchanged", 2},
                                                              {"sign of a product", 1},
                                                              {"grouped otherwise", 2},
                                                              {"of each part", 2},
                                                              {"another curve", 1},
                                                              {"another length", 1},
                                                              {"product for sum", 2},
                                                              {"sum for product", 2},
                                                              {"taken for another", 2},
                                                              {"held for wrapped", 1},
                                                              {"wrapped for held", 1},
                                                              {"ceiling for floor", 1},
                                                              {"factor of one side", 1},
                                                              {"division left out", 1},
                                                              {"complement left out: 1 - ", 0},
                                                              {"complement left out", 2},
                                                              {"twice as large", 1},
                                                              {"half as large", 1},
                                                              {"squared: ", 2},
                                                              {"root for square", 2},
                                                              {"the literal ", 2},
                                                              {"cube for square", 2},
                                                              {"min for max", 1},
                                                              {"max for min", 1},
                                                              {"quotient upside", 1},
                                                              {"multiplied for", 1},
                                                              {"divided for", 1},
                                                              {"another value of the literal", 3},
                                                              {"another value of", 4}};
  for (const auto& [start, weight] : rare)
    if (c.name.starts_with(start)) {
      // Of a number as it is, a condition is plain; of what is computed there is rather another reason.
      const bool is_plain = parts == 0 && c.name.find('(') == std::string::npos && c.name.find(" or ") == std::string::npos;
      // A pass has few places for these and many terms and factors: of what explains as much they are meant more often.
      if (weight < -1) return -1 + (parts > 3);
      return weight < 0 && !is_plain ? 1 : weight + (parts > 3);
    }
  return parts > 3;
}

std::vector<Cause> best_causes(std::vector<Tried> causes) {
  // A fault that explains some texels of many explains nothing; a wrong cause would be worse than none.
  std::erase_if(causes, [](const Cause& c) { return c.inside * 2 < c.of && c.explained * 4 < c.of; });
  if (causes.empty()) return {};
  // Bits count twice: what gives them is also near. Within 2 % of the best, causes explain as much as each other.
  const auto score = [](const Cause& c) {
    return static_cast<double>(c.explained + c.inside) / static_cast<double>(std::max<std::int64_t>(c.of, 1));
  };
  // A number can be fitted to much: it is believed only where no mistake that has a name comes near all of what fails.
  const auto is_full = [](const Tried& c) { return c.inside * 50 >= c.of * 49 && c.misfit <= 0.1; };
  if (std::any_of(causes.begin(), causes.end(), [&](const Tried& c) { return !is_fitted(c.name) && is_full(c); }))
    for (Tried& c : causes)
      if (is_fitted(c.name) && c.explained * 10 < c.of * 9) c.explained = c.inside = 0;
  // Of thousands that are tried some meet many of the port's very bits by chance: what is more far-fetched, solved for or fitted counts
  // no more of them than what is plainer and as near, unless they are nearly all.
  std::vector<int> how_far;
  std::vector<bool> is_sought;
  for (const Tried& c : causes) how_far.push_back(far_fetched(c)), is_sought.push_back(is_fitted(c.name) || is_solved(c.name));
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
  // A device whose arithmetic hardly ever gives the reference's bits meets them by chance.
  const double margin = most_bits < 0.5 ? 0.08 : 0.04;
  // Records are few, and no device blurs which of them are there: of these the better explains more.
  const auto explains_most = [&](const Cause& c) { return score(c) >= best - (c.of_records ? 0 : margin); };
  double least = 1;
  for (const Tried& c : causes)
    if (explains_most(c)) least = std::min(least, c.misfit);
  // A device may be the reason of some that are left; of what was sought or fitted, which chooses among thousands, none is a measure.
  const bool is_any_tested = std::any_of(causes.begin(), causes.end(), [&](const Tried& c) { return explains_most(c) && !c.is_untested; });
  double fewest = HUGE_VAL;
  for (const Tried& c : causes)
    if (explains_most(c) && !is_fitted(c.name) && !is_solved(c.name) && !c.is_untested) fewest = std::min(fewest, against(c));
  // An envelope may be wide enough for several; the one that is meant leaves hardly anything.
  const auto is_best = [&](const Tried& c) {
    return explains_most(c) && c.misfit <= 2 * least + 0.02 && !(c.is_untested && is_any_tested) &&
           (c.of_records || against(c) <= 1.4 * fewest + 1.5);
  };
  const auto rank = [&](const Tried& c) { return is_best(c) ? 3.0 : score(c); };
  // A number that is not set where it is a term and no more: rather the term is left out.
  std::set<std::string> terms;
  for (const Tried& c : causes)
    if (is_best(c) && c.name.starts_with("term left out: ")) terms.insert(c.name.substr(15, c.name.find_first_of(".,", 15) - 15));
  const auto far = [&](const Tried& c) {
    const bool is_zero = c.name.starts_with("uniform ") && c.name.ends_with(" is zero");
    return far_fetched(c) + (c.is_untested ? 3 : 0) + (is_zero && terms.contains(c.name.substr(8, c.name.size() - 16)) ? 1 : 0);
  };
  std::stable_sort(causes.begin(), causes.end(), [&](const Tried& a, const Tried& b) {
    if (rank(a) != rank(b)) return rank(a) > rank(b);
    return is_best(a) && is_best(b) && far(a) < far(b);
  });
  std::vector<Cause> out;
  for (const Tried& c : causes)
    if (score(c) > 0 && out.size() < 3 && std::none_of(out.begin(), out.end(), [&](const Cause& o) { return o.name == c.name; }))
      out.push_back(c);
  // Likely is one cause at most: the first, of those that say so of themselves, where enough fails that it is no chance. Of what
  // makes a whole part of a pass vanish dozens of mistakes are the cause as well as the first: its failures cannot tell.
  constexpr std::ptrdiff_t most_rivals = 20;
  const auto rivals = std::count_if(causes.begin(), causes.end(), [&](const Tried& c) {
    // The other two are other words for the same places.
    return is_best(c) && !is_solved(c.name) && !c.name.ends_with(", in all components") && !c.name.ends_with(", in each such place");
  });
  // Where a list is left as it was, whatever keeps a pass from doing anything is the cause as well.
  if (std::any_of(causes.begin(), causes.end(),
                  [](const Tried& c) { return c.of_records && c.name.ends_with("one step late") && c.inside == c.of; }))
    for (Cause& c : out) c.is_likely = false;
  for (Cause& c : out) c.is_likely &= &c == &out.front() && (c.of_records || (c.of >= 4 && rivals <= most_rivals));
  return out;
}

}  // namespace rainref::faults
