// A hash of fractions in half precision: fract of products of fractions, whose argument has no bits left behind the point.
#include <set>
#include <vector>

#include "faults/generators.h"

namespace rainref::faults {
namespace {

using perturbed::Op;
using perturbed::Substitution;
using perturbed::Trace;

/// Nodes that a fraction went into, in the order of the trace.
std::vector<bool> made_of_fractions(const Trace& trace) {
  std::vector<bool> out(trace.nodes.size(), false);
  for (std::size_t k = 0; k < trace.nodes.size(); ++k)
    for (const std::int32_t of : trace.nodes[k].of)
      if (of >= 0 && (out[static_cast<std::size_t>(of)] || trace.nodes[static_cast<std::size_t>(of)].op == Op::fract)) out[k] = true;
  return out;
}

/// Adds a fraction and what it is made of, down to the fractions that other ones were made of and their arguments.
void gather(const Trace& trace, const std::vector<bool>& is_made_of, std::int32_t node, std::set<std::int32_t>& out) {
  if (node < 0 || !out.insert(node).second) return;
  const Trace::Node& n = trace.nodes[static_cast<std::size_t>(node)];
  for (const std::int32_t of : n.of) {
    if (of < 0) continue;
    const auto k = static_cast<std::size_t>(of);
    const bool is_leaf = trace.nodes[k].op == Op::constant || trace.nodes[k].op == Op::load || trace.nodes[k].op == Op::index;
    if (is_made_of[k] || trace.nodes[k].op == Op::fract)
      gather(trace, is_made_of, of, out);
    else if (n.op == Op::fract && !is_leaf)
      out.insert(of);
  }
}

/// Nodes of hashes: a fraction of a product that three fractions or more went into, and all that it is made of.
std::set<std::int32_t> hashes_of(const Trace& trace) {
  const std::vector<bool> is_made_of = made_of_fractions(trace);
  std::set<std::int32_t> out;
  for (std::size_t k = 0; k < trace.nodes.size(); ++k) {
    if (trace.nodes[k].op != Op::fract || !is_made_of[k]) continue;
    std::set<std::int32_t> own;
    gather(trace, is_made_of, static_cast<std::int32_t>(k), own);
    std::size_t fractions = 0, products = 0;
    for (const std::int32_t node : own) {
      const Op op = trace.nodes[static_cast<std::size_t>(node)].op;
      fractions += op == Op::fract;
      products += op == Op::product;
    }
    if (fractions > 3 && products > 3) out.merge(own);
  }
  return out;
}

}  // namespace

void add_hash_faults(std::vector<Fault>& out, const Probed& p, Texel at) {
  const Trace trace = trace_of(p.model, at);
  const std::set<std::int32_t> hashes = hashes_of(trace);
  if (hashes.empty()) return;
  Fault d(What{Kind::hash_in_half});
  for (const std::int32_t node : hashes) {
    const Trace::Node& n = trace.nodes[static_cast<std::size_t>(node)];
    const auto round = [&](std::int8_t operand) {
      Substitution s;
      s.shape = n.shape;
      s.occurrence = n.occurrence;
      s.operand = operand;
      s.number = 1;
      s.how = perturbed::Put::times;
      s.last = perturbed::Change::as_half;
      d.substitutions.push_back(s);
    };
    for (std::size_t k = 0; k < n.of.size(); ++k)
      if (n.of[k] >= 0 && !hashes.contains(n.of[k])) round(static_cast<std::int8_t>(k));
    round(Substitution::result);
  }
  out.push_back(std::move(d));
}

}  // namespace rainref::faults
