// Finds the expression at a place of the text from the number that the place would need to have.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/number_text.h"
#include "faults/generators.h"
#include "faults/place_faults.h"
#include "faults/solver.h"
#include "faults/targets.h"
#include "faults/text.h"

namespace rainref::faults {
namespace {

using perturbed::Change;
using perturbed::Op;
using perturbed::Put;
using perturbed::Substitution;
using Node = perturbed::Trace::Node;

constexpr std::size_t most_found = 160;

constexpr std::array<Change, 16> changes{Change::none,     Change::negated,   Change::from_one, Change::magnitude,
                                         Change::squared,  Change::rooted,    Change::inverted, Change::doubled,
                                         Change::halved,   Change::floored,   Change::rounded,  Change::truncated,
                                         Change::fraction, Change::saturated, Change::cubed,    Change::smoothed};
/// Number of editing steps of a change.
int effort_of(Change change) { return change == Change::none ? 0 : change == Change::negated || change == Change::from_one ? 1 : 2; }

/// Numbers that may be written for v by mistake.
std::vector<float> other_numbers(float v) {
  std::vector<float> out{-v, 2 * v, v / 2, 10 * v, v / 10, v + 1, v - 1, v * v, 1 / v, 1 - v, 0.25f, 0.5f, 0.75f, 1.5f, 2.5f};
  for (int k = 0; k <= 12; ++k) out.push_back(static_cast<float>(k));
  std::erase_if(out, [&](float other) { return other == v || !std::isfinite(other); });
  return out;
}

/// What was found, each with its effort: how many editing steps lead to it.
using Found = std::vector<std::pair<int, Fault>>;
void sort_by_effort(Found& found) {
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
}

class Search {
 public:
  Search(const Probed& p, const std::vector<Solvable>& texels, const std::vector<float>& known, const Workers& workers)
      : p_(p), workers_(workers), texels_(texels), first_(texels[0].probe), known_(std::make_shared<const std::vector<float>>(known)) {
    for (const Solvable& t : texels) solvers_.emplace_back(t, *known_);
    for (const std::size_t n : {1u, 2u, 3u}) numbers_[n] = numbers_of(p, n);
    most_verified_ = std::clamp<std::size_t>(most_steps / 1000 / std::max<std::size_t>(first_.trace.nodes.size(), 1), 60, 400);
    groups_ = vectors_in(first_);
    // Threads read the texts that a probe caches.
    for (std::int32_t at = 0; at < std::ssize(first_.trace.nodes); ++at) static_cast<void>(words_for(first_, at));
  }
  void run(std::vector<Fault>& out) {
    const std::vector<Target> targets = targets_of(first_);
    std::vector<std::vector<Solution>> solved(targets.size());
    each(targets.size(), [&](std::size_t k, Found& found) {
      const Target& t = targets[k];
      std::vector<float> now;
      for (std::size_t c = 0; c < t.nodes.size(); ++c) now.push_back(t.now(first_, c));
      solved[k] = solvers_[0].solutions(t.places(first_), now);
      for (const Solution& s : solved[k]) other_values(t, s, found);
    });
    other_taps();
    if (found_.empty()) slot_by_slot();
    if (found_.empty()) everywhere();
    each(targets.size(), [&](std::size_t k, Found& found) {
      for (const Solution& s : solved[k]) number(targets[k], s, found);
    });
    sort_by_effort(found_);
    for (std::size_t k = 0; k < std::min(found_.size(), most_found); ++k) out.push_back(std::move(found_[k].second));
  }

 private:
  /// Calls body(k, found) for k in [0, count), in parallel; what is found stands in the order of k.
  template <class Body>
  void each(std::size_t count, const Body& body) {
    std::vector<Found> found(count);
    workers_.executor.for_range(static_cast<std::int64_t>(count), 1, [&](std::int64_t begin, std::int64_t end) {
      for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
        if (!workers_.is_time_over()) body(k, found[k]);
    });
    for (Found& one : found) std::move(one.begin(), one.end(), std::back_inserter(found_));
  }
  /// A mistake that is kept if it suits.
  struct Candidate {
    int effort;
    std::vector<Substitution> places;
    What what;
  };
  void keep_suitable(const std::vector<Candidate>& all) {
    each(all.size(), [&](std::size_t k, Found& found) {
      if (suits(all[k].places)) keep(all[k].effort, all[k].places, all[k].what, found);
    });
  }

