// What stands at one place in place of what is meant, taken from what else the pass has: another member of a record or of the uniforms,
// another condition, a factor that belongs to a unit, a constant of another component.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "faults/edits.h"
#include "faults/targets.h"
#include "faults/text.h"

namespace rainref::faults {
namespace {

using perturbed::FormulaStep;
using perturbed::Op;
using Node = perturbed::Trace::Node;

const std::string& leaf_name(const Probe& p, std::int32_t node) { return p.names[static_cast<std::size_t>(node)]; }

}  // namespace

std::vector<Edit> member_edits_of(const Probe& p, std::int32_t node) {
  std::vector<Edit> out;
  Expression made = expression_of(p, node, 3);
  if (!made.is_operation()) return out;
  std::vector<Expression*> all;
  parts(made, all);
  std::map<std::string, std::vector<std::pair<Expression*, char>>> used;  // leaves of each vector
  for (Expression* e : all) {
    if (e->is_operation() || e->node < 0 || node_of(p, e->node).op != Op::constant) continue;
    if (const auto member = member_of(leaf_name(p, e->node)); member && member->component != ' ')
      used[member->name].emplace_back(e, member->component);
  }
  if (used.empty()) return out;
  // The nearest before, of each member.
  std::map<std::string, std::map<char, std::int32_t>> others;
  for (std::int32_t at = 0; at < node; ++at)
    if (node_of(p, at).op == Op::constant)
      if (const auto member = member_of(leaf_name(p, at))) others[member->name][member->component] = at;
  const std::string text = words_for(p, node);
  for (const auto& [right, leaves] : used)
    for (const auto& [wrong, parts_of] : others) {
      const auto has = [&parts_of = parts_of](const auto& leaf) { return parts_of.contains(leaf.second); };
      if (wrong == right || list_of(wrong) != list_of(right) || !std::all_of(leaves.begin(), leaves.end(), has)) continue;
      std::vector<Expression> kept;
      bool is_had = true, changes = false;
      for (const auto& [leaf, component] : leaves) {
        const std::int32_t from = parts_of.at(component);
        changes |= node_of(p, from).value != node_of(p, leaf->node).value;
        kept.push_back(*leaf);
        *leaf = elsewhere(p, from, node, {});
        is_had &= can_be_had(*leaf);
      }
      if (is_had && changes) out.push_back({{made}, {Kind::another_member, {text, wrong, right}}});
      for (std::size_t k = 0; k < leaves.size(); ++k) *leaves[k].first = kept[k];
    }
  return out;
}

std::vector<Edit> unit_edits_of(const Probe& p, std::int32_t node) {
  std::vector<Edit> out;
  const Node& n = node_of(p, node);
  const bool is_angle = n.op == Op::sine || n.op == Op::cosine;
  const auto is_number = [&](std::size_t k) { return n.of[k] >= 0 && node_of(p, n.of[k]).op == Op::constant; };
  if (!is_angle && !((n.op == Op::product || n.op == Op::quotient) && (is_number(0) || is_number(1)))) return out;
  const Expression whole = expression_of(p, node, 1);
  const std::string text = words_for(p, is_angle ? n.of[0] : node);
  constexpr float pi = std::numbers::pi_v<float>;
  const auto times = [&](float factor, Kind kind) {
    out.push_back(
        {{is_angle ? operation(n.op, {product(whole.of[0], number_of(factor))}) : product(whole, number_of(factor))}, {kind, {text}}});
  };
  times(1 / (2 * pi), Kind::factor_2_pi_left_out);
  times(2 * pi, Kind::factor_2_pi_too_many);
  times(1 / pi, Kind::factor_pi_left_out);
  times(pi, Kind::factor_pi_too_many);
  times(180 / pi, Kind::degrees_there);
  times(pi / 180, Kind::radians_there);
  return out;
}

std::vector<Edit> condition_edits_of(const Probe& p, std::int32_t node) {
  std::vector<Edit> out;
  const Node& n = node_of(p, node);
  if (n.op != Op::choice) return out;
  const bool holds = n.with[2] != 0;
  const std::string text = words_for(p, node), first = words_for(p, n.of[0]), second = words_for(p, n.of[1]);
  const Expression whole = expression_of(p, node, 1);
  constexpr std::size_t most = 24;
  std::set<std::uint32_t> done;
  for (std::int32_t at = node; at-- > 0 && done.size() < most;) {
    const Node& other = node_of(p, at);
    const bool is_choice = other.op == Op::choice;
    if ((!is_choice && other.op != Op::comparison) || !done.insert(other.shape).second) continue;
    const bool other_holds = (is_choice ? other.with[2] : other.value) != 0;
    const std::string condition = condition_text(p, at);
    if (says_nothing(condition)) continue;
    Expression asked = elsewhere(p, at, node, {});
    if (asked.step.kind != FormulaStep::Kind::met) continue;
    if (is_choice) asked.step.kind = FormulaStep::Kind::decided;
    const auto with = [&](Expression mask, Kind kind) {
      out.push_back({{operation(Op::choice, {whole.of[0], whole.of[1], std::move(mask)})}, {kind, {text, condition, first, second}}});
    };
    // What is added or taken in its place must show here.
    if (holds && !other_holds) with(product(whole.of[2], asked), Kind::condition_too_many);
    if (holds && other_holds) with(product(whole.of[2], difference(number_of(1), asked)), Kind::no_condition_too_many);
    if (!holds && other_holds) with(asked, Kind::another_condition);
  }
  return out;
}

std::vector<JointEdit> constant_edits_of(const Probe& p) {
  std::vector<JointEdit> out;
  // What takes a node first, and as what.
  std::map<std::int32_t, Op> taker;
  for (const Node& n : p.trace.nodes)
    for (const std::int32_t of : n.of)
      if (of >= 0) taker.try_emplace(of, n.op);
  struct Place {
    std::int32_t node;
    std::size_t operand;
    float value;
  };
  std::vector<Place> all;
  for (std::int32_t at = 0; at < static_cast<std::int32_t>(p.trace.nodes.size()); ++at) {
    const Node& n = node_of(p, at);
    const bool takes_number = n.op == Op::product || n.op == Op::sum || n.op == Op::difference || n.op == Op::quotient ||
                              n.op == Op::power || n.op == Op::minimum || n.op == Op::maximum;
    if (!takes_number || n.occurrence != 0) continue;
    for (const std::size_t k : {0u, 1u})
      if (n.of[k] >= 0 && node_of(p, n.of[k]).op == Op::constant && n.of[1 - k] >= 0 && node_of(p, n.of[1 - k]).op != Op::constant)
        all.push_back({at, k, n.with[k]});
  }
  constexpr std::int32_t near = 12;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const std::size_t count : {3u, 2u}) {
      std::vector<Place> v{all[i]};
      const auto taken_by = [&](std::int32_t node) {
        const auto found = taker.find(node);
        return found == taker.end() ? Op::constant : found->second;
      };
      for (std::size_t j = i + 1; j < all.size() && v.size() < count; ++j) {
        if (all[j].node - v.back().node > near) break;
        if (node_of(p, all[j].node).op == node_of(p, v[0].node).op && all[j].operand == v[0].operand &&
            taken_by(all[j].node) == taken_by(v[0].node))
          v.push_back(all[j]);
      }
      std::set<float> values;
      std::set<std::uint32_t> shapes;
      for (const Place& place : v) values.insert(place.value), shapes.insert(node_of(p, place.node).shape);
      if (v.size() < count || values.size() < 2 || shapes.size() < v.size()) continue;
      std::string right;
      std::vector<std::string> texts;
      for (const Place& place : v) {
        texts.push_back(words_for(p, node_of(p, place.node).of[place.operand]));
        right += (right.empty() ? "" : ", ") + texts.back();
      }
      const auto add = [&](const std::vector<std::size_t>& from, Kind kind, const std::string& wrong) {
        JointEdit& one = out.emplace_back();
        one.edit.what = {kind, {words_for(p, v[0].node), wrong, right}};
        for (std::size_t k = 0; k < v.size(); ++k) {
          one.nodes.push_back(v[k].node);
          Expression made = expression_of(p, v[k].node, 1);
          made.of[v[k].operand] = number_of(v[from[k]].value);
          one.edit.made.push_back(std::move(made));
        }
      };
      for (std::size_t k = 0; k < count; ++k) add(std::vector<std::size_t>(count, k), Kind::one_constant_for_all, texts[k]);
      std::vector<std::size_t> order(count);
      for (std::size_t k = 0; k < count; ++k) order[k] = k;
      while (std::next_permutation(order.begin(), order.end())) {
        std::string wrong;
        for (const std::size_t k : order) wrong += (wrong.empty() ? "" : ", ") + texts[k];
        add(order, Kind::constants_exchanged, wrong);
      }
    }
  return out;
}

