#include "faults/place_faults.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "faults/text.h"

namespace rainref::faults {
namespace {

using perturbed::Op;
using perturbed::PlaceFault;
using perturbed::Trace;
using Node = Trace::Node;

/// `op`: of the place. Taking the wrong side of a decision is less plain than leaving something out.
bool is_multiple(PlaceFault fault, Op op) {
  if (fault == PlaceFault::swapped && (op == Op::choice || op == Op::comparison)) return true;
  switch (fault) {
    case PlaceFault::first_twice:
    case PlaceFault::second_twice:
    case PlaceFault::first_squared:
    case PlaceFault::second_squared:
    case PlaceFault::doubled:
    case PlaceFault::halved:
    case PlaceFault::squared:
    case PlaceFault::rooted:
    case PlaceFault::always:
    case PlaceFault::never:
      return true;
    default:
      return false;
  }
}

/// True if a place is changed before its lookup: both sides of it are then wrong together.
bool is_bent(Op op) { return op == Op::floor || op == Op::fract || op == Op::minimum || op == Op::maximum; }

/// True if an operand of a sum or product is a literal that does not occur everywhere.
bool is_literal(const Probe& p, const Node& n, std::size_t k) {
  if (n.op != Op::sum && n.op != Op::difference && n.op != Op::product && n.op != Op::quotient) return false;
  if (n.of[k] < 0 || p.trace.nodes[static_cast<std::size_t>(n.of[k])].op != Op::constant) return false;
  const std::string& name = p.names[static_cast<std::size_t>(n.of[k])];
  return is_number(name) && (n.op == Op::sum || n.op == Op::difference || (name != "2" && name != "0.5" && name != "-1"));
}

/// Groups two or three first places of different shapes and one text, met equally often, for operations that `wanted` selects.
template <class Wanted>
std::vector<std::vector<std::size_t>> groups_of(const Probe& p, const Wanted& wanted) {
  std::map<std::pair<Op, std::string>, std::map<std::uint32_t, std::size_t>> by_text;
  std::map<std::pair<Op, std::string>, std::map<std::uint32_t, std::size_t>> by_axis;  // e_u.z and e_v.z
  std::map<std::pair<Op, std::string>, std::map<std::uint32_t, std::size_t>> by_side;
  std::map<std::pair<Op, std::string>, std::map<std::uint32_t, std::size_t>> by_literal, by_leaf;
  for (std::size_t at = 0; at < p.trace.nodes.size(); ++at) {
    const Node& n = p.trace.nodes[at];
    if (!wanted(n.op) || n.occurrence != 0) continue;
    const std::string text = p.text(static_cast<std::int32_t>(at), 3);
    // A number that occurs in few places: seed + 1, of both components.
    for (const std::size_t k : {0u, 1u})
      if (is_literal(p, n, k))
        by_literal[{n.op, fmt::format("literal {} {}", k, p.names[static_cast<std::size_t>(n.of[k])])}][n.shape] = at;
    if (text == "...") continue;
    // The first operand is a named component, and the second is anything: in a rotation (-y, x), the operations differ.
    if (const std::string near = p.text(static_cast<std::int32_t>(at), 1); names_component_before_gap(near))
      by_leaf[{n.op, "leaf " + of_any_component(near)}][n.shape] = at;
    by_text[{n.op, of_any_component(with_columns(text))}][n.shape] = at;
    by_axis[{n.op, "axis " + of_any_component(text, 'u', 'v')}][n.shape] = at;
    // Offsets to both sides: x - shift and x + shift.
    if (is_bent(n.op)) by_side[{n.op, "side " + of_either_side(text)}][n.shape] = at;
  }
  by_text.merge(by_literal);
  by_text.merge(by_leaf);
  by_text.merge(by_axis);
  by_text.merge(by_side);
  std::vector<std::vector<std::size_t>> out;
  for (const auto& [text, places] : by_text) {
    if (places.size() < 2 || places.size() > 3) continue;
    std::vector<std::size_t> vector;
    for (const auto& [shape, at] : places) vector.push_back(at);
    std::sort(vector.begin(), vector.end());
    const auto count = [&](std::size_t at) { return p.trace.met.at(p.trace.nodes[at].shape); };
    if (std::all_of(vector.begin(), vector.end(), [&](std::size_t at) { return count(at) == count(vector[0]); }))
      out.push_back(std::move(vector));
  }
  // From the results to their operands.
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a[0] > b[0]; });
  return out;
}

/// Components of the arguments and of the result of a refraction or reflection, which are adjacent whatever their operands.
std::vector<std::vector<std::size_t>> arguments_of(const Probe& p) {
  std::vector<std::vector<std::size_t>> out;
  const std::vector<Node>& nodes = p.trace.nodes;
  const auto is_one = [&](std::size_t at) { return nodes[at].op == Op::argument || nodes[at].op == Op::bent; };
  for (std::size_t at = 0; at + 2 < nodes.size(); ++at) {
    if (!is_one(at) || nodes[at + 1].op != nodes[at].op || nodes[at + 2].op != nodes[at].op) continue;
    out.push_back({at, at + 1, at + 2});
    at += 2;
  }
  return out;
}

}  // namespace

std::vector<std::vector<std::size_t>> vectors_of(const Probe& p) {
  std::vector<std::vector<std::size_t>> out = arguments_of(p);
  for (std::vector<std::size_t>& v : groups_of(p, [](Op op) {
         return op == Op::floor || op == Op::fract || op == Op::sum || op == Op::difference || op == Op::product || op == Op::quotient ||
                op == Op::minimum || op == Op::maximum || op == Op::mix || op == Op::negation || op == Op::choice;
       }))
    out.push_back(std::move(v));
  return out;
}
std::vector<std::vector<std::size_t>> vector_values_of(const Probe& p) {
  return groups_of(p, [](Op op) { return op != Op::comparison && op != Op::lookup; });
}

