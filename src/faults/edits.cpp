// What stands at one place of a pass text in place of what is meant: the same parts, put together otherwise.
#include "faults/edits.h"

#include <algorithm>
#include <functional>
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
    regrouped();
    of_each_part();
    for (Edit& e : curve_edits_of(p_, node_)) out_.push_back(std::move(e));
    norms();
    of_each_term();
    lengths();
    factor_of_other_terms();
    functions();
    updated();
  }
  void exchange(bool copies) {
    if (!all_.is_operation()) return;
    swaps();
    if (copies) copied();
  }

 private:
  void keep(Expression made, Kind kind, std::vector<std::string> of) { out_.push_back({{std::move(made)}, {kind, std::move(of)}}); }
  /// What stands there is said.
  void keep(Expression made, Kind kind) {
    std::string text = text_of(p_, made);
    keep(std::move(made), kind, {text_, std::move(text)});
  }

  /// Two parts, one below each of two operands, exchanged.
  void swaps() {
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
            if (says_nothing(one) || says_nothing(other)) continue;
            std::swap(*a, *b);
            keep(made, one == other ? Kind::exchanged_alike : Kind::exchanged, {text_, one, other, text_of(p_, made)});
            std::swap(*a, *b);
          }
      }
  }
  static bool is_symmetric(Op op) { return op == Op::sum || op == Op::product || op == Op::minimum || op == Op::maximum; }
  static bool is_arithmetic(Op op) { return is_symmetric(op) || op == Op::difference || op == Op::quotient; }
  static bool is_associative(Op a, Op b) { return a == b && is_symmetric(a); }

  /// a (b c) for (a b) c, and the reverse.
  void regrouped() {
    if (!is_arithmetic(all_.step.op)) return;
    for (const std::size_t k : {0u, 1u}) {
      const Expression &inner = all_.of[k], &other = all_.of[1 - k];
      if (!inner.is_operation() || !is_arithmetic(inner.step.op) || is_associative(all_.step.op, inner.step.op)) continue;
      for (const std::size_t j : {0u, 1u}) {
        // The outer operation takes part j of the inner one alone.
        std::vector<Expression> outer{inner.of[j], other};
        if (k == 1) std::swap(outer[0], outer[1]);
        std::vector<Expression> made{operation(all_.step.op, outer), inner.of[1 - j]};
        if (j == 1) std::swap(made[0], made[1]);
        const Expression e = operation(inner.step.op, made);
        const bool is_bound = inner.step.op == Op::maximum || inner.step.op == Op::minimum;
        if (is_bound && (all_.step.op == Op::product || all_.step.op == Op::quotient))
          keep(e, Kind::factor_of_one_side,
               {text_, text_of(p_, other), verb_of(all_.step.op), inner.step.op == Op::maximum ? "maximum" : "minimum", text_of(p_, e)});
        else
          keep(e, Kind::grouped_otherwise);
      }
    }
  }

  /// A map x -> a x + b of a sum, taken of each of its parts.
  void of_each_part() {
    const Expression deep = expression_of(p_, node_, 5);
    std::vector<std::pair<Op, std::pair<bool, Expression>>> maps;  // from outside: operation, whether the constant is first, constant
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
    // Of each term, or of one factor of each.
    for (const int factor : {-1, 0, 1}) {
      std::vector<Expression> terms = at->of;
      bool is_there = true;
      for (Expression& term : terms) {
        if (factor < 0) {
          term = mapped(term);
        } else if (term.is_operation() && term.step.op == Op::product) {
          Expression& one = term.of[static_cast<std::size_t>(factor)];
          one = mapped(one);
        } else {
          is_there = false;
        }
      }
      if (!is_there) continue;
      const Expression e = operation(at->step.op, terms);
      keep(e, factor < 0 ? Kind::of_each_term : Kind::of_each_part, {text_, text_of(p_, e), text_of(p_, *at)});
    }
  }

  /// Other lengths of a vector.
  void norms() {
    if (all_.step.op != Op::root || !all_.of[0].is_operation() || all_.of[0].step.op != Op::sum) return;
    std::vector<Expression> squares;
    const std::function<bool(const Expression&)> collect = [&](const Expression& e) {
      if (e.is_operation() && e.step.op == Op::sum) return collect(e.of[0]) && collect(e.of[1]);
      if (!e.is_operation() || e.step.op != Op::square) return false;
      squares.push_back(operation(Op::magnitude, {e.of[0]}));
      return true;
    };
    if (!collect(all_.of[0]) || squares.size() < 2) return;
    for (const Op op : {Op::sum, Op::maximum}) {
      Expression e = squares[0];
      for (std::size_t k = 1; k < squares.size(); ++k) e = operation(op, {e, squares[k]});
      keep(e, op == Op::sum ? Kind::length_by_sum : Kind::length_by_longer);
    }
  }

  /// A function of a sum as the sum of the functions of its terms, and the reverse.
  void of_each_term() {
    const auto bends = [](Op op) { return op == Op::square || op == Op::root || op == Op::magnitude; };
    const auto is_sum = [](const Expression& e) { return e.is_operation() && (e.step.op == Op::sum || e.step.op == Op::difference); };
    if (bends(all_.step.op) && is_sum(all_.of[0])) {
      const Expression& inner = all_.of[0];
      const Op plus = all_.step.op == Op::square ? Op::sum : inner.step.op;
      const Expression e = operation(plus, {operation(all_.step.op, {inner.of[0]}), operation(all_.step.op, {inner.of[1]})});
      keep(e, Kind::function_of_each_term);
    }
    if (is_sum(all_) && all_.of[0].is_operation() && all_.of[1].is_operation() && all_.of[0].step.op == all_.of[1].step.op &&
        bends(all_.of[0].step.op)) {
      const Expression e = operation(all_.of[0].step.op, {operation(all_.step.op, {all_.of[0].of[0], all_.of[1].of[0]})});
      keep(e, Kind::function_of_sum);
    }
  }

  /// |a| - b for a a - b b, and the like of sums.
  void lengths() {
    if (all_.step.op != Op::sum && all_.step.op != Op::difference && all_.step.op != Op::comparison) return;
    for (const std::size_t k : {0u, 1u}) {
      if (!all_.of[k].is_operation() || all_.of[k].step.op != Op::square) continue;
      Expression e = all_;
      e.of[k] = all_.of[k].of[0];
      e.of[1 - k] = root_of(all_.of[1 - k]);
      keep(e, Kind::without_squares);
    }
    // A squared length beside a number that is a square.
    const auto is_squared_length = [](const Expression& e) {
      return e.is_operation() && e.step.op == Op::sum && e.of[0].is_operation() && e.of[0].step.op == Op::square &&
             e.of[1].is_operation() && e.of[1].step.op == Op::square;
    };
    for (const std::size_t k : {0u, 1u}) {
      if (!is_squared_length(all_.of[k]) || !is_constant(p_, all_.of[1 - k])) continue;
      Expression e = all_;
      for (Expression& side : e.of) side = root_of(side);
      keep(e, Kind::without_squares);
    }
  }
  /// x k + y: k multiplies y, or one of the terms of it, too.
  void factor_of_other_terms() {
    if (all_.step.op != Op::sum && all_.step.op != Op::difference) return;
    std::vector<const Expression*> terms;
    const std::function<void(const Expression&)> collect = [&](const Expression& e) {
      if (e.is_operation() && (e.step.op == Op::sum || e.step.op == Op::difference)) {
        for (const Expression& of : e.of) collect(of);
      } else {
        terms.push_back(&e);
      }
    };
    collect(all_);
    for (const Expression* from : terms) {
      if (!from->is_operation() || from->step.op != Op::product) continue;
      for (const std::size_t k : {0u, 1u})
        for (const Expression* to : terms) {
          if (to == from || to->node < 0 || from->of[k].node < 0) continue;
          const std::string factor = words_for(p_, from->of[k].node), term = words_for(p_, to->node);
          if (says_nothing(factor) || says_nothing(term)) continue;
          Expression e = all_;
          // The same term of the copy, by where it stands.
          std::vector<Expression*> before, after;
          parts(all_, before);
          parts(e, after);
          for (std::size_t at = 0; at < before.size(); ++at)
            if (before[at] == to) {
              *after[at] = operation(Op::product, {*to, from->of[k]});
              break;
            }
          keep(e, Kind::factor_of_another_term, {text_, factor, term});
        }
    }
  }

  /// One operation for another.
  void functions() {
    const auto of_held = [&](Expression made, Kind kind, const Expression& x) { keep(std::move(made), kind, {text_, text_of(p_, x)}); };
    switch (all_.step.op) {
      case Op::sum:
        return keep(operation(Op::product, all_.of), Kind::product_for_sum);
      case Op::product:
        return keep(operation(Op::sum, all_.of), Kind::sum_for_product);
      case Op::mix:
        for (const std::size_t k : {0u, 1u}) {
          if (!all_.of[k].is_operation() || all_.of[k].step.op != Op::mix) continue;
          for (const std::size_t j : {0u, 1u}) {
            Expression outer = all_, inner = all_.of[k];
            outer.of[k] = inner.of[j];
            inner.of[j] = std::move(outer);
            keep(inner, Kind::order_of_two_blends);
          }
        }
        return;
      case Op::fract:
        return of_held(clamped(all_.of[0]), Kind::held_for_wrapped, all_.of[0]);
      case Op::floor:
        return of_held(operation(Op::negation, {operation(Op::floor, {operation(Op::negation, {all_.of[0]})})}), Kind::ceiling_for_floor,
                       all_.of[0]);
      case Op::minimum:
      case Op::maximum:
        for (const std::size_t k : {0u, 1u})
          if (all_.of[k].is_operation() && all_.of[k].step.op == Op::product)
            for (const std::size_t j : {0u, 1u}) {
              const Expression e = operation(Op::mix, {all_.of[1 - k], all_.of[k].of[1 - j], all_.of[k].of[j]});
              keep(e, Kind::blended_for_bound);
            }
        if (all_.of[0].is_operation() && all_.of[0].step.op != all_.step.op &&
            (all_.of[0].step.op == Op::minimum || all_.of[0].step.op == Op::maximum)) {
          of_held(all_.of[0].of[0], Kind::clamp_left_out, all_.of[0].of[0]);
          of_held(operation(Op::fract, {all_.of[0].of[0]}), Kind::wrapped_for_held, all_.of[0].of[0]);
        }
        return;
      default:
        return;
    }
  }

  /// A part as it is after a step, elsewhere in the pass: life - dt for life.
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

  /// One part in the place of another.
  void copied() {
    std::vector<Expression*> all;
    Expression made = all_;
    parts(made, all);
    for (Expression* to : all)
      for (const Expression* from : all) {
        if (to == all[0] || to->node < 0 || from->node < 0 || to->node == from->node) continue;
        if (!is_leaf(node_of(p_, from->node).op) && node_of(p_, from->node).op != Op::lookup) continue;
        const std::string right = words_for(p_, to->node), wrong = words_for(p_, from->node);
        if (says_nothing(right) || says_nothing(wrong) || right == wrong || to->is_operation()) continue;
        const Expression kept = *to, other = *from;
        *to = other;
        keep(made, Kind::taken_for_another, {text_, wrong, right});
        *to = kept;
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
std::vector<Edit> exchanges_of(const Probe& p, std::int32_t node, bool copies) {
  std::vector<Edit> out;
  Edits(p, node, out).exchange(copies);
  return out;
}

}  // namespace rainref::faults
