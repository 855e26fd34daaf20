// A factor or a term that stands at another place of the pass than it should: before a clamp, a curve or a sum, or after it.
#include <algorithm>
#include <set>

#include "faults/edits.h"
#include "faults/targets.h"
#include "faults/text.h"

namespace rainref::faults {
namespace {

using perturbed::FormulaStep;
using perturbed::Op;
using Node = perturbed::Trace::Node;

class Moves {
 public:
  Moves(const Probe& p, const std::vector<Nodes>& vectors, std::vector<JointEdit>& out) : p_(p), out_(out) {
    users_.resize(p.trace.nodes.size());
    for (std::int32_t at = 0; at < count(); ++at)
      for (const std::int32_t of : node_of(p, at).of)
        if (of >= 0) users_[static_cast<std::size_t>(of)].push_back(at);
    for (const Nodes& v : vectors) vectors_.push_back(v);
  }
  void run() {
    // From the results down: what is moved there counts for more.
    for (std::int32_t at = count(); at-- > 0 && out_.size() < most;) {
      const Node& n = node_of(p_, at);
      if (n.occurrence != 0 || p_.trace.met.at(n.shape) > 1) continue;
      if (n.op != Op::product && n.op != Op::sum && n.op != Op::difference && n.op != Op::quotient) continue;
      if (n.op == Op::product || n.op == Op::quotient) inward(at);
      for (const std::size_t k : {0u, 1u})
        if (n.op != Op::difference && n.op != Op::quotient)
          of_operand({at}, k);
        else if (k == 1)
          of_operand({at}, k);
    }
    for (const Nodes& v : vectors_) {
      if (out_.size() >= most) return;
      const Op op = node_of(p_, v[0]).op;
      if (op != Op::product && op != Op::sum && op != Op::difference && op != Op::quotient) continue;
      if (std::any_of(v.begin(), v.end(),
                      [&](std::int32_t i) { return node_of(p_, i).op != op || p_.trace.met.at(node_of(p_, i).shape) > 3; }))
        continue;
      for (const std::size_t k : {0u, 1u})
        if (k == 1 || (op != Op::difference && op != Op::quotient)) of_operand(v, k);
    }
  }

 private:
  static constexpr std::size_t most = 500;
  std::int32_t count() const { return static_cast<std::int32_t>(p_.trace.nodes.size()); }

  /// Where what stands at `from` counts: nodes that it is a part of, the nearest first, and vectors whose components all are.
  std::vector<Nodes> above(const Nodes& from) const {
    std::vector<Nodes> out;
    std::vector<std::set<std::int32_t>> reached;
    for (const std::int32_t start : from) {
      std::set<std::int32_t>& met = reached.emplace_back();
      std::vector<std::int32_t> open{start};
      constexpr std::size_t most_reached = 400;
      for (std::size_t k = 0; k < open.size() && met.size() < most_reached; ++k)
        for (const std::int32_t user : users_[static_cast<std::size_t>(open[k])])
          if (met.insert(user).second) open.push_back(user);
    }
    constexpr std::size_t most_single = 8, most_vectors = 8;
    if (from.size() == 1) {
      // Along the way that has no other: where it branches, the components of a vector begin.
      std::int32_t at = from[0];
      while (out.size() < most_single && users_[static_cast<std::size_t>(at)].size() == 1) {
        at = users_[static_cast<std::size_t>(at)][0];
        if (p_.trace.met.at(node_of(p_, at).shape) == 1) out.push_back({at});
      }
    }
    std::size_t vectors = 0;
    // The last of them are nearest to the results.
    for (const Nodes& v : vectors_) {
      if (vectors == most_vectors) break;
      const bool is_above = from.size() == 1 ? std::all_of(v.begin(), v.end(), [&](std::int32_t i) { return reached[0].contains(i); })
                                             : v.size() == from.size() && [&] {
                                                 for (std::size_t k = 0; k < v.size(); ++k)
                                                   if (!reached[k].contains(v[k])) return false;
                                                 return true;
                                               }();
      if (!is_above) continue;
      out.push_back(v);
      ++vectors;
    }
    return out;
  }

