// Replacements for a filter: a sum of values, each with a number as its weight.
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "faults/edits.h"
#include "faults/targets.h"
#include "faults/text.h"

namespace rainref::faults {
namespace {

using perturbed::FormulaStep;
using perturbed::Op;

struct Term {
  float weight;
  Expression value;
};
bool is_number(const Probe& p, const Expression& e) { return e.node >= 0 && !e.is_operation() && node_of(p, e.node).op == Op::constant; }

/// True if it is a weighted sum itself: a row of a filter that is also applied along columns.
bool is_weighted(const Probe& p, std::int32_t node) {
  if (node < 0 || node_of(p, node).op != Op::sum) return false;
  for (const std::int32_t of : node_of(p, node).of) {
    if (of < 0 || node_of(p, of).op != Op::product) continue;
    for (const std::size_t k : {0u, 1u})
      if (const std::int32_t factor = node_of(p, of).of[k]; factor >= 0 && node_of(p, factor).op == Op::constant) return true;
  }
  return false;
}
bool collect(const Probe& p, const Expression& e, float weight, std::vector<Term>& out, bool is_top = false) {
  if (!is_top && is_weighted(p, e.node)) {
    out.push_back({weight, as_part(e)});
    return true;
  }
  if (e.is_operation() && (e.step.op == Op::sum || e.step.op == Op::difference))
    return collect(p, e.of[0], weight, out) && collect(p, e.of[1], e.step.op == Op::sum ? weight : -weight, out);
  if (e.is_operation() && e.step.op == Op::product)
    for (const std::size_t k : {0u, 1u})
      if (is_number(p, e.of[k])) return collect(p, e.of[1 - k], weight * node_of(p, e.of[k].node).value, out);
  if (e.is_operation() && e.step.op == Op::quotient && is_number(p, e.of[1]))
    return collect(p, e.of[0], weight / node_of(p, e.of[1].node).value, out);
  if (is_number(p, e)) return false;
  out.push_back({weight, e});
  return true;
}

}  // namespace

std::vector<Edit> weight_edits_of(const Probe& p, std::int32_t node) {
  std::vector<Edit> out;
  const Op op = node_of(p, node).op;
  if (op != Op::sum && op != Op::product && op != Op::quotient) return out;
  std::vector<Term> terms;
  std::set<float> weights;
  if (!collect(p, expression_of(p, node, 4), 1, terms, true) || terms.size() < 3) return out;
  float total = 0;
  for (const Term& t : terms) weights.insert(t.weight), total += t.weight;
  if (weights.size() < 2) return out;
  const auto sum_with = [&](const auto& weight_of) {
    Expression sum;
    for (std::size_t k = 0; k < terms.size(); ++k) {
      Expression term = operation(Op::product, {number_of(weight_of(terms[k])), terms[k].value});
      sum = k == 0 ? std::move(term) : operation(Op::sum, {std::move(sum), std::move(term)});
    }
    return sum;
  };
  std::string text;
  for (const Term& t : terms) text += fmt::format("{}{:.4g}", text.empty() ? "" : ", ", t.weight);
  const float equal = total / static_cast<float>(terms.size());
  const std::string all = words_for(p, node);
  const auto number = [](float v) { return fmt::format("{:.4g}", v); };
  if (equal != 0)
    out.push_back(
        {{sum_with([&](const Term&) { return equal; })}, {Kind::equal_weights, {all, number(equal), text, std::to_string(terms.size())}}});
  for (const float a : weights)
    for (const float b : weights)
      if (a < b)
        out.push_back({{sum_with([&](const Term& t) { return t.weight == a   ? b
                                                             : t.weight == b ? a
                                                                             : t.weight; })},
                       {Kind::weights_exchanged, {all, number(a), number(b), text}}});
  return out;
}

}  // namespace rainref::faults
