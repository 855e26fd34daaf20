// Replacements at one place of a pass text: its parts combined differently, or with their values after a step.
#include "faults/edits.h"

#include <algorithm>
#include <string>

#include "faults/targets.h"
#include "faults/text.h"

namespace rainref::faults {
namespace {

using perturbed::FormulaStep;
using perturbed::Op;
using Node = perturbed::Trace::Node;

bool is_constant(const Probe& p, const Expression& e) {
  return e.step.kind == FormulaStep::Kind::number || (e.node >= 0 && node_of(p, e.node).op == Op::constant);
}

class Edits {
 public:
  Edits(const Probe& p, std::int32_t node, std::vector<Edit>& out)
      : p_(p), node_(node), all_(expression_of(p, node, 3)), text_(words_for(p, node)), out_(out) {}

  void run() {
    if (!all_.is_operation()) return;
    of_each_part();
    for (Edit& e : curve_edits_of(p_, node_)) out_.push_back(std::move(e));
    blends();
    updated();
  }

  /// Exchanges two parts, one below each of two operands.
  void exchange() {
    if (!all_.is_operation()) return;
    for (std::size_t i = 0; i < all_.of.size(); ++i)
      for (std::size_t j = i + 1; j < all_.of.size(); ++j) {
        Expression made = all_;
        std::vector<Expression*> first, second;
        parts(made.of[i], first);
        parts(made.of[j], second);
        for (Expression* a : first)
          for (Expression* b : second) {
            const bool are_operands = a == &made.of[i] && b == &made.of[j];
            if (a->node < 0 || b->node < 0 || a->node == b->node || (are_operands && is_symmetric(all_.step.op))) continue;
            if (is_constant(p_, *a) != is_constant(p_, *b)) continue;
            const std::string one = words_for(p_, a->node), other = words_for(p_, b->node);
            if (one == other || says_nothing(one) || says_nothing(other)) continue;
            std::swap(*a, *b);
            keep(made, Kind::exchanged, {text_, one, other, text_of(p_, made)});
            std::swap(*a, *b);
          }
      }
  }

 private:
  void keep(Expression made, Kind kind, std::vector<std::string> of) { out_.push_back({{std::move(made)}, {kind, std::move(of)}}); }
  /// Adds an edit whose text shows the replacement.
  void keep(Expression made, Kind kind) {
    std::string text = text_of(p_, made);
    keep(std::move(made), kind, {text_, std::move(text)});
  }

  static bool is_symmetric(Op op) { return op == Op::sum || op == Op::product || op == Op::minimum || op == Op::maximum; }
  static bool is_arithmetic(Op op) { return is_symmetric(op) || op == Op::difference || op == Op::quotient; }

  /// Applies a map x -> a x + b of a sum of products to one factor of each product instead.
  void of_each_part() {
    const Expression deep = expression_of(p_, node_, 5);
    std::vector<std::pair<Op, std::pair<bool, Expression>>> maps;  // from outside: operation, true if the constant is first, constant
    const Expression* at = &deep;
    while (at->is_operation() && at->of.size() == 2 && is_arithmetic(at->step.op) && maps.size() < 3) {
      const bool is_first = is_constant(p_, at->of[0]), is_second = is_constant(p_, at->of[1]);
      if (is_first == is_second) break;
      maps.emplace_back(at->step.op, std::pair(is_first, at->of[is_first ? 0 : 1]));
      at = &at->of[is_first ? 1 : 0];
    }
    if (maps.empty() || !at->is_operation() || (at->step.op != Op::sum && at->step.op != Op::difference)) return;
    const auto mapped = [&](Expression e) {
      for (auto m = maps.rbegin(); m != maps.rend(); ++m)
        e = m->second.first ? operation(m->first, {m->second.second, std::move(e)}) : operation(m->first, {std::move(e), m->second.second});
      return e;
    };
    const auto is_product = [](const Expression& term) { return term.is_operation() && term.step.op == Op::product; };
    if (!std::all_of(at->of.begin(), at->of.end(), is_product)) return;
    for (const std::size_t factor : {0u, 1u}) {
      std::vector<Expression> terms = at->of;
      for (Expression& term : terms) term.of[factor] = mapped(term.of[factor]);
      const Expression e = operation(at->step.op, terms);
      keep(e, Kind::of_each_part, {text_, text_of(p_, e), text_of(p_, *at)});
    }
  }

  /// Two blends in the other order, or a blend in place of the minimum or maximum of a value and a product.
  void blends() {
    const auto is = [](const Expression& e, Op op) { return e.is_operation() && e.step.op == op; };
    for (const std::size_t k : {0u, 1u})
      for (const std::size_t j : {0u, 1u}) {
        if (all_.step.op == Op::mix && is(all_.of[k], Op::mix)) {
          Expression outer = all_, inner = all_.of[k];
          outer.of[k] = inner.of[j];
          inner.of[j] = std::move(outer);
          keep(inner, Kind::order_of_two_blends);
        }
        if ((all_.step.op == Op::minimum || all_.step.op == Op::maximum) && is(all_.of[k], Op::product))
          keep(operation(Op::mix, {all_.of[1 - k], all_.of[k].of[1 - j], all_.of[k].of[j]}), Kind::blended_for_bound);
      }
  }

  /// The value of a part after a step elsewhere in the pass: life - dt for life.
  void updated() {
    std::vector<Expression*> all;
    Expression made = all_;
    parts(made, all);
    for (Expression* to : all) {
      if (to->is_operation() || to->node < 0 || (!is_constant(p_, *to) && node_of(p_, to->node).op != Op::load)) continue;
      const std::string& name = p_.names[static_cast<std::size_t>(to->node)];
      if (name.empty() || is_number(name)) continue;
      for (std::int32_t at = 0; at < static_cast<std::int32_t>(p_.trace.nodes.size()); ++at) {
        const Node& n = node_of(p_, at);
        if ((n.op != Op::sum && n.op != Op::difference) || n.occurrence != 0 || at == node_) continue;
        const bool uses = std::any_of(n.of.begin(), n.of.end(), [&](std::int32_t of) {
          return of >= 0 && node_of(p_, of).op == node_of(p_, to->node).op && p_.names[static_cast<std::size_t>(of)] == name;
        });
        if (!uses) continue;
        const Expression after = elsewhere(p_, at, node_, {node_}, 3);
        if (!can_be_had(after)) continue;
        const Expression kept = *to;
        const std::string wrong = words_for(p_, at);
        *to = after;
        keep(made, Kind::value_of_after, {text_, wrong, name});
        *to = kept;
      }
    }
  }

  const Probe& p_;
  std::int32_t node_;
  Expression all_;
  std::string text_;
  std::vector<Edit>& out_;
};

}  // namespace

std::vector<Edit> edits_of(const Probe& p, std::int32_t node) {
  std::vector<Edit> out;
  Edits(p, node, out).run();
  return out;
}
std::vector<Edit> exchanges_of(const Probe& p, std::int32_t node) {
  std::vector<Edit> out;
  Edits(p, node, out).exchange();
  return out;
}

}  // namespace rainref::faults