std::vector<std::size_t> components_of(const Probe& p, std::size_t at) {
  const std::uint32_t shape = p.trace.nodes[at].shape;
  std::map<std::string, std::size_t> first;  // node of each text
  std::set<std::string> forms;
  for (std::size_t k = 0; k < p.trace.nodes.size() && first.size() < 4; ++k)
    if (p.trace.nodes[k].shape == shape) {
      const std::string text = p.text(static_cast<std::int32_t>(k), 3);
      first.emplace(text, k);
      forms.insert(of_any_component(text));
    }
  if (forms.size() != 1 || first.size() < 2 || first.size() > 3) return {at};
  std::vector<std::size_t> out;
  for (const auto& [text, node] : first) out.push_back(node);
  return out;
}

void add_place_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known, PlaceKind kind) {
  const auto shared = std::make_shared<const std::vector<float>>(known);
  const auto add = [&](const Mistake& m, std::array<perturbed::Place, 4> places, Reach reach, std::vector<std::string> where = {}) {
    Fault& d = out.emplace_back(m.what);
    d.reach = reach;
    d.where = std::move(where);
    d.behaviour.places = places;
    tell_places_by(d, shared);
  };
  constexpr std::int32_t most = 6;  // places of one shape that are tried separately: components, neighbours
  std::set<std::pair<std::uint32_t, std::int32_t>> done;
  for (const Probe& p : probes) {
    // The components of a vector are two or three places; a mistake in the vector is made at each.
    for (const std::vector<std::size_t>& at : kind == PlaceKind::plain ? vectors_of(p) : std::vector<std::vector<std::size_t>>()) {
      std::array<perturbed::Place, 4> places{};
      std::uint32_t key = 0;
      std::vector<std::vector<Mistake>> mistakes;
      for (std::size_t k = 0; k < at.size(); ++k) {
        const Node& n = p.trace.nodes[at[k]];
        places[k].shape = n.shape;
        // Each argument of one call is a separate place.
        if ((n.op == Op::argument || n.op == Op::bent) && p.trace.met.at(n.shape) > 1) places[k].occurrence = n.occurrence;
        key = (key * 5 ^ n.shape) + static_cast<std::uint32_t>(places[k].occurrence + 1);
        mistakes.push_back(mistakes_at(p, at[k]));
      }
      if (!done.insert({key, 0}).second) continue;
      for (std::size_t m = 0; m < mistakes[0].size(); ++m) {
        const PlaceFault fault = mistakes[0][m].fault;
        const bool is_of_all =
            std::all_of(mistakes.begin(), mistakes.end(), [&](const auto& o) { return o.size() > m && o[m].fault == fault; });
        if (!is_of_all || is_multiple(fault, p.trace.nodes[at[0]].op)) continue;
        for (std::size_t k = 0; k < at.size(); ++k) places[k].fault = fault;
        add(mistakes[0][m], places, at.size() == 2 ? Reach::both : Reach::all);
      }
    }
    // From the results to their operands: a whole missing term is plainer than a mistake inside it.
    for (std::size_t at = p.trace.nodes.size(); at-- > 0;) {
      const Node& n = p.trace.nodes[at];
      const std::int32_t count = p.trace.met.at(n.shape);
      for (const std::int32_t occurrence : {-1, n.occurrence}) {
        if (occurrence >= 0 && (count == 1 || count > most)) continue;
        if (!done.insert({n.shape, occurrence}).second) continue;
        const std::vector<std::size_t> all = occurrence < 0 ? components_of(p, at) : std::vector<std::size_t>{at};
        for (const Mistake& m : mistakes_at(p, all.front())) {
          if ((kind == PlaceKind::multiple) != is_multiple(m.fault, n.op)) continue;
          const std::array<perturbed::Place, 4> place{perturbed::Place{n.shape, occurrence, m.fault}};
          if (occurrence < 0)
            add(m, place, all.size() == 1 ? Reach::one : all.size() == 2 ? Reach::both : Reach::all);
          else
            add(m, place, Reach::one_alike, {std::to_string(count), std::to_string(occurrence + 1)});
        }
      }
      if (n.op != Op::lookup || kind == PlaceKind::multiple) continue;
      // Both coordinates of a lookup: fx and fy of a blend are fractions of the coordinates.
      const auto coordinate_of = [&](std::int32_t fraction) -> std::int32_t {
        if (fraction < 0) return -1;
        const std::int32_t from = p.trace.nodes[static_cast<std::size_t>(fraction)].of[0];
        return from >= 0 && p.trace.nodes[static_cast<std::size_t>(from)].op == Op::coordinate ? from : -1;
      };
      const std::int32_t x = coordinate_of(n.of[0]), y = coordinate_of(n.of[1]);
      if (x < 0 || y < 0) continue;
      const Node &u = p.trace.nodes[static_cast<std::size_t>(x)], &v = p.trace.nodes[static_cast<std::size_t>(y)];
      if (!done.insert({u.shape ^ v.shape * 3, u.occurrence}).second) continue;
      for (const Mistake& m : mistakes_at(p, static_cast<std::size_t>(x)))
        add(m, {perturbed::Place{u.shape, u.occurrence, m.fault}, perturbed::Place{v.shape, v.occurrence, m.fault}}, Reach::in_u_and_v);
    }
  }
}

}  // namespace rainref::faults
