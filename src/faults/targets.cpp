#include "faults/targets.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <set>

#include <fmt/format.h>

#include "faults/members.h"
#include "faults/place_faults.h"
#include "faults/text.h"

namespace rainref::faults {
namespace {

using perturbed::Op;
using perturbed::Substitution;
using Node = perturbed::Trace::Node;

constexpr std::size_t most_targets = 400, most_sources = 400;
constexpr std::int32_t most_alike = 6;  // places of one shape that are solved separately
constexpr std::int32_t most_back = 64;

/// True if it has a name of its own.
bool is_named(Op op) { return is_leaf(op) || op == Op::lookup; }
/// Adjacent operands of the first two or three slots, while their operations are equal.
void add_below_outputs(const Probe& p, std::vector<std::vector<std::int32_t>>& out) {
  std::set<std::vector<std::int32_t>> done(out.begin(), out.end());
  for (std::size_t first = 0; first < p.outputs.size() && first < 8; ++first)
    for (const std::size_t n : {3u, 2u}) {
      if (first + n > p.outputs.size()) continue;
      std::vector<std::vector<std::int32_t>> open{
          {p.outputs.begin() + static_cast<std::ptrdiff_t>(first), p.outputs.begin() + static_cast<std::ptrdiff_t>(first + n)}};
      constexpr std::size_t most = 60;
      for (std::size_t at = 0; at < open.size() && open.size() < most; ++at) {
        const std::vector<std::int32_t> v = open[at];
        const bool is_none = std::any_of(v.begin(), v.end(), [](std::int32_t i) { return i < 0; });
        if (is_none || std::set<std::int32_t>(v.begin(), v.end()).size() < n) continue;
        if (std::any_of(v.begin(), v.end(), [&](std::int32_t i) { return node_of(p, i).op != node_of(p, v[0]).op; })) continue;
        if (done.insert(v).second) out.push_back(v);
        for (std::size_t k = 0; k < 4; ++k) {
          std::vector<std::int32_t>& below = open.emplace_back();
          for (const std::int32_t i : v) below.push_back(node_of(p, i).of[k]);
        }
      }
    }
}

/// Number of values of the source's shape from the source to the target.
std::int32_t steps_back(const Probe& p, std::int32_t source, std::int32_t target) {
  std::int32_t back = 0;
  for (std::int32_t m = source; m < target; ++m) back += node_of(p, m).shape == node_of(p, source).shape;
  return back;
}

}  // namespace

bool is_leaf(Op op) { return op == Op::constant || op == Op::load || op == Op::fetch || op == Op::index; }

std::vector<std::vector<std::int32_t>> vectors_in(const Probe& p) {
  std::vector<std::vector<std::int32_t>> out;
  for (const std::vector<std::size_t>& v : vector_values_of(p))
    if (p.trace.met.at(p.trace.nodes[v[0]].shape) == 1) out.emplace_back(v.begin(), v.end());
  std::map<std::uint32_t, std::vector<std::int32_t>> alike;
  for (std::int32_t at = 0; at < static_cast<std::int32_t>(p.trace.nodes.size()); ++at)
    if (const std::int32_t count = p.trace.met.at(node_of(p, at).shape); count == 2 || count == 3)
      if (node_of(p, at).op != Op::comparison) alike[node_of(p, at).shape].push_back(at);
  for (auto& [shape, nodes] : alike) out.push_back(std::move(nodes));
  add_below_outputs(p, out);
  return out;
}

std::vector<Target> targets_of(const Probe& p) {
  std::vector<Target> out;
  const std::vector<int> uses = uses_of(p.trace);
  const auto add = [&](const std::vector<std::int32_t>& nodes) {
    const Node& n = node_of(p, nodes[0]);
    if (is_leaf(n.op)) return;
    if (n.op != Op::lookup)
      for (std::int8_t k = 0; k < (n.op == Op::choice ? 2 : 4); ++k)
        if (std::all_of(nodes.begin(), nodes.end(), [&](std::int32_t at) { return node_of(p, at).of[static_cast<std::size_t>(k)] >= 0; }))
          out.push_back({nodes, k});
    // A value with one use is solved for as an operand there.
    if (n.op != Op::comparison && uses[static_cast<std::size_t>(nodes[0])] != 1) out.push_back({nodes, Substitution::result});
  };
  std::vector<std::vector<std::int32_t>> together = vectors_in(p);
  std::sort(together.begin(), together.end(), [](const auto& a, const auto& b) { return a[0] > b[0]; });
  for (const auto& v : together) add(v);
  for (std::int32_t at = static_cast<std::int32_t>(p.trace.nodes.size()); at-- > 0;)
    if (p.trace.met.at(node_of(p, at).shape) <= most_alike) add({at});
  // Each takes about a hundred evaluations to solve.
  const std::size_t most = std::clamp<std::size_t>(most_steps / 100 / std::max<std::size_t>(p.trace.nodes.size(), 1), 20, most_targets);
  if (out.size() > most) out.resize(most);
  return out;
}

std::vector<Source> numbers_of(const Probed& p, std::size_t components) {
  std::vector<Source> out;
  // Integers last.
  for (const bool is_whole : {false, true})
    for (const scene::Member& m : p.pass.block.members) {
      if (is_padding(m) || (m.scalar != scene::Scalar::float32) != is_whole) continue;
      std::vector<float> all(static_cast<std::size_t>(m.components));
      std::memcpy(all.data(), p.c.uniforms.data() + m.offset, 4 * all.size());
      if (is_whole)
        for (float& v : all) v = static_cast<float>(std::bit_cast<std::int32_t>(v));
      const int effort = is_whole ? 1 : 0;
      if (components > 1 && all.size() >= components)
        out.push_back({{}, {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(components)}, m.name, effort});
      for (std::size_t k = 0; k < all.size() && all.size() <= 4; ++k)
        out.push_back({{}, {all[k]}, part_name(m, static_cast<int>(k)), effort});
    }
  // The same component of two uniforms that differ in their axis: e_u.y and e_v.y.
  if (components == 2)
    for (const scene::Member& a : p.pass.block.members)
      for (const scene::Member& b : p.pass.block.members) {
        if (a.scalar != scene::Scalar::float32 || b.scalar != a.scalar || a.components != b.components || !are_axes(a, b)) continue;
        const std::byte* const all = p.c.uniforms.data();
        for (int k = 0; k < a.components; ++k)
          out.push_back(
              {{}, {number_at<float>(all, offset_of(a, k)), number_at<float>(all, offset_of(b, k))}, a.name + "." + component_name(k), 0});
      }
  // A length in units of the height in place of the width, or the reverse.
  if (p.model.height() > 0 && p.model.width() != p.model.height()) {
    const auto width = static_cast<float>(p.model.width()), height = static_cast<float>(p.model.height());
    out.push_back({{}, {width / height}, "width / height", 0});
    out.push_back({{}, {height / width}, "height / width", 0});
  }
  for (const auto& [number, name] : {std::pair(3.14159265f, "pi"), std::pair(6.2831853f, "2 pi")}) out.push_back({{}, {number}, name, 3});
  for (const float number : {2.0f, 3.0f, 4.0f, 0.5f, 0.25f, 255.0f, 57.29578f, 0.017453293f, 1.0f, -1.0f})
    out.push_back({{}, {number}, fmt::format("{:.5g}", number), 3});
  return out;
}

namespace {

/// Values that the pass computes later, and not from the target: another order of the text would have them there. Values that are equal in
/// every invocation are numbers.
void add_later(const Probe& p, const Target& t, std::vector<Source>& out) {
  constexpr std::size_t most_later = 40;
  const auto count = static_cast<std::int32_t>(p.trace.nodes.size());
  std::vector<bool> is_of_target(static_cast<std::size_t>(count));
  const auto is_in = [&](std::int32_t at) { return std::find(t.nodes.begin(), t.nodes.end(), at) != t.nodes.end(); };
  constexpr std::int32_t most_alike_later = 8;  // distinguished by their order, if they are not made by a loop
  std::set<std::pair<std::string, float>> names;
  std::size_t added = 0;
  for (std::int32_t at = *std::min_element(t.nodes.begin(), t.nodes.end()); at < count && added < most_later; ++at) {
    const Node& n = node_of(p, at);
    bool follows = is_in(at);
    for (const std::int32_t of : n.of) follows = follows || (of >= 0 && is_of_target[static_cast<std::size_t>(of)]);
    is_of_target[static_cast<std::size_t>(at)] = follows;
    if (follows || n.op == Op::comparison || n.op == Op::coordinate || n.op == Op::level || n.op == Op::argument || n.op == Op::stored)
      continue;
    const std::string text = words_for(p, at);
    if (says_nothing(text) || !names.insert({text, n.value}).second) continue;
    if (n.op == Op::constant) {
      if (!is_of_list(text) && text != "row") out.push_back({{}, {n.value}, text, 1}), ++added;
    } else if (p.trace.met.at(n.shape) <= most_alike_later) {
      out.push_back({{at}, {}, text, 2}), ++added;
    }
  }
}

}  // namespace

std::vector<Source> sources_for(const Probe& p, const Target& t, const std::vector<std::vector<std::int32_t>>& groups,
                                const std::vector<Source>& numbers) {
  std::vector<Source> out = numbers;  // few, and tried first: if many nearly fit, not all are tried
  const std::int32_t before = *std::min_element(t.nodes.begin(), t.nodes.end());
  const auto effort = [&](std::int32_t node) { return is_named(node_of(p, node).op) ? 0 : 1; };
  if (t.nodes.size() > 1)
    for (const auto& group : groups) {
      if (group.size() != t.nodes.size() || *std::max_element(group.begin(), group.end()) >= before) continue;
      out.push_back({group, {}, words_for(p, group[0]), effort(group[0])});
      std::vector<std::size_t> order(group.size());
      for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
      while (std::next_permutation(order.begin(), order.end())) {
        std::vector<std::int32_t> other;
        std::string text;
        for (const std::size_t k : order) {
          other.push_back(group[k]);
          text += (text.empty() ? "(" : ", ") + words_for(p, group[k]);
        }
        out.push_back({other, {}, text + ")", effort(group[0]) + 1});
      }
    }
  std::map<std::uint32_t, std::int32_t> after;
  for (std::int32_t m = before; m-- > 0 && out.size() < most_sources + numbers.size();) {
    const std::int32_t back = ++after[node_of(p, m).shape];
    if (back > most_back || node_of(p, m).op == Op::comparison || node_of(p, m).op == Op::coordinate) continue;
    out.push_back({{m}, {}, words_for(p, m), effort(m)});
  }
  add_later(p, t, out);
  return out;
}

float number_of(const Probe& p, const Source& s, std::size_t c) {
  if (s.nodes.empty()) return s.numbers[s.numbers.size() == 1 ? 0 : c];
  return node_of(p, s.nodes[s.nodes.size() == 1 ? 0 : c]).value;
}
void take(const Probe& p, const Source& s, const Target& t, std::vector<Substitution>& places) {
  for (std::size_t c = 0; c < places.size(); ++c) {
    places[c].ahead = -1;
    if (s.nodes.empty()) {
      places[c].back = 0;
      places[c].number = number_of(p, s, c);
      continue;
    }
    const std::int32_t node = s.nodes[s.nodes.size() == 1 ? 0 : c];
    places[c].source = node_of(p, node).shape;
    const bool is_later = node > t.nodes[c];
    places[c].ahead = is_later ? node_of(p, node).occurrence : -1;
    places[c].back = is_later ? 0 : steps_back(p, node, t.nodes[c]);
  }
}

}  // namespace rainref::faults
