// Places of an invocation that are solved for, and the values that may stand there.
#pragma once

#include <string>
#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

inline const perturbed::Trace::Node& node_of(const Probe& p, std::int32_t i) { return p.trace.nodes[static_cast<std::size_t>(i)]; }
/// A leaf: a constant, a texel, the column.
bool is_leaf(perturbed::Op op);

/// Operations that a search may do, about, so that a diagnosis takes seconds: a number of them, not a time, so that it says the same
/// everywhere.
constexpr std::size_t most_steps = 20000000;

/// Where numbers are solved for: an operand or the result of a node, or of each component of a vector.
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

/// Whether some of them have one shape.
bool are_alike(const Probe& p, const Nodes& v);
/// In a loop that meets the components, all of one shape, round by round: how many there are; else 0.
std::int32_t period_of(const Probe& p, const Nodes& v);
/// What belongs together as a vector: what a length is taken of, the arguments of named functions, what is alike but for the
/// component, what the outputs are made of side by side, and pairs of one operation beside each other. Two or three nodes each.
std::vector<Nodes> vector_groups_of(const Probe& p);
/// Channels that one lookup gives, two or three.
std::vector<Nodes> lookups_of(const Probe& p);

/// A value, or one for each component, that may stand there.
struct Source {
  std::vector<std::int32_t> nodes;  ///< one for all components, or one for each; none: the numbers
  std::vector<float> numbers;
  std::string text;
  int effort;
};

/// The components of vectors: of different shapes and one text, of one shape, or side by side below the outputs.
std::vector<std::vector<std::int32_t>> vectors_in(const Probe& p);
/// Operands and results, of vectors first, from the outputs to what they are made of.
std::vector<Target> targets_of(const Probe& p);
/// Uniforms by their names, whether the pass uses them or not, and small numbers.
std::vector<Source> numbers_of(const Probed& p, std::size_t components);
/// Values met before a target, nearest first, those of vectors before, and `numbers` after.
std::vector<Source> sources_for(const Probe& p, const Target& t, const std::vector<std::vector<std::int32_t>>& groups,
                                const std::vector<Source>& numbers);
/// What a source gives for component c.
float number_of(const Probe& p, const Source& s, std::size_t c);
/// Puts a source into the places of a target.
void take(const Probe& p, const Source& s, const Target& t, std::vector<perturbed::Substitution>& places);

}  // namespace rainref::faults
