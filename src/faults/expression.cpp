#include <algorithm>

#include "faults/edits.h"
#include "faults/targets.h"
#include "faults/text.h"
#include "math/formula.h"

namespace rainref::faults {

using perturbed::Formula;
using perturbed::FormulaStep;
using perturbed::Op;
using Step = FormulaStep::Kind;
using Node = perturbed::Trace::Node;

namespace {

Expression built(const Probe& p, std::int32_t node, std::array<std::int8_t, 6> path, std::size_t length, int depth) {
  Expression e;
  e.node = node;
  const Op op = node < 0 ? Op::constant : node_of(p, node).op;
  const int takes = perturbed::operands_of(op);
  if (node < 0 || depth == 0 || takes == 0 || length >= path.size() || (op == Op::comparison && length > 0)) {
    e.step.kind = Step::part;
    e.step.path = path;
    return e;
  }
  e.step.op = op;
  e.step.path = path;  // for as_part()
  for (int k = 0; k < takes; ++k) {
    std::array<std::int8_t, 6> below = path;
    below[length] = static_cast<std::int8_t>(k);
    e.of.push_back(built(p, node_of(p, node).of[static_cast<std::size_t>(k)], below, length + 1, depth - 1));
  }
  return e;
}
/// Finds the path from a node to one of its operands, at most `most` operations deep; false: there is none.
bool find_path(const Probe& p, std::int32_t from, std::int32_t to, std::array<std::int8_t, 6>& path, std::size_t length, std::size_t most) {
  if (length >= most || from < 0) return false;
  const Node& n = node_of(p, from);
  for (int k = 0; k < perturbed::operands_of(n.op); ++k) {
    const std::int32_t below = n.of[static_cast<std::size_t>(k)];
    path[length] = static_cast<std::int8_t>(k);
    if (below == to || find_path(p, below, to, path, length + 1, most)) return true;
  }
  path[length] = -1;
  return false;
}
void append(const Expression& e, Formula& out) {
  for (const Expression& below : e.of) append(below, out);
  out.push_back(e.step);
}
}  // namespace

Expression number_of(float value) {
  Expression e;
  e.step.kind = Step::number;
  e.step.number = value;
  return e;
}
Expression itself(std::int32_t node) {
  Expression e;
  e.step.kind = Step::itself;
  e.node = node;
  return e;
}
bool can_be_had(const Expression& e) {
  if (e.step.kind == Step::part && e.step.path[0] < 0) return false;
  return std::all_of(e.of.begin(), e.of.end(), can_be_had);
}
Expression clamped(const Expression& x) { return operation(Op::minimum, {operation(Op::maximum, {x, number_of(0)}), number_of(1)}); }
Expression root_of(Expression x) { return operation(Op::root, {operation(Op::maximum, {std::move(x), number_of(0)})}); }
Expression as_part(const Expression& e) {
  Expression out = e;
  out.of.clear();
  out.step.kind = e.step.path[0] < 0 ? Step::itself : Step::part;
  return out;
}
Expression operation(Op op, std::vector<Expression> of) {
  Expression e;
  e.step.op = op;
  e.of = std::move(of);
  return e;
}
Expression expression_of(const Probe& p, std::int32_t node, int depth) { return built(p, node, {-1, -1, -1, -1, -1, -1}, 0, depth); }

Expression elsewhere(const Probe& p, std::int32_t node, std::int32_t at, const std::vector<std::int32_t>& changed, int depth) {
  Expression e;
  e.step.kind = Step::part;  // without a path: not available
  e.node = node;
  if (node < 0) return e;
  const Node& n = node_of(p, node);
  const bool is_of_records = p.names.size() > static_cast<std::size_t>(node) && is_of_list(p.names[static_cast<std::size_t>(node)]);
  if (n.op == Op::constant && !is_of_records) {
    e.step.kind = Step::number;
    e.step.number = n.value;
    return e;
  }
  const bool is_changed = std::find(changed.begin(), changed.end(), node) != changed.end();
  // The operands of the place itself are found there in each call of a function.
  constexpr std::size_t deep = 4;
  if (std::array<std::int8_t, 6> path{-1, -1, -1, -1, -1, -1}; node < at && !is_changed && find_path(p, at, node, path, 0, deep)) {
    e.step.path = path;
    return e;
  }
  if (node < at && !is_changed) {
    e.step.kind = Step::met;
    e.step.shape = n.shape;
    e.step.back = 0;
    for (std::int32_t m = node; m < at; ++m) e.step.back += node_of(p, m).shape == n.shape;
    return e;
  }
  const int takes = perturbed::operands_of(n.op);
  if (takes == 0 || depth == 0) return e;
  e.step.kind = Step::operation;
  e.step.op = n.op;
  for (int k = 0; k < takes; ++k) e.of.push_back(elsewhere(p, n.of[static_cast<std::size_t>(k)], at, changed, depth - 1));
  return e;
}

void parts(Expression& e, std::vector<Expression*>& out) {
  out.push_back(&e);
  for (Expression& below : e.of) parts(below, out);
}
Formula formula_of(const Expression& e) {
  Formula out;
  append(e, out);
  return out;
}
float value_at(const Probe& p, std::int32_t node, const Formula& formula) {
  const Node& n = node_of(p, node);
  std::array<perturbed::Perturbed, 4> of;
  for (std::size_t k = 0; k < of.size(); ++k) of[k] = perturbed::Perturbed::of(n.with[k]);
  return perturbed::by_formula(formula, perturbed::Perturbed::of(n.value), of, n.of, p.trace, static_cast<std::size_t>(node)).v;
}
}  // namespace rainref::faults