  /// True if it gives the stored values at these texels, except at one in eight, where a mistake may change the path through the pass.
  bool suits(const std::vector<Substitution>& places) const {
    std::size_t misses = 0;
    for (const Solver& at : solvers_)
      if (!at.is_near(places) && ++misses * 8 > solvers_.size()) return false;
    return true;
  }
  void keep(int effort, std::vector<Substitution> places, What what, Found& found) const {
    if (gaps_in_name(what) > 0) effort += 2;  // an expression that cannot be written in full is less likely
    if (places.size() > 1) what.reach = places.size() > 2 ? Reach::all : Reach::both;
    Fault d(std::move(what));
    d.substitutions = std::move(places);
    tell_places_by(d, known_);
    found.emplace_back(effort, std::move(d));
  }

  void other_values(const Target& t, const Solution& solution, Found& found) const {
    std::vector<Substitution> places = t.places(first_);
    const std::size_t n = t.nodes.size();
    const std::vector<std::int32_t> meant = t.values(first_);
    std::vector<float> now, numbers(n);
    for (std::size_t c = 0; c < n; ++c) now.push_back(t.now(first_, c));
    std::array<std::size_t, 2> verified{};  // values, numbers
    const std::string right = words_for(first_, meant[0]);
    std::set<std::pair<std::string, Change>> done;
    for (const Source& s : sources_for(first_, t, groups_, numbers_.at(n))) {
      // Changes of the intended value itself have plainer names.
      if (s.text == "..." || s.nodes == meant) continue;
      const bool is_number = s.nodes.empty(), is_later = !is_number && s.nodes[0] > t.nodes[0];
      for (const Change change : changes) {
        if (change != Change::none && (is_later || (is_number && s.effort > 0))) continue;
        bool is_same = true, is_trivial = !is_number;
        for (std::size_t c = 0; c < n; ++c) {
          numbers[c] = perturbed::changed(number_of(first_, s, c), change);
          // A factor or term of 0 or 1 removes a term or leaves it unchanged: that has plainer names.
          is_trivial &= numbers[c] == 0 || numbers[c] == 1 || numbers[c] == -1;
          is_same &= numbers[c] == now[c];
        }
        if (is_same || is_trivial || verified[is_number] >= most_verified_ || !solvers_[0].may_be(solution, numbers)) continue;
        const std::string wrong = changed_text(change, s.text);
        if (wrong == right || done.contains({s.text, change})) continue;
        take(first_, s, t, places);
        for (Substitution& place : places) place.change = change;
        ++verified[is_number];
        if (!suits(places)) continue;
        done.insert({s.text, change});
        keep(s.effort + effort_of(change), places, wrong_value(t, wrong), found);
      }
    }
  }
  What wrong_value(const Target& t, const std::string& wrong) const {
    const std::string right = words_for(first_, t.value_at(first_, 0));
    return {Kind::wrong_value, {t.operand < 0 ? "for " + right : "in " + words_for(first_, t.nodes[0]), wrong, right}};
  }

  /// If two or three slots fail whose places have different shapes, as in a rotation (-y, x): solves each slot separately, and keeps texts
  /// that agree up to the component.
  void slot_by_slot() {
    const std::vector<float> right = solvers_[0].values({});
    std::vector<std::size_t> failing;
    for (std::size_t k = 0; k < right.size(); ++k)
      if (!(std::abs(static_cast<double>(right[k]) - texels_[0].port[k]) <= texels_[0].leeway[k])) failing.push_back(k);
    if (failing.size() < 2 || failing.size() > 3) return;
    std::vector<Found> of_slots;
    for (const std::size_t slot : failing) {
      std::vector<Solvable> alone = texels_;
      for (Solvable& t : alone)
        for (const std::size_t other : failing)
          if (other != slot) t.leeway[other] = HUGE_VAL;
      Search search(p_, alone, *known_, workers_);
      const std::vector<Target> targets = targets_of(first_);
      search.each(targets.size(), [&](std::size_t k, Found& found) {
        const Target& t = targets[k];
        if (t.nodes.size() > 1) return;
        for (const Solution& s : search.solvers_[0].solutions(t.places(first_), {t.now(first_, 0)})) search.other_values(t, s, found);
      });
      sort_by_effort(search.found_);
      constexpr std::size_t most = 80;
      if (search.found_.size() > most) search.found_.erase(search.found_.begin() + most, search.found_.end());
      of_slots.push_back(std::move(search.found_));
    }
    for (const auto& [effort, one] : of_slots[0]) {
      std::vector<Substitution> places = one.substitutions;
      for (std::size_t k = 1; k < of_slots.size(); ++k) {
        const auto like = std::find_if(of_slots[k].begin(), of_slots[k].end(), [&, &effort = effort, &one = one](const auto& other) {
          return other.first == effort && of_any_axis(name_of(other.second)) == of_any_axis(name_of(one));
        });
        if (like == of_slots[k].end()) break;
        places.push_back(like->second.substitutions[0]);
      }
      if (places.size() == of_slots.size() && suits(places)) keep(effort, places, one, found_);
    }
  }