  void of_operand(const Nodes& from, std::size_t k) {
    const Node& n = node_of(p_, from[0]);
    const std::int32_t what = n.of[k];
    if (what < 0) return;
    for (const std::int32_t at : from)
      if (node_of(p_, at).of[k] != what) return;  // one for all components
    const bool is_factor = n.op == Op::product || n.op == Op::quotient;
    const std::string name = words_for(p_, what);
    // What cannot be said in full is rather something else.
    if (gaps(name) > 1 || name == "2" || name == "0.5" || name == "4") return;
    const float v = node_of(p_, what).value;
    if (v == (is_factor ? 1.0f : 0.0f)) return;
    const auto is_of_its_kind = [&](std::int32_t at) {
      const Op op = node_of(p_, at).op;
      return is_factor ? op == Op::product || op == Op::quotient : op == Op::sum || op == Op::difference;
    };
    for (const Nodes& to : above(from)) {
      if (out_.size() >= most) return;
      // Within the same kind of operation it gives the same wherever it stands, or is grouped otherwise.
      if (is_of_its_kind(to[0])) continue;
      JointEdit one;
      one.nodes = from;
      for (const std::int32_t at : from) one.edit.made.push_back(expression_of(p_, at, 1).of[1 - k]);
      bool is_had = std::all_of(one.edit.made.begin(), one.edit.made.end(), can_be_had);
      for (const std::int32_t at : to) {
        one.nodes.push_back(at);
        Expression moved = elsewhere(p_, what, at, from);
        is_had &= can_be_had(moved);
        one.edit.made.push_back(operation(n.op, {itself(at), std::move(moved)}));
      }
      if (!is_had || one.nodes.size() > perturbed::Rewrites().size()) continue;
      one.edit.what = {to.size() > 1 ? Kind::moved_outward_of_all : Kind::moved_outward,
                       {words_for(p_, from[0]), name, words_for(p_, to[0]), verb_of(n.op)}};
      out_.push_back(std::move(one));
    }
  }

  /// A factor of what a clamp holds, within it and on one term alone: min(a g + b, c) for min(a + b, c) g.
  void inward(std::int32_t at) {
    constexpr int depth = 4;
    const Expression all = expression_of(p_, at, depth);
    for (const std::size_t k : {0u, 1u}) {
      if (all.step.op == Op::quotient && k == 1) continue;  // what divides, not what is divided
      const Expression factor = as_part(all.of[1 - k]);
      each_term(all.of[k], [&](const Expression& sum, std::size_t j) {
        Expression made = all.of[k];
        Expression* const term = &find(made, sum.node)->of[j];
        const std::string to = text_of(p_, *term), by = text_of(p_, factor);
        *term = operation(all.step.op, {*term, factor});
        JointEdit& one = out_.emplace_back();
        one.nodes = {at};
        one.edit.made.push_back(std::move(made));
        one.edit.what = {Kind::moved_inward, {text_of(p_, all.of[k]), by, to, verb_of(all.step.op)}};
      });
    }
  }
  /// f(sum, which of its terms) of the sums that clamps hold.
  template <class F>
  void each_term(const Expression& e, const F& f) const {
    if (!e.is_operation() || (e.step.op != Op::minimum && e.step.op != Op::maximum)) return;
    for (const Expression& held : e.of) {
      if (held.is_operation() && (held.step.op == Op::sum || held.step.op == Op::difference))
        for (const std::size_t j : {0u, 1u}) f(held, j);
      else
        each_term(held, f);
    }
  }
  static Expression* find(Expression& e, std::int32_t node) {
    std::vector<Expression*> all;
    parts(e, all);
    return *std::find_if(all.begin(), all.end(), [node](const Expression* part) { return part->is_operation() && part->node == node; });
  }

  const Probe& p_;
  std::vector<JointEdit>& out_;
  std::vector<std::vector<std::int32_t>> users_;
  std::vector<Nodes> vectors_;
};

}  // namespace

std::vector<JointEdit> moved_edits_of(const Probe& p, const std::vector<Nodes>& vectors) {
  std::vector<JointEdit> out;
  Moves(p, vectors, out).run();
  return out;
}

}  // namespace rainref::faults
