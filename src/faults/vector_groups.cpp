// Groups nodes of a probe: the components of vectors, the channels of one lookup.
#include <algorithm>
#include <set>
#include <string>

#include "faults/place_faults.h"
#include "faults/targets.h"
#include "faults/text.h"

namespace rainref::faults {

using perturbed::Op;
using Node = perturbed::Trace::Node;

bool are_alike(const Probe& p, const Nodes& v) {
  std::set<std::uint32_t> shapes;
  for (const std::int32_t node : v) shapes.insert(node_of(p, node).shape);
  return shapes.size() < v.size();
}
std::int32_t period_of(const Probe& p, const Nodes& v) {
  const auto n = static_cast<std::int32_t>(v.size());
  for (std::int32_t k = 0; k < n; ++k) {
    const Node& node = node_of(p, v[static_cast<std::size_t>(k)]);
    if (node.shape != node_of(p, v[0]).shape || node.occurrence % n != k) return 0;
  }
  return p.trace.met.at(node_of(p, v[0]).shape) % n == 0 ? n : 0;
}

std::vector<Nodes> vector_groups_of(const Probe& p) {
  std::vector<Nodes> out;
  std::set<std::vector<std::uint32_t>> done;
  const auto add = [&](Nodes v) {
    if (v.size() < 2 || v.size() > 3 || std::any_of(v.begin(), v.end(), [](std::int32_t i) { return i < 0; })) return;
    if (std::set<std::int32_t>(v.begin(), v.end()).size() < v.size()) return;
    std::vector<std::uint32_t> shapes;
    for (const std::int32_t i : v) {
      if (is_leaf(node_of(p, i).op) || node_of(p, i).op == Op::lookup) return;
      shapes.push_back(node_of(p, i).shape);
    }
    // Components with equal shape are distinguished by their order, in a loop from round to round.
    if (are_alike(p, v) && p.trace.met.at(shapes[0]) > 3 && period_of(p, v) == 0) return;
    if (done.insert(shapes).second) out.push_back(std::move(v));
  };
  for (std::int32_t at = static_cast<std::int32_t>(p.trace.nodes.size()); at-- > 0;) {
    const Node& n = node_of(p, at);
    if (n.occurrence != 0 || n.op != Op::sum || n.of[0] < 0 || n.of[1] < 0) continue;
    const auto squared = [&](std::int32_t i) { return i >= 0 && node_of(p, i).op == Op::square ? node_of(p, i).of[0] : -1; };
    const Node& first = node_of(p, n.of[0]);
    if (first.op == Op::sum) add({squared(first.of[0]), squared(first.of[1]), squared(n.of[1])});
    add({squared(n.of[0]), squared(n.of[1])});
  }
  // Their adjacent operands, while the operations are equal, and the leaves.
  const auto add_below = [&](Nodes top, std::size_t most) {
    std::vector<Nodes> open{std::move(top)};
    for (std::size_t at = 0; at < open.size() && open.size() < most; ++at) {
      const Nodes v = open[at];
      if (std::any_of(v.begin(), v.end(), [](std::int32_t i) { return i < 0; })) continue;
      add(v);
      if (std::any_of(v.begin(), v.end(), [&](std::int32_t i) { return node_of(p, i).op != node_of(p, v[0]).op; })) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        Nodes& below = open.emplace_back();
        for (const std::int32_t i : v) below.push_back(node_of(p, i).of[k]);
      }
    }
  };
  for (const std::vector<std::size_t>& v : vectors_of(p)) add_below({v.begin(), v.end()}, 12);
  for (std::size_t first = 0; first < p.outputs.size() && first < 8; ++first)
    for (const std::size_t n : {3u, 2u}) {
      if (first + n > p.outputs.size()) continue;
      add_below({p.outputs.begin() + static_cast<std::ptrdiff_t>(first), p.outputs.begin() + static_cast<std::ptrdiff_t>(first + n)}, 300);
    }
  // Two adjacent nodes with equal operations of equal operations: members of a record have different names.
  const auto is_alike = [&](const Node& a, const Node& b) {
    for (std::size_t k = 0; k < a.of.size(); ++k) {
      if ((a.of[k] < 0) != (b.of[k] < 0)) return false;
      const bool takes_sum = a.op == Op::choice || a.op == Op::mix;  // one row of a matrix may be a sum, and another a product
      if (a.of[k] >= 0 && !takes_sum && node_of(p, a.of[k]).op != node_of(p, b.of[k]).op) return false;
    }
    return true;
  };
  constexpr std::int32_t near = 24;
  constexpr std::size_t most_pairs = 60;
  std::size_t pairs = 0;
  for (std::int32_t b = static_cast<std::int32_t>(p.trace.nodes.size()); b-- > 0 && pairs < most_pairs;) {
    const Node& second = node_of(p, b);
    if (second.occurrence != 0 || (second.op != Op::choice && second.op != Op::mix && second.op != Op::sum && second.op != Op::difference))
      continue;
    for (std::int32_t a = b - 1; a >= 0 && b - a <= near; --a) {
      const Node& first = node_of(p, a);
      if (first.op != second.op) continue;
      if (first.occurrence == 0 && first.shape != second.shape && is_alike(first, second)) add_below({a, b}, 8), ++pairs;
      break;
    }
  }
  return out;
}

std::vector<Nodes> lookups_of(const Probe& p) {
  std::vector<Nodes> out;
  std::set<std::uint32_t> done;
  const auto image = [&](std::int32_t at) { return image_of_channel(words_for(p, at)); };
  constexpr std::size_t most = 24;
  const auto count = static_cast<std::int32_t>(p.trace.nodes.size());
  constexpr std::int32_t near = 12;  // nodes between a lookup's channels
  for (std::int32_t at = 0; at < count && out.size() < most; ++at) {
    if (node_of(p, at).op != Op::lookup || node_of(p, at).occurrence != 0) continue;
    const std::string name = image(at);
    if (name.empty() || done.contains(node_of(p, at).shape)) continue;
    Nodes v{at};
    for (std::int32_t next = at + 1; next < count && next - v.back() <= near && v.size() < 3; ++next)
      if (node_of(p, next).op == Op::lookup && node_of(p, next).occurrence == 0 && image(next) == name &&
          node_of(p, next).shape != node_of(p, v.back()).shape)
        v.push_back(next);
    for (const std::int32_t i : v) done.insert(node_of(p, i).shape);
    if (v.size() > 1) out.push_back(std::move(v));
  }
  return out;
}

}  // namespace rainref::faults