  /// If numbers cannot be solved for, at places met repeatedly or with decisions: tries each nearby value.
  void everywhere() {
    std::vector<Target> all;
    std::set<std::uint32_t> done;
    const auto add = [&](const std::vector<std::int32_t>& nodes) {
      const Node& n = node_of(first_, nodes[0]);
      if (is_leaf(n.op)) return;
      if (n.op != Op::lookup)
        for (std::int8_t k = 0; k < (n.op == Op::choice ? 2 : 4); ++k)
          if (n.of[static_cast<std::size_t>(k)] >= 0) all.push_back({nodes, k});
      if (n.op != Op::comparison) all.push_back({nodes, Substitution::result});
    };
    for (const std::vector<std::size_t>& v : vector_values_of(first_)) add({v.begin(), v.end()});
    for (std::int32_t at = static_cast<std::int32_t>(first_.trace.nodes.size()); at-- > 0;)
      if (done.insert(node_of(first_, at).shape).second && node_of(first_, at).occurrence >= 0) add({first_of(at)});
    const std::size_t nodes = std::max<std::size_t>(first_.trace.nodes.size(), 1);
    std::size_t left = std::min<std::size_t>(60000, most_steps / nodes);
    // Step-like operations may change only some texels, so several are tested; only one in long passes.
    const std::size_t most_asked = nodes > 1000 ? 1 : 4;
    std::vector<std::vector<float>> right;
    for (std::size_t k = 0; k < std::min(most_asked, solvers_.size()); ++k) right.push_back(solvers_[k].values({}));
    std::vector<char> counts(all.size());
    each(all.size(), [&](std::size_t k, Found&) {
      std::vector<Substitution> places = places_everywhere(all[k]);
      for (std::size_t asked = 0; asked < right.size() && !counts[k]; ++asked)
        for (const float number : {0.11f, -7.0f, 1.3f}) {
          for (Substitution& place : places) place.how = Put::plus, place.number = number;
          counts[k] = counts[k] || moves_all_that_fails(texels_[asked], right[asked], solvers_[asked].values(places));
        }
    });
    std::vector<Candidate> candidates;
    for (std::size_t k = 0; k < all.size() && left > 0; ++k)
      if (counts[k]) add_candidates(all[k], left, candidates);
    keep_suitable(candidates);
  }
  std::vector<Substitution> places_everywhere(const Target& t) const {
    std::vector<Substitution> places = t.places(first_);
    for (Substitution& place : places) place.occurrence = -1;
    return places;
  }
  /// At most `left`, which then is how many more may be added.
  void add_candidates(const Target& t, std::size_t& left, std::vector<Candidate>& out) const {
    std::vector<Substitution> places = places_everywhere(t);
    const std::int32_t value = t.value_at(first_, 0);
    const std::string own = words_for(first_, value);
    const auto add = [&](int effort, What what) {
      if (left == 0) return;
      --left;
      out.push_back({effort, places, std::move(what)});
    };
    for (const Source& s : numbers_.at(t.nodes.size())) {
      if (s.effort > 0 || s.text == own) continue;
      take(first_, s, t, places);
      add(s.effort, wrong_value(t, s.text));
    }
    // Another literal or uniform only there.
    if (value >= 0 && node_of(first_, value).op == Op::constant)
      for (const float number : other_numbers(node_of(first_, value).value)) {
        for (Substitution& place : places) place.back = 0, place.ahead = -1, place.number = number;
        add(6, {Kind::another_value_there, {words_for(first_, t.nodes[0]), own, fmt::format("{:.6g}", number)}});
      }
    std::size_t tried = 0;
    for (const Source& s : sources_for(first_, t, groups_, {})) {
      if (left < 2 || ++tried > 200) break;
      if (s.text == "..." || s.text == own || (value >= 0 && !s.nodes.empty() && s.nodes[0] == value)) continue;
      take(first_, s, t, places);
      for (const Change change : {Change::none, Change::smoothed}) {
        if (change == Change::smoothed && tried > 30) break;
        for (Substitution& place : places) place.change = change;
        add(s.effort, wrong_value(t, changed_text(change, s.text)));
      }
    }
  }
  /// True if a mistake changes every slot in which a port differs.
  static bool moves_all_that_fails(const Solvable& at, const std::vector<float>& right, const std::vector<float>& made) {
    if (right.size() != at.port.size() || made.size() != at.port.size()) return false;
    bool is_any = false;
    for (std::size_t k = 0; k < right.size(); ++k) {
      if (std::abs(static_cast<double>(right[k]) - at.port[k]) <= at.leeway[k]) continue;
      if (made[k] == right[k]) return false;
      is_any = true;
    }
    return is_any;
  }
  /// Replaces the column or row of one texel by another texel's.
  void other_taps() {
    constexpr std::size_t most = 24;
    std::size_t left = std::min<std::size_t>(2000, most_steps / std::max<std::size_t>(first_.trace.nodes.size(), 1));
    std::vector<Candidate> candidates;
    std::vector<std::int32_t> taps;
    for (std::int32_t at = 0; at < static_cast<std::int32_t>(first_.trace.nodes.size()) && taps.size() < most; ++at)
      if (node_of(first_, at).op == Op::coordinate && first_.trace.met.at(node_of(first_, at).shape) <= 12) taps.push_back(at);
    for (const std::int32_t to : taps) {
      const Target t{{to}, 0};
      // Equal positions here may differ at another texel, so nodes are distinguished, not values.
      std::set<std::int32_t> asked{t.value_at(first_, 0)};
      for (const std::int32_t from : taps) {
        const std::int32_t value = node_of(first_, from).of[0];
        if (left == 0 || value < 0 || !asked.insert(value).second) continue;
        const Source s{{value}, {}, words_for(first_, value), 1};
        std::vector<Substitution> places = t.places(first_);
        take(first_, s, t, places);
        --left;
        candidates.push_back({s.effort, places, {Kind::wrong_column_or_row, {"", s.text, words_for(first_, t.value_at(first_, 0))}}});
      }
    }
    keep_suitable(candidates);
  }
  /// The first place with a node's shape.
  std::int32_t first_of(std::int32_t node) const {
    std::int32_t at = 0;
    while (node_of(first_, at).shape != node_of(first_, node).shape) ++at;
    return at;
  }

