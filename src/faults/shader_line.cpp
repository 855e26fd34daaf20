#include "faults/shader_line.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <set>
#include <utility>

#include "faults/compared_steps.h"

namespace rainref::faults {
namespace {

using perturbed::Op;

class LineSearch : ComparedSteps {
 public:
  using ComparedSteps::ComparedSteps;
  FoundLines found() const;
  std::vector<FoundLine> departures(const LineSearch& passing) const;

 private:
  /// A step, and its user.
  struct Met {
    int node, user;
  };
  std::vector<Met> unvouched(int from, int changed = 0) const;
  FoundLine line_at(int node) const {
    const std::uint32_t at = blamed(node);
    return {at, at};
  }
  /// Lines, with the function and the call of the step that they were found by.
  FoundLines with_call(int node, std::vector<FoundLine> lines) const {
    const PortStep& p = port[node];
    if (p.calls.empty()) return {std::move(lines), {}};
    return {std::move(lines), {{p.instruction, p.instruction}, {p.calls.back(), p.calls.back()}}};
  }
  FoundLines walked_back(int changed, int from, bool is_late) const;
  std::vector<FoundLine> of_outputs() const;
  FoundLines of_decision(const Operands& compared) const;
  std::vector<FoundLine> of_remains() const;
  FoundLines of_operands(const ChangedValues& wrong) const;
};

/// Walks back from a step through all steps that the reference lacks; returns these with their users.
std::vector<LineSearch::Met> LineSearch::unvouched(int from, int changed) const {
  std::vector<Met> open{{from, from}}, out;
  std::set<int> is_seen;
  while (!open.empty()) {
    const Met at = open.back();
    open.pop_back();
    if (port[at.node].is_given() || !is_seen.insert(at.node).second) continue;
    out.push_back(at);
    const PortStep& p = port[at.node];
    // What the reference has too is right, unless the mistake makes it elsewhere.
    if (at.node != from && is_vouched(p) && !(varies(p.values) && sooner(changed, p.values) >= 0)) continue;
    for (const int operand : port[at.node].of) open.push_back({operand, at.node});
  }
  return out;
}

/// Walks back from a value of the port that equals the mistake's and that the reference lacks, through steps that the reference also lacks
/// and earlier values of the mistake.
FoundLines LineSearch::walked_back(int changed, int from, bool is_late) const {
  Met best{from, from};
  int best_time = changed, first = from;
  bool is_old = false, is_place = false;
  for (const Met& at : unvouched(from, changed)) {
    const PortStep& p = port[at.node];
    const bool is_right = at.node != from && is_vouched(p);
    // The invocation's own index is right; its use may be wrong.
    if (p.is_position && port[at.user].is_position) continue;
    const bool is_moved = p.is_position && reference.moves_position;
    const int time = at.node == from ? -1 : is_moved ? 0 : sooner(changed, p.values);
    if (!is_right && !p.is_position) first = std::min(first, at.node);
    // If several steps copy one value, the first counts, because it computes it; if the reference has the value too, the last.
    if (time >= 0 && (!is_right || varies(p.values)) &&
        (time < best_time || (time == best_time && (is_right ? at.node > best.node : at.node < best.node)))) {
      best = at;
      best_time = time;
      is_old = is_right || is_moved;
      is_place = is_moved;
    }
  }
  const FoundLine begins = line_at(first);
  if (is_old) {
    // A wrong result of a function is attributed to the call, if its user is outside.
    const PortStep &kept = port[best.node], &user = port[best.user];
    const bool is_remains = reference.changed[static_cast<std::size_t>(best_time)].is_left_out();
    const std::uint32_t made = port[first_copy(best.node, is_remains)].instruction;
    if (is_place) return with_call(best.node, {{made, user.calls.empty() ? user.instruction : user.calls.front()}, begins});
    if (kept.of.empty()) return with_call(best.user, {line_at(best.user), begins});
    const bool leaves = kept.calls.size() > user.calls.size();
    if (leaves && (in_function || is_old_in_most_calls(kept))) return with_call(best.node, {{kept.instruction, kept.instruction}, begins});
    const std::uint32_t at = leaves ? kept.calls[user.calls.size()] : made;
    return with_call(best.node, {{at, kept.calls.size() < user.calls.size() ? at : user.instruction}, begins});
  }
  if (best.node == from)
    if (const int other = other_operand(from, reference.changed[static_cast<std::size_t>(changed)]); other >= 0)
      return with_call(from, {{port[first_copy(other, false)].instruction, blamed(from)}, begins});
  // A texel is wrong if its position is. If the port has the mistake's operation in another form, the mistake begins there.
  const Op op = port[best.node].op;
  const bool is_of_place = op == Op::lookup || op == Op::load || op == Op::fetch;
  // If a function that only reads is called in one place, what it is given is more likely wrong.
  if (!in_function && op != Op::lookup && is_of_place && has_one_call(port[best.node]))
    return with_call(best.node, {{port[best.node].calls.back(), port[best.node].calls.back()}, line_at(best.node)});
  if (!in_function && (is_of_place || (is_late && best.node == from))) return with_call(best.node, {begins, line_at(best.node)});
  const int constant = first_constant(best.node);
  return with_call(constant, {line_at(constant), begins});
}

/// If no value of the mistake occurs before the stores: returns the first operand of a stored value that the reference lacks; if there is
/// none, the store itself, or the construction of the stored vector.
std::vector<FoundLine> LineSearch::of_outputs() const {
  int first = -1;
  for (const int output : port.outputs)
    for (const Met& at : unvouched(output))
      if ((first < 0 || at.node < first) && !port[at.node].is_position && !is_vouched(port[at.node])) first = at.node;
  if (first >= 0) return {line_at(first)};
  if (port.outputs.empty()) return {};
  int made = port.outputs.front();
  const FoundLine stored = line_at(made);
  while (port[made].op == Op::stored && port[made].of.size() == 1 && port[made].of[0] < made && !port[port[made].of[0]].is_given())
    made = port[made].of[0];
  return {stored, line_at(made)};
}

/// The port's comparison with these operands, whatever it does with the outcome; the number in it that the reference lacks, if there is
/// one.
FoundLines LineSearch::of_decision(const Operands& compared) const {
  for (std::size_t k = 0; k < port.steps.size(); ++k) {
    const PortStep& p = port.steps[k];
    if (p.op != Op::comparison || !is_same_comparison(compared, p.compared)) continue;
    const int constant = first_constant(static_cast<int>(k));
    return with_call(constant, {{port[constant].instruction, port[constant].instruction}});
  }
  return {};
}

/// The step that makes what remains if a step is left out; the mistake lies behind it.
std::vector<FoundLine> LineSearch::of_remains() const {
  const auto left = std::find_if(reference.changed.begin(), reference.changed.end(), std::mem_fn(&ChangedValues::is_left_out));
  if (left == reference.changed.end() || port.outputs.empty()) return {};
  for (std::size_t k = 0; k < port.steps.size(); ++k) {
    const PortStep& p = port.steps[k];
    if (!p.is_given() && is_within(left->values, p.values)) return {{p.instruction, port[port.outputs.front()].instruction}};
  }
  return {};
}

/// The port's operation that makes the mistake's values of the mistake's operands, where the reference makes them of others.
FoundLines LineSearch::of_operands(const ChangedValues& wrong) const {
  Operands telling;
  std::copy_if(wrong.operands.begin(), wrong.operands.end(), std::back_inserter(telling), tells);
  if (telling.empty() || wrong.is_left_out() || reference.has(wrong.values, telling)) return {};
  for (std::size_t k = 0; k < port.steps.size(); ++k) {
    const PortStep& p = port.steps[k];
    const auto is_operand = [&](const Values& wanted) {
      return std::any_of(p.of.begin(), p.of.end(), [&](int of) { return is_within(wanted, port[of].values); });
    };
    if (!p.is_given() && p.op != Op::comparison && is_within(wrong.values, p.values) &&
        std::all_of(telling.begin(), telling.end(), is_operand))
      return with_call(static_cast<int>(k), {line_at(static_cast<int>(k))});
  }
  return {};
}

FoundLines LineSearch::found() const {
  const Values* remains = nullptr;  // if a step is left out
  bool is_late = false;             // a new value of the mistake is not in the port, whose text has another form there
  for (std::size_t n = 0; n < reference.changed.size(); ++n) {
    const ChangedValues& c = reference.changed[n];
    const Values& wrong = c.values;
    if (!remains && c.is_left_out()) remains = &wrong;
    // Of what follows a step that is left out, only its user says more: the rest is a consequence.
    const auto is_of_remains = [&](const Values& operand) { return is_within(*remains, operand); };
    const bool is_near = !remains || std::any_of(c.operands.begin(), c.operands.end(), is_of_remains);
    if (!remains && !c.decision.empty())
      if (FoundLines found = of_decision(c.decision); !found.lines.empty()) return found;
    if (!varies(wrong) || reference.has(wrong)) {
      if (FoundLines found = is_near ? of_operands(c) : FoundLines(); !found.lines.empty()) return found;
      continue;
    }
    const auto there = std::find_if(wrong.begin(), wrong.end(), [](const auto& one) { return !one.empty(); });
    for (const int k : port.by_value.near(static_cast<std::size_t>(there - wrong.begin()), there->front()))
      if (!port[k].is_given() && !port[k].is_position && is_within(wrong, port[k].values) && !is_vouched(port[k]))
        return walked_back(static_cast<int>(n), k, is_late);
    is_late = true;
  }
  std::vector<FoundLine> lines = of_remains();
  for (const FoundLine& line : of_outputs()) lines.push_back(line);
  lines.resize(std::min<std::size_t>(lines.size(), 2));
  return {std::move(lines), {}};
}

std::vector<FoundLine> LineSearch::departures(const LineSearch& passing) const {
  std::set<int> origins;
  for (const int output : port.outputs)
    for (const Met& at : unvouched(output))
      if (is_first_wrong(port[at.node])) origins.insert(at.node);
  std::set<std::pair<std::uint32_t, std::vector<std::uint32_t>>> of_passing;
  for (const PortStep& p : passing.port.steps)
    if (passing.is_first_wrong(p)) of_passing.insert({p.instruction, p.calls});
  const auto is_form = [&](int node) { return of_passing.contains({port[node].instruction, port[node].calls}); };
  std::vector<FoundLine> out;
  for (const bool form : {false, true})
    for (const int node : origins)
      if (is_form(node) == form) out.push_back(line_at(node));
  return out;
}

}  // namespace

std::vector<FoundLine> departures(const std::vector<Followed>& failing, const std::vector<Followed>& passing) {
  return LineSearch(failing, false).departures(LineSearch(passing, false));
}

FoundLines lines_of_mistake(const std::vector<Followed>& invocations, bool in_function) {
  return LineSearch(invocations, in_function).found();
}

}  // namespace rainref::faults