std::vector<JointEdit> branch_edits_of(const Probe& p) {
  std::vector<JointEdit> out;
  std::vector<std::int32_t> choices;
  for (std::int32_t at = 0; at < static_cast<std::int32_t>(p.trace.nodes.size()); ++at)
    if (node_of(p, at).op == Op::choice && node_of(p, at).occurrence == 0) choices.push_back(at);
  constexpr std::int32_t near = 10;
  for (std::size_t i = 0; i < choices.size(); ++i)
    for (const std::size_t count : {4u, 3u, 2u}) {
      if (i + count > choices.size()) continue;
      std::vector<std::int32_t> v(choices.begin() + static_cast<std::ptrdiff_t>(i),
                                  choices.begin() + static_cast<std::ptrdiff_t>(i + count));
      std::set<std::uint32_t> shapes;
      bool are_together = true;
      for (std::size_t k = 0; k < count; ++k) {
        shapes.insert(node_of(p, v[k]).shape);
        are_together &= node_of(p, v[k]).with[2] == node_of(p, v[0]).with[2] && (k == 0 || v[k] - v[k - 1] <= near);
      }
      if (!are_together || shapes.size() < count) continue;
      const bool holds = node_of(p, v[0]).with[2] != 0;
      // The side that is not taken here, everywhere.
      JointEdit& one = out.emplace_back();
      one.nodes = v;
      std::string all;
      for (const std::int32_t at : v) {
        const std::int32_t side = node_of(p, at).of[holds ? 1 : 0];
        all += (all.empty() ? "" : ", ") + words_for(p, side);
        one.edit.made.push_back(expression_of(p, at, 1).of[holds ? 1 : 0]);
      }
      one.edit.what = {holds ? Kind::branch_left_out : Kind::other_branch_left_out, {all}};
    }
  return out;
}

}  // namespace rainref::faults
