// Another curve of one number: a polynomial of it that a pass text has in place of which another one, or none, may stand.
#include <algorithm>
#include <functional>

#include "faults/edits.h"
#include "faults/targets.h"
#include "faults/text.h"

namespace rainref::faults {
namespace {

using perturbed::Op;
using Node = perturbed::Trace::Node;

/// Nodes that are met more than once below an operation, from the top.
std::vector<std::int32_t> shared_below(const Probe& p, std::int32_t node) {
  std::vector<std::int32_t> out, met, open{node};
  constexpr std::size_t most = 64;
  for (std::size_t k = 0; k < open.size() && k < most; ++k) {
    if (open[k] < 0) continue;
    const Node& n = node_of(p, open[k]);
    if (n.op == Op::constant) continue;
    if (std::find(met.begin(), met.end(), open[k]) != met.end()) {
      if (std::find(out.begin(), out.end(), open[k]) == out.end()) out.push_back(open[k]);
      continue;
    }
    met.push_back(open[k]);
    for (const std::int32_t below : n.of) open.push_back(below);
  }
  return out;
}
/// The one node that is no number of which the operation is a polynomial, met twice at least; -1: there is none. wanted: that one, or
/// with -1 whichever node is no polynomial.
std::int32_t variable_of(const Probe& p, std::int32_t top, std::int32_t wanted) {
  std::int32_t found = wanted;
  int uses = 0;
  const std::function<bool(std::int32_t, int)> is_of_one = [&](std::int32_t node, int depth) {
    if (node < 0) return false;
    const Node& n = node_of(p, node);
    if (n.op == Op::constant) return true;
    if (node == found) return ++uses > 0;
    const bool takes_one = n.op == Op::square || n.op == Op::negation;
    if (depth > 0 && (takes_one || n.op == Op::sum || n.op == Op::difference || n.op == Op::product)) {
      bool all = true;
      for (std::size_t k = 0; k < (takes_one ? 1u : 2u); ++k) all &= is_of_one(n.of[k], depth - 1);
      return all;
    }
    if (found >= 0) return false;
    found = node;
    return ++uses > 0;
  };
  constexpr int deepest = 6;
  return is_of_one(top, deepest) && uses >= 2 && found != top ? found : -1;
}
std::int32_t variable_of(const Probe& p, std::int32_t node) {
  const Op op = node_of(p, node).op;
  if (op != Op::sum && op != Op::difference && op != Op::product && op != Op::square) return -1;
  std::int32_t found = variable_of(p, node, -1);
  if (found >= 0) return found;
  for (const std::int32_t candidate : shared_below(p, node)) {
    found = variable_of(p, node, candidate);
    if (found >= 0) return found;
  }
  return -1;
}

}  // namespace

std::vector<Edit> curve_edits_of(const Probe& p, std::int32_t node) {
  std::vector<Edit> out;
  const std::int32_t variable = variable_of(p, node);
  if (variable < 0) return out;
  Expression whole = expression_of(p, node, 6);
  std::vector<Expression*> all;
  parts(whole, all);
  const auto at = std::find_if(all.begin(), all.end(), [&](const Expression* e) { return e->node == variable; });
  if (at == all.end()) return out;
  const Expression x = **at;  // by the first path to it
  const std::string v = words_for(p, variable), text = words_for(p, node);
  const auto add = [&](Expression e, const std::string& curve) {
    out.push_back({{std::move(e)}, {Kind::another_curve, {text, curve, v}}});
  };
  const auto num = [](float value) { return number_of(value); };
  const Expression one = num(1), squared = product(x, x), rest = difference(one, x);
  add(x, "linear, " + v);
  add(product(squared, difference(num(3), product(num(2), x))), "the cubic smoothstep, x^2 (3 - 2 x)");
  add(product(product(squared, x), sum(product(x, difference(product(x, num(6)), num(15))), num(10))), "the quintic smoothstep");
  add(squared, "the square");
  add(product(squared, x), "the cube");
  add(product(squared, squared), "the fourth power");
  add(operation(Op::root, {x}), "the root");
  add(rest, "1 - x");
  add(product(rest, rest), "(1 - x)^2");
  add(difference(one, product(rest, rest)), "1 - (1 - x)^2");
  add(difference(one, squared), "1 - x^2");
  add(product(num(0.5f), difference(one, operation(Op::cosine, {product(num(3.14159265f), x)}))), "the cosine's, (1 - cos(pi x)) / 2");
  return out;
}

}  // namespace rainref::faults
