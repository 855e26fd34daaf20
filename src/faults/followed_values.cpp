#include "faults/followed_values.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace rainref::faults {
namespace {

using perturbed::Op;
using perturbed::Trace;

constexpr double tolerance = 1e-5;

double margin_of(float v) { return tolerance * std::abs(static_cast<double>(v)) + 1e-9; }

/// Numbers rows in the order of their first appearance in any invocation.
template <class Key, class Row>
class Rows {
 public:
  std::vector<Row> rows;
  int at(const Key& key, const Row& empty) {
    const auto [found, is_new] = number_.emplace(key, static_cast<int>(rows.size()));
    if (is_new) rows.push_back(empty);
    return found->second;
  }

 private:
  std::map<Key, int> number_;
};

}  // namespace

bool agree(float a, float b) { return a == b || std::abs(static_cast<double>(a) - b) <= std::max(margin_of(a), margin_of(b)); }

namespace {
bool has(const std::vector<float>& sorted, float v) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), static_cast<float>(v - 2 * margin_of(v)));
  for (auto k = at; k != sorted.end() && *k <= v + 2 * margin_of(v); ++k)
    if (agree(*k, v)) return true;
  return false;
}
}  // namespace

bool is_within(const Values& some, const Values& all) {
  for (std::size_t k = 0; k < some.size(); ++k)
    for (const float v : some[k])
      if (!has(all[k], v)) return false;
  return true;
}
bool is_met_by(const Values& some, const Values& all) {
  std::size_t of_some = 0, of_both = 0;
  for (std::size_t k = 0; k < some.size(); ++k) {
    of_some += !some[k].empty();
    if (some[k].empty() || all[k].empty()) continue;
    ++of_both;
    for (const float v : some[k])
      if (!has(all[k], v)) return false;
  }
  return of_both > 0 && 2 * of_both >= of_some;
}
bool varies(const Values& v) {
  const float* first = nullptr;
  for (const auto& one : v)
    for (const float& x : one) {
      if (first && !agree(x, *first)) return true;
      first = &x;
    }
  return false;
}

bool tells(const Values& v) {
  const float* first = nullptr;
  for (const auto& one : v)
    for (const float& x : one) {
      if (x == std::floor(x)) continue;
      if (first && !agree(x, *first)) return true;
      first = &x;
    }
  return false;
}

bool ChangedValues::is_left_out() const {
  const auto remains = [&](const Values& operand) { return tells(operand) && is_within(values, operand); };
  return std::any_of(operands.begin(), operands.end(), remains);
}

bool is_same_comparison(const Operands& a, const Operands& b) {
  const auto is_same = [&](std::size_t of_a, std::size_t of_b) { return is_met_by(a[of_a], b[of_b]) || is_met_by(b[of_b], a[of_a]); };
  return (is_same(0, 0) && is_same(1, 1)) || (is_same(0, 1) && is_same(1, 0));
}