  /// Replaces the operand by a number, or adds a number as a factor or term if the operand is not one.
  void number(const Target& t, const Solution& solution, Found& found) const {
    const std::int32_t value = t.value_at(first_, 0);
    const bool is_constant = value >= 0 && node_of(first_, value).op == Op::constant;
    const std::size_t n = t.nodes.size();
    std::vector<Substitution> places = t.places(first_);
    for (const Put how : {Put::instead, Put::times, Put::plus}) {
      const float now = t.now(first_, 0);
      const double at = solution.at[0];
      if (how == Put::instead && n > 1) continue;
      if (is_constant && how != Put::instead) continue;
      const auto number = static_cast<float>(how == Put::instead ? at : how == Put::times ? at / now : at - now);
      if (!std::isfinite(number)) continue;
      for (Substitution& place : places) place.how = how, place.number = number, place.back = 0, place.change = Change::none;
      if (!suits(places)) continue;
      for (int digits = 1; digits < 6; ++digits) {
        std::vector<Substitution> rounded = places;
        const float nice = number_from<float>(fmt::format("{:.{}g}", number, digits)).value_or(number);
        for (Substitution& place : rounded) place.number = nice;
        if (suits(rounded)) {
          places = rounded;
          break;
        }
      }
      const std::string right = words_for(first_, value), where = words_for(first_, t.nodes[0]);
      const Kind kind = how == Put::instead ? Kind::another_value_about : how == Put::times ? Kind::another_share : Kind::another_summand;
      keep(20, places, {kind, {where, right, fmt::format("{:.5g}", places[0].number)}}, found);
    }
  }

  std::size_t most_verified_ = 60;  ///< candidates of a target that fit the first texel; more for a short pass
  const Probed& p_;
  const Workers& workers_;
  const std::vector<Solvable>& texels_;
  const Probe& first_;
  std::shared_ptr<const std::vector<float>> known_;
  std::vector<Solver> solvers_;
  std::map<std::size_t, std::vector<Source>> numbers_;
  std::vector<std::vector<std::int32_t>> groups_;
  Found found_;
};

}  // namespace

void add_solved_substitutions(std::vector<Fault>& out, const Probed& p, const std::vector<Solvable>& texels,
                              const std::vector<float>& known, const Workers& workers) {
  // If the unchanged pass comes near, any change without effect would explain the texel.
  std::vector<Solvable> failing;
  for (const Solvable& t : texels)
    if (!Solver(t, known).is_near(std::vector<perturbed::Substitution>())) failing.push_back(t);
  // One texel with few stored numbers fits too many candidates.
  if (failing.empty() || (failing.size() < 2 && failing[0].port.size() < 6)) return;
  Search(p, failing, known, workers).run(out);
}

}  // namespace rainref::faults
