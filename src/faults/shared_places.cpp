// Functions of a pass text that are called several times: their places look equal, with arguments of other shapes.
#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "faults/place_faults.h"

namespace rainref::faults {

using perturbed::Op;
using Node = perturbed::Trace::Node;

std::vector<SharedPlace> shared_places_of(const std::vector<Probe>& probes) {
  // One operation of two plain numbers looks equal everywhere.
  const auto is_telling = [&](const Node& n, std::int8_t depth) {
    switch (n.op) {
      case Op::constant:
      case Op::load:
      case Op::fetch:
      case Op::index:
      case Op::lookup:
      case Op::comparison:
      case Op::coordinate:
      case Op::level:
      case Op::stored:
        return false;
      case Op::sum:
      case Op::difference:
      case Op::product:
      case Op::quotient:
      case Op::negation:
      case Op::argument:
      case Op::bent:
        return depth > 1;
      default:
        return true;
    }
  };
  // For these, one call in the probes is enough: another may be in no probe.
  const auto is_rare = [](Op op) {
    return op == Op::angle || op == Op::power || op == Op::mix || op == Op::smoothstep || op == Op::sine || op == Op::cosine ||
           op == Op::exponential || op == Op::fract;
  };
  constexpr std::size_t most_shapes = 12, most = 40;
  std::vector<SharedPlace> out;
  std::set<std::set<std::uint32_t>> done;
  for (const std::int8_t depth : {std::int8_t{2}, std::int8_t{1}}) {
    struct Class {
      std::size_t probe;
      std::int32_t node;
      std::set<std::uint32_t> shapes = {};
    };
    std::map<std::uint32_t, Class> classes;
    // Invocations with another path call the same functions with other arguments.
    for (std::size_t k = 0; k < probes.size(); ++k)
      for (std::int32_t at = 0; at < static_cast<std::int32_t>(probes[k].trace.nodes.size()); ++at) {
        const Node& n = probes[k].trace.nodes[static_cast<std::size_t>(at)];
        if (n.occurrence != 0 || !is_telling(n, depth)) continue;
        Class& one = classes.try_emplace(n.shallow[static_cast<std::size_t>(depth - 1)], Class{k, at}).first->second;
        if (one.probe == k) one.node = at;
        one.shapes.insert(n.shape);
      }
    std::vector<SharedPlace> found;
    for (const auto& [shape, one] : classes)
      if (one.shapes.size() >= (is_rare(probes[one.probe].trace.nodes[static_cast<std::size_t>(one.node)].op) ? 1u : 2u) &&
          one.shapes.size() <= most_shapes && done.insert(one.shapes).second)
        found.push_back({one.probe, one.node, depth, one.shapes.size()});
    std::sort(found.begin(), found.end(),
              [](const SharedPlace& a, const SharedPlace& b) { return a.probe != b.probe ? a.probe < b.probe : a.node > b.node; });
    out.insert(out.end(), found.begin(), found.end());
  }
  // Places in a loop; the first round has other values than the later ones.
  constexpr std::size_t most_rounds = 400, most_in_loops = 60;
  std::vector<SharedPlace> in_loops;
  for (std::size_t k = 0; k < std::min<std::size_t>(probes.size(), 1); ++k) {
    std::map<std::uint32_t, std::pair<std::int32_t, std::set<std::uint32_t>>> classes;  // the last node, shapes
    for (std::int32_t at = 0; at < static_cast<std::int32_t>(probes[k].trace.nodes.size()); ++at) {
      const Node& n = probes[k].trace.nodes[static_cast<std::size_t>(at)];
      if (n.sequence == 0 || n.op == Op::lookup || n.op == Op::comparison || n.op == Op::coordinate || n.op == Op::level) continue;
      auto& [node, shapes] = classes[n.sequence];
      node = at;
      shapes.insert(n.shape);
    }
    for (const auto& [sequence, found] : classes)
      if (found.second.size() > 1 && found.second.size() < most_rounds && done.insert(found.second).second)
        in_loops.push_back({k, found.first, perturbed::by_sequence, found.second.size()});
  }
  std::sort(in_loops.begin(), in_loops.end(), [](const SharedPlace& a, const SharedPlace& b) { return a.node > b.node; });
  if (in_loops.size() > most_in_loops) in_loops.resize(most_in_loops);
  // Named functions first; fewer in a long pass, because each is evaluated.
  const auto rarity = [&](const SharedPlace& place) {
    return is_rare(probes[place.probe].trace.nodes[static_cast<std::size_t>(place.node)].op);
  };
  std::stable_sort(out.begin(), out.end(), [&](const SharedPlace& a, const SharedPlace& b) { return rarity(a) && !rarity(b); });
  std::size_t nodes = 1;
  for (const Probe& p : probes) nodes = std::max(nodes, p.trace.nodes.size());
  out.resize(std::min(out.size(), std::clamp<std::size_t>(40000 / nodes, 8, most)));
  out.insert(out.end(), in_loops.begin(), in_loops.end());
  return out;
}

std::uint32_t shape_of(const Node& n, const SharedPlace& place) {
  return place.depth == perturbed::by_sequence ? n.sequence : n.shallow[static_cast<std::size_t>(place.depth - 1)];
}
void reach_all(What& what, const SharedPlace& place) {
  what.reach = place.depth == perturbed::by_sequence ? Reach::each_round : place.shapes > 1 ? Reach::each_call : Reach::wherever;
  what.where = {std::to_string(place.shapes)};
}

void add_shared_place_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known) {
  const auto shared = std::make_shared<const std::vector<float>>(known);
  for (const SharedPlace& place : shared_places_of(probes)) {
    const Probe& p = probes[place.probe];
    const Node& n = p.trace.nodes[static_cast<std::size_t>(place.node)];
    for (const Mistake& m : mistakes_at(p, static_cast<std::size_t>(place.node))) {
      Fault& d = out.emplace_back(m.what);
      reach_all(d, place);
      d.behaviour.places[0] = {shape_of(n, place), -1, m.fault, 0, place.depth};
      tell_places_by(d, shared);
      d.is_one_of_many = true;
    }
  }
}

}  // namespace rainref::faults
