// Operations that are wrongly applied to a value or to the components of a vector, or wrongly chosen: an encoding, a tone curve, a clamp, a
// packing; another curve in place of a polynomial of one number; blends of several values.
#include <algorithm>
#include <functional>
#include <string>

#include "faults/edits.h"
#include "faults/targets.h"
#include "faults/text.h"

namespace rainref::faults {
namespace {

using perturbed::Op;
using Node = perturbed::Trace::Node;
using Make = std::function<Expression(const Expression&)>;

Expression power(const Expression& x, float exponent) {
  return operation(Op::power, {operation(Op::maximum, {x, number_of(0)}), number_of(exponent)});
}
Expression decoded(const Expression& x) {
  return operation(Op::choice, {quotient(x, number_of(12.92f)), power(quotient(sum(x, number_of(0.055f)), number_of(1.055f)), 2.4f),
                                operation(Op::comparison, {x, number_of(0.04045f)})});
}
Expression encoded(const Expression& x) {
  return operation(Op::choice,
                   {product(x, number_of(12.92f)), difference(product(number_of(1.055f), power(x, 1 / 2.4f)), number_of(0.055f)),
                    operation(Op::comparison, {x, number_of(0.0031308f)})});
}
Expression in_codes(const Expression& x) {
  return quotient(operation(Op::floor, {sum(product(clamped(x), number_of(255)), number_of(0.5f))}), number_of(255));
}

struct Curve {
  Kind kind;            ///< of applying it
  const char* formula;  ///< of x
  Make make;
};
/// For colours.
const std::vector<Curve>& colour_curves() {
  static const std::vector<Curve> all{
      {Kind::decoded_from_srgb, "the sRGB curve, from code to light", decoded},
      {Kind::encoded_as_srgb, "the sRGB curve, from light to code", encoded},
      {Kind::to_power_2_2, "x^2.2", [](const Expression& x) { return power(x, 2.2f); }},
      {Kind::to_power_inverse_2_2, "x^(1/2.2)", [](const Expression& x) { return power(x, 1 / 2.2f); }},
      {Kind::tone_mapped, "x / (1 + x)", [](const Expression& x) { return quotient(x, sum(number_of(1), x)); }},
      {Kind::tone_mapped_by_exp, "1 - exp(-x)",
       [](const Expression& x) { return difference(number_of(1), operation(Op::exponential, {operation(Op::negation, {x})})); }},
      {Kind::in_8_bits, "x in steps of 1/255", in_codes},
  };
  return all;
}
/// For any numbers.
const std::vector<Curve>& plain_curves() {
  static const std::vector<Curve> all{
      {Kind::held, "", clamped},
      {Kind::unpacked, "", [](const Expression& x) { return difference(product(number_of(2), x), number_of(1)); }},
      {Kind::packed, "", [](const Expression& x) { return sum(product(number_of(0.5f), x), number_of(0.5f)); }},
      {Kind::taken_for_root, "", [](const Expression& x) { return root_of(x); }},
      {Kind::taken_as_1, "", [](const Expression&) { return number_of(1); }},
      {Kind::less_a_half, "", [](const Expression& x) { return difference(x, number_of(0.5f)); }},
      {Kind::and_a_half, "", [](const Expression& x) { return sum(x, number_of(0.5f)); }},
  };
  return all;
}

/// The argument of an operation's curve, and the curve.
struct Own {
  enum class Is { none, power, clamp, srgb } is = Is::none;
  Expression of = {};
};
Own own_curve(const Probe& p, std::int32_t node) {
  const Expression e = expression_of(p, node, 4);
  if (!e.is_operation()) return {};
  const auto is_between = [&](const Expression& x, float low, float high) {
    if (x.node < 0 || x.is_operation() || node_of(p, x.node).op != Op::constant) return false;
    const float v = node_of(p, x.node).value;
    return low <= v && v <= high;
  };
  if (e.step.op == Op::power && is_between(e.of[1], 0.3f, 3)) return {Own::Is::power, e.of[0]};
  if (e.step.op == Op::minimum && e.of[0].is_operation() && e.of[0].step.op == Op::maximum) return {Own::Is::clamp, e.of[0].of[0]};
  if (e.step.op == Op::choice)
    for (const std::size_t k : {0u, 1u}) {
      const Expression& linear = e.of[k];
      if (!linear.is_operation() || (linear.step.op != Op::product && linear.step.op != Op::quotient)) continue;
      for (const std::size_t j : {0u, 1u})
        if (is_between(linear.of[1 - j], 12.9f, 12.93f) || is_between(linear.of[1 - j], 1 / 12.93f, 1 / 12.9f))
          return {Own::Is::srgb, linear.of[j]};
    }
  return {};
}

/// Nodes that occur more than once below an operation, top first.
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
/// The single non-constant node of which the operation is a polynomial, used at least twice; -1 if there is none. wanted: that node, or
/// with -1 any node that is not a polynomial.
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

std::vector<Edit> value_curve_edits_of(const Probe& p, const std::vector<std::int32_t>& values) {
  std::vector<Edit> out;
  const std::string text = words_for(p, values[0]);
  const auto add = [&](const Curve& curve) {
    Edit& e = out.emplace_back(Edit{{}, {curve.kind, {text}}});
    for (const std::int32_t node : values) e.made.push_back(curve.make(itself(node)));
  };
  const Op op = node_of(p, values[0]).op;
  if (op != Op::comparison && op != Op::coordinate && op != Op::level) {
    for (const Curve& curve : plain_curves()) add(curve);
    if (values.size() == 3)
      for (const Curve& curve : colour_curves()) add(curve);
  }
  std::vector<Own> own;
  for (const std::int32_t node : values) own.push_back(own_curve(p, node));
  for (const Own& one : own)
    if (one.is == Own::Is::none || one.is != own[0].is) return out;
  const std::string of = text_of(p, own[0].of), right = own[0].is == Own::Is::power   ? text
                                                        : own[0].is == Own::Is::clamp ? "clamp"
                                                                                      : "the sRGB curve";
  for (const Curve& curve : colour_curves()) {
    Edit& e = out.emplace_back(Edit{{}, {Kind::another_curve_for, {text, curve.formula, of, right}}});
    for (const Own& one : own) e.made.push_back(curve.make(one.of));
  }
  return out;
}

std::vector<JointEdit> blend_edits_of(const Probe& p) {
  std::vector<JointEdit> out;
  constexpr std::size_t longest = 5;  // a path has at most this many steps
  constexpr std::int32_t near = 14;
  std::vector<bool> is_below(p.trace.nodes.size());
  for (const Node& n : p.trace.nodes)
    if (n.op == Op::mix && n.of[0] >= 0) is_below[static_cast<std::size_t>(n.of[0])] = true;
  struct Chain {
    std::int32_t top;
    std::size_t length;
  };
  std::vector<Chain> chains;
  for (std::int32_t at = 0; at < static_cast<std::int32_t>(p.trace.nodes.size()); ++at) {
    if (node_of(p, at).op != Op::mix || is_below[static_cast<std::size_t>(at)] || node_of(p, at).occurrence != 0) continue;
    std::size_t length = 0;
    for (std::int32_t of = at; of >= 0 && node_of(p, of).op == Op::mix && length < longest; of = node_of(p, of).of[0]) ++length;
    if (length > 1) chains.push_back({at, length});
  }
  const auto add = [&](const std::vector<Chain>& v, std::size_t count) {
    JointEdit& one = out.emplace_back();
    for (const Chain& c : v) {
      one.nodes.push_back(c.top);
      const Expression whole = expression_of(p, c.top, static_cast<int>(count));
      std::vector<std::pair<Expression, Expression>> layers;  // top first
      const Expression* at = &whole;
      for (std::size_t k = 0; k < count; ++k, at = &at->of[0]) layers.emplace_back(at->of[1], at->of[2]);
      Expression made = *at;
      for (const auto& [value, share] : layers) made = operation(Op::mix, {std::move(made), value, share});
      one.edit.made.push_back(std::move(made));
    }
    one.edit.what = {v.size() > 1 ? Kind::blends_of_all_reversed : Kind::blends_reversed, {words_for(p, v[0].top), std::to_string(count)}};
  };
  for (std::size_t i = 0; i < chains.size();) {
    std::vector<Chain> v{chains[i]};
    while (i + v.size() < chains.size() && v.size() < perturbed::Rewrites().size() && chains[i + v.size()].length == v[0].length &&
           chains[i + v.size()].top - v.back().top <= near)
      v.push_back(chains[i + v.size()]);
    if (v[0].length > 2) add(v, v[0].length);
    add(v, 2);
    i += v.size();
  }
  return out;
}

}  // namespace rainref::faults