void ByValue::add(const Values& v, int number) {
  for (std::size_t k = 0; k < v.size(); ++k)
    for (const float x : v[k]) sorted_[k].push_back({x, number});
}
void ByValue::sort() {
  for (auto& one : sorted_) {
    std::sort(one.begin(), one.end());
    one.erase(std::unique(one.begin(), one.end()), one.end());
  }
}
std::vector<int> ByValue::near(std::size_t invocation, float v) const {
  std::vector<int> out;
  const auto& one = sorted_[invocation];
  auto at = std::lower_bound(one.begin(), one.end(), std::pair(static_cast<float>(v - 2 * margin_of(v)), -1));
  for (; at != one.end() && at->first <= v + 2 * margin_of(v); ++at) out.push_back(at->second);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

namespace {

constexpr std::size_t most_operands = 4;

/// Adds the operands of an operation in an invocation.
void add(Operands& to, std::size_t invocation, const Trace::Node& n, std::size_t count) {
  if (to.empty()) to.assign(n.op == Op::comparison ? 2 : most_operands, Values(count));
  for (std::size_t k = 0; k < to.size(); ++k)
    if (n.of[k] >= 0 || n.op == Op::comparison) to[k][invocation].push_back(n.with[k]);
}
void sort(Values& all) {
  for (auto& one : all) std::sort(one.begin(), one.end());
}
/// True if a decision has the same operands, or another number written in the text, but decides otherwise.
bool is_decided_otherwise(const Trace::Node& right, const Trace::Node& wrong, const Trace& all) {
  if (right.op != Op::comparison && right.op != Op::choice) return false;
  for (std::size_t side = 0; side < 2; ++side) {
    const bool is_number = right.of[side] < 0 || all.nodes[static_cast<std::size_t>(right.of[side])].op == Op::constant;
    if (!agree(right.with[side], wrong.with[side]) && !(right.op == Op::comparison && is_number)) return false;
  }
  return true;
}

}  // namespace

ReferenceValues::ReferenceValues(const std::vector<Followed>& invocations) : by_right(invocations.size()) {
  const std::size_t count = invocations.size();
  Rows<std::uint32_t, Values> rows;
  // Operand -1: the result.
  Rows<std::tuple<std::uint32_t, std::int32_t, int>, ChangedValues> of_mistake;
  for (std::size_t k = 0; k < count; ++k) {
    const Trace& meant = invocations[k].right;
    std::map<std::pair<std::uint32_t, std::int32_t>, const Trace::Node*> wrong;
    for (const Trace::Node& n : invocations[k].wrong.nodes) wrong[{n.shape, n.occurrence}] = &n;
    const auto with_mistake = [&](const Trace::Node& n) {
      const auto found = wrong.find({n.shape, n.occurrence});
      return found == wrong.end() ? nullptr : found->second;
    };
    const auto changed_row = [&](const Trace::Node& n, int operand) -> ChangedValues& {
      return of_mistake.rows[static_cast<std::size_t>(of_mistake.at({n.shape, n.occurrence, operand}, {Values(count), {}}))];
    };
    const Trace::Node* comparison = nullptr;  // the last one
    for (const Trace::Node& n : meant.nodes) {
      if (n.op == Op::comparison) comparison = &n;
      const auto row = static_cast<std::size_t>(rows.at(n.shape, Values(count)));
      rows.rows[row][k].push_back(n.value);
      operands.resize(rows.rows.size());
      if (n.op != Op::comparison) add(operands[row], k, n, count);
      const Trace::Node* const other = with_mistake(n);
      if (!other) continue;
      // An operand that the mistake replaces is not the value of its own node.
      for (std::size_t operand = 0; operand < n.of.size(); ++operand) {
        if (other->of[operand] < 0) continue;
        const Trace::Node& own = invocations[k].wrong.nodes[static_cast<std::size_t>(other->of[operand])];
        const float taken = other->with[operand];
        if (own.op != Op::constant && !agree(own.value, taken)) changed_row(n, static_cast<int>(operand)).values[k].push_back(taken);
      }
      if (agree(other->value, n.value)) continue;
      moves_position |= n.op == Op::index;
      ChangedValues& changed_here = changed_row(n, -1);
      changed_here.values[k].push_back(other->value);
      if (n.op != Op::comparison) add(changed_here.operands, k, *other, count);
      if (comparison && is_decided_otherwise(n, *other, meant))
        add(changed_here.decision, k, n.op == Op::comparison ? *other : *comparison, count);
    }
  }
  right = std::move(rows.rows);
  changed = std::move(of_mistake.rows);
  for (std::size_t k = 0; k < right.size(); ++k) {
    sort(right[k]);
    for (Values& operand : operands[k]) sort(operand);
    by_right.add(right[k], static_cast<int>(k));
  }
  by_right.sort();
  for (ChangedValues& c : changed)
    for (Operands* all : {&c.operands, &c.decision})
      for (Values& operand : *all) sort(operand);
}

bool ReferenceValues::has(const Values& v) const {
  const auto there = std::find_if(v.begin(), v.end(), [](const auto& one) { return !one.empty(); });
  if (there == v.end()) return false;
  const std::vector<int> near = by_right.near(static_cast<std::size_t>(there - v.begin()), there->front());
  return std::any_of(near.begin(), near.end(), [&](int k) { return is_within(v, right[static_cast<std::size_t>(k)]); });
}

bool ReferenceValues::has(const Values& v, const Operands& of) const {
  for (std::size_t k = 0; k < right.size(); ++k) {
    if (!is_within(v, right[k])) continue;
    const auto is_operand = [&](const Values& wanted) {
      return std::any_of(operands[k].begin(), operands[k].end(), [&](const Values& own) { return is_within(wanted, own); });
    };
    if (std::all_of(of.begin(), of.end(), is_operand)) return true;
  }
  return false;
}

PortValues::PortValues(const std::vector<Followed>& invocations) : by_value(invocations.size()) {
  const std::size_t count = invocations.size();
  // A part of an instruction in a call chain.
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::vector<std::uint32_t>>;
  Rows<Key, PortStep> rows;
  for (std::size_t k = 0; k < count; ++k) {
    const capture::ProgramTrace& trace = invocations[k].port;
    std::vector<int> number;
    for (std::size_t i = 0; i < trace.values.nodes.size(); ++i) {
      const Trace::Node& n = trace.values.nodes[i];
      const auto step = i < trace.steps.size() ? trace.steps[i] : capture::ProgramTrace::Step{capture::ProgramTrace::given, -1, 0};
      std::vector<std::uint32_t> calls;
      for (std::int32_t call = step.call; call >= 0; call = trace.calls[static_cast<std::size_t>(call)].caller)
        calls.push_back(trace.calls[static_cast<std::size_t>(call)].instruction);
      std::reverse(calls.begin(), calls.end());
      const int row =
          rows.at({step.instruction, step.part, calls}, {n.op, step.instruction, step.part, calls, Values(count), Values(count)});
      number.push_back(row);
      PortStep& made = rows.rows[static_cast<std::size_t>(row)];
      const bool is_first = made.values[k].empty();
      made.values[k].push_back(n.value);
      if (is_first) made.first[k].push_back(n.value);
      if (n.op == Op::comparison) add(made.compared, k, n, count);
      for (const std::int32_t operand : n.of) {
        if (operand < 0) continue;
        const int of = number[static_cast<std::size_t>(operand)];
        if (is_first) made.first_of.push_back(of);
        if (of != row) made.of.push_back(of);
      }
    }
    for (const int output : invocations[k].outputs)
      if (const std::int32_t node = trace.outputs[static_cast<std::size_t>(output)]; node >= 0)
        outputs.push_back(number[static_cast<std::size_t>(node)]);
  }
  steps = std::move(rows.rows);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    PortStep& p = steps[k];
    std::sort(p.of.begin(), p.of.end());
    p.of.erase(std::unique(p.of.begin(), p.of.end()), p.of.end());
    for (const int operand : p.of) ++steps[static_cast<std::size_t>(operand)].users;
    const bool is_copy = p.op == Op::stored && p.of.size() == 1 && p.of[0] < static_cast<int>(k);
    p.is_position = p.op == Op::index || (is_copy && (*this)[p.of[0]].is_position);
    sort(p.values);
    for (Values& operand : p.compared) sort(operand);
    by_value.add(p.values, static_cast<int>(k));
  }
  by_value.sort();
}

}  // namespace rainref::faults
