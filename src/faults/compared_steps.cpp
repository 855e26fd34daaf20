#include "faults/compared_steps.h"

#include <algorithm>
#include <map>

namespace rainref::faults {

using perturbed::Op;

ComparedSteps::ComparedSteps(const std::vector<Followed>& invocations, bool is_in_function)
    : reference(invocations), port(invocations), in_function(is_in_function) {
  for (const PortStep& p : port.steps)
    if (!p.calls.empty() && begins_wrong(p, &PortStep::values, &PortStep::of)) origins_.insert(p.calls);
}

bool ComparedSteps::is_of_reference(const Values& of_port) const {
  for (std::size_t k = 0; k < of_port.size(); ++k) {
    if (of_port[k].empty()) continue;
    std::vector<int> near;
    for (const float v : of_port[k])
      for (const int n : reference.by_right.near(k, v)) near.push_back(n);
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    if (near.empty()) continue;
    return std::any_of(near.begin(), near.end(), [&](int n) {
      const Values& right = reference.right[static_cast<std::size_t>(n)];
      return is_met_by(of_port, right) || (tells(right) && is_met_by(right, of_port));
    });
  }
  return false;
}

int ComparedSteps::sooner(int changed, const Values& v) const {
  for (int n = 0; n < changed; ++n)
    if (is_within(reference.changed[static_cast<std::size_t>(n)].values, v)) return n;
  return -1;
}

int ComparedSteps::first_constant(int from) const {
  std::vector<char> is_seen(port.steps.size(), 0);
  for (int at = from;;) {
    is_seen[static_cast<std::size_t>(at)] = 1;
    const auto& of = port[at].of;
    const auto next = std::find_if(of.begin(), of.end(), [&](int operand) {
      const PortStep& p = port[operand];
      return !is_seen[static_cast<std::size_t>(operand)] && !p.is_given() && !varies(p.values) && !is_vouched(p);
    });
    if (next == of.end()) return at;
    at = *next;
  }
}

/// True if these values are wrong although those operands of them are right.
bool ComparedSteps::begins_wrong(const PortStep& p, Values PortStep::*values, std::vector<int> PortStep::*operands) const {
  const auto is_right = [&](const PortStep& o) { return o.is_given() || o.is_position || is_of_reference(o.*values); };
  return !is_right(p) && std::all_of((p.*operands).begin(), (p.*operands).end(), [&](int of) { return is_right(port[of]); });
}

std::uint32_t ComparedSteps::blamed(int node) const {
  const PortStep& p = port[node];
  std::uint32_t at = p.instruction;
  for (std::size_t level = in_function ? 0 : p.calls.size(); level > 0; --level) {
    // A call is wrong if something goes wrong in it, and not only what it is given.
    const auto begins = [&](const std::vector<std::uint32_t>& calls, const std::vector<std::uint32_t>& with) {
      return calls.size() >= level && std::equal(calls.begin(), calls.begin() + static_cast<std::ptrdiff_t>(level), with.begin());
    };
    std::map<std::vector<std::uint32_t>, bool> wrong;
    for (const PortStep& o : port.steps)
      if (o.instruction == p.instruction && o.calls.size() == p.calls.size())
        wrong.emplace(std::vector(o.calls.begin(), o.calls.begin() + static_cast<std::ptrdiff_t>(level)), false);
    for (auto& [call, is_wrong] : wrong)
      is_wrong = std::any_of(origins_.begin(), origins_.end(), [&, &of = call](const auto& calls) { return begins(calls, of); });
    const auto count = std::count_if(wrong.begin(), wrong.end(), [](const auto& call) { return call.second; });
    if (wrong.size() < 2 || 2 * count > static_cast<std::ptrdiff_t>(wrong.size())) break;
    at = p.calls[level - 1];
  }
  return at;
}

bool ComparedSteps::has_one_call(const PortStep& p) const {
  return !p.calls.empty() && std::none_of(port.steps.begin(), port.steps.end(), [&](const PortStep& o) {
    return o.instruction == p.instruction && o.part == p.part && o.calls != p.calls;
  });
}

bool ComparedSteps::is_old_in_most_calls(const PortStep& p) const {
  int calls = 0, old = 0;
  for (const PortStep& o : port.steps) {
    if (o.instruction != p.instruction || o.part != p.part || o.calls.size() != p.calls.size()) continue;
    ++calls;
    old += varies(o.values) && sooner(static_cast<int>(reference.changed.size()), o.values) >= 0;
  }
  return calls > 1 && 2 * old > calls;
}

int ComparedSteps::first_copy(int node, bool whatever_use) const {
  for (;;) {
    const PortStep& p = port[node];
    const auto is_same = [&](int of) {
      const PortStep& from = port[of];
      const bool is_read = from.op == Op::load || from.op == Op::fetch || from.op == Op::constant;
      return of < node && !from.is_given() && !is_read && (whatever_use || from.users == 1) && from.calls == p.calls && varies(p.values) &&
             is_within(p.values, from.values);
    };
    const auto from = std::find_if(p.of.begin(), p.of.end(), is_same);
    if (from == p.of.end()) return node;
    node = *from;
  }
}

int ComparedSteps::other_operand(int node, const ChangedValues& meant) const {
  std::vector<int> others;
  std::ptrdiff_t missing = 0;
  const auto is_one = [](const Values& a, const Values& b) { return is_met_by(a, b) || is_met_by(b, a); };
  for (const Values& operand : meant.operands)
    missing += varies(operand) &&
               std::none_of(port[node].of.begin(), port[node].of.end(), [&](int of) { return is_one(operand, port[of].values); });
  for (const int of : port[node].of) {
    const Values& own = port[of].values;
    if (varies(own) &&
        std::none_of(meant.operands.begin(), meant.operands.end(), [&](const Values& operand) { return is_one(own, operand); }))
      others.push_back(of);
  }
  return missing == 1 && others.size() == 1 && is_vouched(port[others[0]]) && !port[others[0]].is_given() ? others[0] : -1;
}

}  // namespace rainref::faults
