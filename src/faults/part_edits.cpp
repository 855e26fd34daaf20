// What stands at one place in place of what is meant, taken from what else the pass has: another member of a record or of the uniforms,
// another condition, a factor that belongs to a unit, a constant of another component.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "faults/edits.h"
#include "faults/targets.h"

namespace rainref::faults {
namespace {

using perturbed::FormulaStep;
using perturbed::Op;
using Node = perturbed::Trace::Node;

/// "axis.x of wipers": the member "axis of wipers" and its component 'x'; of a scalar ' '.
struct Member {
  std::string name;
  char component;
};
std::optional<Member> member_of(const std::string& name) {
  const bool is_number = name.empty() || name.find_first_not_of("0123456789.-e+") == std::string::npos;
  if (is_number || name.find_first_of("(/") != std::string::npos || name.starts_with("-") || name == "row" || name == "column") return {};
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) return Member{name, ' '};
  if (dot + 1 >= name.size()) return {};
  return Member{name.substr(0, dot) + name.substr(dot + 2), name[dot + 1]};
}
std::string list_of(const std::string& member) {
  const std::size_t of = member.find(" of ");
  return of == std::string::npos ? "" : member.substr(of);
}
const std::string& name_of(const Probe& p, std::int32_t node) { return p.names[static_cast<std::size_t>(node)]; }

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
    if (const auto member = member_of(name_of(p, e->node)); member && member->component != ' ')
      used[member->name].emplace_back(e, member->component);
  }
  if (used.empty()) return out;
  // The nearest before, of each member.
  std::map<std::string, std::map<char, std::int32_t>> others;
  for (std::int32_t at = 0; at < node; ++at)
    if (node_of(p, at).op == Op::constant)
      if (const auto member = member_of(name_of(p, at))) others[member->name][member->component] = at;
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
      if (is_had && changes)
        out.push_back({{made},
                       fmt::format("another member: {} for {} in {}", wrong, right, text),
                       fmt::format("in {} {} stands where {} is meant", text, wrong, right)});
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
  const auto times = [&](float factor, const std::string& name, const std::string& sentence) {
    Expression made = is_angle ? operation(n.op, {operation(Op::product, {whole.of[0], number_of(factor)})})
                               : operation(Op::product, {whole, number_of(factor)});
    out.push_back({{std::move(made)}, name + ": " + text, fmt::format("{} {}", text, sentence)});
  };
  times(1 / (2 * pi), "factor 2 pi left out", "lacks a factor 2 pi: turns are taken for radians");
  times(2 * pi, "factor 2 pi too many", "has a factor 2 pi too much: radians are taken for turns");
  times(1 / pi, "factor pi left out", "lacks a factor pi");
  times(pi, "factor pi too many", "has a factor pi too much");
  times(180 / pi, "degrees", "is 180 / pi times what it should be: degrees in place of radians");
  times(pi / 180, "radians", "is pi / 180 of what it should be: an angle in radians is taken for degrees");
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
    std::string condition = is_choice ? fmt::format("the condition of {}", words_for(p, at))
                                      : fmt::format("{} < {}", words_for(p, other.of[0]), words_for(p, other.of[1]));
    if (condition.find_first_not_of(".<+-*/() ") == std::string::npos) continue;
    Expression asked = elsewhere(p, at, node, {});
    if (asked.step.kind != FormulaStep::Kind::met) continue;
    if (is_choice) asked.step.kind = FormulaStep::Kind::decided;
    const auto with = [&](Expression mask, const std::string& name, const std::string& sentence) {
      out.push_back({{operation(Op::choice, {whole.of[0], whole.of[1], std::move(mask)})}, name, sentence});
    };
    // What is added or taken in its place must show here.
    if (holds && !other_holds)
      with(
          operation(Op::product, {whole.of[2], asked}), fmt::format("condition too many: {} in {}", condition, text),
          fmt::format("in {} {} stands only where {} holds too, and {} elsewhere: one condition too many", text, first, condition, second));
    if (holds && other_holds)
      with(operation(Op::product, {whole.of[2], operation(Op::difference, {number_of(1), asked})}),
           fmt::format("condition too many: not {} in {}", condition, text),
           fmt::format("in {} {} stands only where {} does not hold: one condition too many", text, first, condition));
    if (!holds && other_holds)
      with(asked, fmt::format("another condition: {} in {}", condition, text),
           fmt::format("in {} {} decides between {} and {} in place of the condition that is meant", text, condition, first, second));
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
      const auto add = [&](const std::vector<std::size_t>& from, const std::string& name, const std::string& sentence) {
        JointEdit& one = out.emplace_back();
        one.edit.name = name;
        one.edit.sentence = sentence;
        for (std::size_t k = 0; k < v.size(); ++k) {
          one.nodes.push_back(v[k].node);
          Expression made = expression_of(p, v[k].node, 1);
          made.of[v[k].operand] = number_of(v[from[k]].value);
          one.edit.made.push_back(std::move(made));
        }
      };
      for (std::size_t k = 0; k < count; ++k)
        add(std::vector<std::size_t>(count, k), fmt::format("one constant for all: {} for {}", texts[k], right),
            fmt::format("the constants {} of the components, in {} and beside it, are all {}", right, words_for(p, v[0].node), texts[k]));
      std::vector<std::size_t> order(count);
      for (std::size_t k = 0; k < count; ++k) order[k] = k;
      while (std::next_permutation(order.begin(), order.end())) {
        std::string wrong;
        for (const std::size_t k : order) wrong += (wrong.empty() ? "" : ", ") + texts[k];
        add(order, fmt::format("constants exchanged: {} for {}", wrong, right),
            fmt::format("the constants {} of the components, in {} and beside it, stand in the order {}", right, words_for(p, v[0].node),
                        wrong));
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
      one.edit.name = fmt::format("branch left out: {}", all);
      one.edit.sentence = fmt::format("{} stand where a condition {}; the branch, or the return, that should give others there is left out",
                                      all, holds ? "holds" : "does not hold");
    }
  return out;
}

}  // namespace rainref::faults
