// Places of an invocation to solve for, and the values that may replace them.
#pragma once

#include <string>
#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

inline const perturbed::Trace::Node& node_of(const Probe& p, std::int32_t i) { return p.trace.nodes[static_cast<std::size_t>(i)]; }
/// True for a leaf: a constant, a texel, the column.
bool is_leaf(perturbed::Op op);

/// Approximate limit on the operations of a search, so that a diagnosis takes seconds. It counts operations, not time, so that results do
/// not depend on the machine.
constexpr std::size_t most_steps = 20000000;

/// A place to solve for: an operand or the result of a node, or of each component of a vector.
struct Target {
  std::vector<std::int32_t> nodes;
  std::int8_t operand;

  std::int32_t value_at(const Probe& p, std::size_t c) const {
    return operand < 0 ? nodes[c] : node_of(p, nodes[c]).of[static_cast<std::size_t>(operand)];
  }
  float now(const Probe& p, std::size_t c) const {
    const perturbed::Trace::Node& n = node_of(p, nodes[c]);
    return operand < 0 ? n.value : n.with[static_cast<std::size_t>(operand)];
  }
  std::vector<std::int32_t> values(const Probe& p) const {
    std::vector<std::int32_t> out;
    for (std::size_t c = 0; c < nodes.size(); ++c) out.push_back(value_at(p, c));
    return out;
  }
  std::vector<perturbed::Substitution> places(const Probe& p) const {
    std::vector<perturbed::Substitution> out;
    for (const std::int32_t node : nodes) {
      perturbed::Substitution& s = out.emplace_back();
      s.shape = node_of(p, node).shape;
      s.occurrence = p.trace.met.at(s.shape) == 1 ? -1 : node_of(p, node).occurrence;
      s.operand = operand;
    }
    return out;
  }
};

using Nodes = std::vector<std::int32_t>;

/// True if some of them have the same shape.
bool are_alike(const Probe& p, const Nodes& v);
/// Number of components in a loop that meets them in turn, all of one shape; else 0.
std::int32_t period_of(const Probe& p, const Nodes& v);
/// Groups two or three nodes that form a vector: operands of a length, arguments of named functions, nodes equal but for the component,
/// adjacent values of the outputs, and adjacent pairs of one operation.
std::vector<Nodes> vector_groups_of(const Probe& p);
/// Two or three channels of one lookup.
std::vector<Nodes> lookups_of(const Probe& p);

/// A replacement value, or one for each component.
struct Source {
  std::vector<std::int32_t> nodes;  ///< one for all components, or one for each; empty: the numbers
  std::vector<float> numbers;
  std::string text;
  int effort;
};

/// Components of vectors: of different shapes and one text, of one shape, or adjacent below the outputs.
std::vector<std::vector<std::int32_t>> vectors_in(const Probe& p);
/// Operands and results, vectors first, from the outputs to their operands.
std::vector<Target> targets_of(const Probe& p);
/// All uniforms by name, used or not, and small numbers.
std::vector<Source> numbers_of(const Probed& p, std::size_t components);
/// Values before a target, nearest first and vectors before others, then `numbers`.
std::vector<Source> sources_for(const Probe& p, const Target& t, const std::vector<std::vector<std::int32_t>>& groups,
                                const std::vector<Source>& numbers);
/// Value of a source for component c.
float number_of(const Probe& p, const Source& s, std::size_t c);
/// Substitutes a source at the places of a target.
void take(const Probe& p, const Source& s, const Target& t, std::vector<perturbed::Substitution>& places);

}  // namespace rainref::faults
