#include "faults/shader_line.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "faults/followed_values.h"

namespace rainref::faults {
namespace {

using perturbed::Op;

class LineSearch {
 public:
  LineSearch(const std::vector<Followed>& invocations, bool in_function)
      : reference_(invocations), port_(invocations), in_function_(in_function) {}
  std::vector<FoundLine> found() const;

 private:
  /// A step, and its user.
  struct Met {
    int node, user;
  };
  bool is_vouched(const PortStep& p) const;
  int sooner(int changed, const Values& v) const;
  int first_constant(int from) const;
  std::vector<Met> unvouched(int from) const;
  std::uint32_t blamed(int node) const;
  FoundLine line_at(int node) const { return {blamed(node), blamed(node)}; }
  std::vector<FoundLine> walked_back(int changed, int from, bool is_late) const;
  std::vector<FoundLine> of_outputs() const;

  ReferenceValues reference_;
  PortValues port_;
  bool in_function_;
};

/// True if the reference computes it, too: the values of one contain all of the other's, because either may omit rounds of a loop, or do in
/// one place what the other does in several.
bool LineSearch::is_vouched(const PortStep& p) const {
  for (std::size_t k = 0; k < p.values.size(); ++k) {
    if (p.values[k].empty()) continue;
    std::vector<int> near;
    for (const float v : p.values[k])
      for (const int n : reference_.by_right.near(k, v)) near.push_back(n);
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    if (near.empty()) continue;
    return std::any_of(near.begin(), near.end(), [&](int n) {
      const Values& right = reference_.right[static_cast<std::size_t>(n)];
      return is_met_by(p.values, right) || (tells(right) && is_met_by(right, p.values));
    });
  }
  return false;
}

/// The first operation before `changed` to which the mistake gives these values; -1 if there is none.
int LineSearch::sooner(int changed, const Values& v) const {
  for (int n = 0; n < changed; ++n)
    if (is_within(reference_.changed[static_cast<std::size_t>(n)], v)) return n;
  return -1;
}

/// Finds the source in the port of a number that is equal in every invocation and that the reference lacks.
int LineSearch::first_constant(int from) const {
  std::vector<char> is_seen(port_.steps.size(), 0);
  for (int at = from;;) {
    is_seen[static_cast<std::size_t>(at)] = 1;
    const auto& of = port_[at].of;
    const auto next = std::find_if(of.begin(), of.end(), [&](int operand) {
      const PortStep& p = port_[operand];
      return !is_seen[static_cast<std::size_t>(operand)] && !p.is_given() && !varies(p.values) && !is_vouched(p);
    });
    if (next == of.end()) return at;
    at = *next;
  }
}

/// Walks back from a step through all steps that the reference lacks; returns these with their users.
std::vector<LineSearch::Met> LineSearch::unvouched(int from) const {
  std::vector<Met> open{{from, from}}, out;
  std::set<int> is_seen;
  while (!open.empty()) {
    const Met at = open.back();
    open.pop_back();
    if (port_[at.node].is_given() || !is_seen.insert(at.node).second) continue;
    out.push_back(at);
    if (at.node != from && is_vouched(port_[at.node])) continue;
    for (const int operand : port_[at.node].of) open.push_back({operand, at.node});
  }
  return out;
}

/// The instruction of a step. If a function is right in most of its calls, the call is wrong.
std::uint32_t LineSearch::blamed(int node) const {
  const PortStep& p = port_[node];
  if (p.calls.empty() || in_function_) return p.instruction;
  std::map<std::vector<std::uint32_t>, bool> right;  // for each call: true if all of its parts are right
  for (const PortStep& o : port_.steps)
    if (o.instruction == p.instruction && o.calls.size() == p.calls.size()) {
      const auto [at, is_new] = right.emplace(o.calls, true);
      at->second = at->second && is_vouched(o);
    }
  const auto wrong = std::count_if(right.begin(), right.end(), [](const auto& call) { return !call.second; });
  return right.size() > 1 && 2 * wrong <= static_cast<std::ptrdiff_t>(right.size()) ? p.calls.back() : p.instruction;
}

/// Walks back from a value of the port that equals the mistake's and that the reference lacks, through steps that the reference also lacks
/// and earlier values of the mistake.
std::vector<FoundLine> LineSearch::walked_back(int changed, int from, bool is_late) const {
  Met best{from, from};
  int best_time = changed, first = from;
  bool is_old = false;
  for (const Met& at : unvouched(from)) {
    const PortStep& p = port_[at.node];
    const bool is_right = at.node != from && is_vouched(p);
    // The invocation's own index is right; its use may be wrong.
    if (p.is_position && port_[at.user].is_position) continue;
    const int time = at.node == from ? -1 : sooner(changed, p.values);
    if (!is_right && !p.is_position) first = std::min(first, at.node);
    // If several steps copy one value, the first counts, because it computes it; if the reference has the value too, the last.
    if (time >= 0 && (!is_right || varies(p.values)) && (time < best_time || (time == best_time && !is_right && at.node < best.node))) {
      best = at;
      best_time = time;
      is_old = is_right;
    }
  }
  const FoundLine begins = line_at(first);
  if (is_old) {
    // A wrong result of a function is attributed to the call, if its user is outside.
    const PortStep &kept = port_[best.node], &user = port_[best.user];
    if (kept.of.empty()) return {line_at(best.user), begins};
    const std::uint32_t at = kept.calls.size() > user.calls.size() ? kept.calls[user.calls.size()] : kept.instruction;
    return {{at, kept.calls.size() < user.calls.size() ? at : user.instruction}, begins};
  }
  // A texel is wrong if its position is. If the port has the mistake's operation in another form, the mistake begins there.
  const Op op = port_[best.node].op;
  const bool is_of_place = op == Op::lookup || op == Op::load || op == Op::fetch;
  if (!in_function_ && (is_of_place || (is_late && best.node == from))) return {begins, line_at(best.node)};
  return {line_at(first_constant(best.node)), begins};
}

/// If no value of the mistake occurs before the stores: returns the first operand of a stored value that the reference lacks; if there is
/// none, the store itself, or the construction of the stored vector.
std::vector<FoundLine> LineSearch::of_outputs() const {
  int first = -1;
  for (const int output : port_.outputs)
    for (const Met& at : unvouched(output))
      if ((first < 0 || at.node < first) && !port_[at.node].is_position && !is_vouched(port_[at.node])) first = at.node;
  if (first >= 0) return {line_at(first)};
  if (port_.outputs.empty()) return {};
  int made = port_.outputs.front();
  const FoundLine stored = line_at(made);
  while (port_[made].op == Op::stored && port_[made].of.size() == 1 && port_[made].of[0] < made && !port_[port_[made].of[0]].is_given())
    made = port_[made].of[0];
  return {stored, line_at(made)};
}

std::vector<FoundLine> LineSearch::found() const {
  bool is_late = false;  // a new value of the mistake is not in the port, whose text has another form there
  for (std::size_t n = 0; n < reference_.changed.size(); ++n) {
    const Values& wrong = reference_.changed[n];
    if (!varies(wrong) || reference_.has(wrong)) continue;
    const auto there = std::find_if(wrong.begin(), wrong.end(), [](const auto& one) { return !one.empty(); });
    for (const int k : port_.by_value.near(static_cast<std::size_t>(there - wrong.begin()), there->front()))
      if (is_within(wrong, port_[k].values) && !is_vouched(port_[k])) return walked_back(static_cast<int>(n), k, is_late);
    is_late = true;
  }
  return of_outputs();
}

}  // namespace

std::vector<FoundLine> lines_of_mistake(const std::vector<Followed>& invocations, bool in_function) {
  return LineSearch(invocations, in_function).found();
}

}  // namespace rainref::faults
