// A wrong variable: the components of a vector that are those of another.
#include "faults/generators.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "faults/place_faults.h"
#include "faults/targets.h"
#include "faults/text.h"

namespace rainref::faults {
namespace {

using perturbed::Op;
using perturbed::Substitution;
using Node = perturbed::Trace::Node;

/// Whether the arithmetic can be done again with another number there.
bool is_again(Op op) { return !is_leaf(op) && op != Op::lookup; }

}  // namespace

void add_vector_substitutions(std::vector<Fault>& out, const Probe& probe, const std::vector<float>& known, std::size_t most) {
  const auto shared = std::make_shared<const std::vector<float>>(known);
  const std::vector<std::vector<std::size_t>> vectors = vectors_of(probe), values = vector_values_of(probe);
  std::size_t made = 0;
  for (const std::vector<std::size_t>& use : vectors)
    for (std::int8_t k = 0; k < 3; ++k) {
      const std::int32_t operand = probe.trace.nodes[use[0]].of[static_cast<std::size_t>(k)];
      if (operand < 0 || !is_again(probe.trace.nodes[use[0]].op)) continue;
      const std::string right = words_for(probe, operand);
      for (const std::vector<std::size_t>& value : values) {
        if (value.size() != use.size()) continue;
        std::vector<Substitution> all;
        bool is_before = true, is_same = true;
        for (std::size_t c = 0; c < use.size(); ++c) {
          const Node& place = probe.trace.nodes[use[c]];
          const Node& source = probe.trace.nodes[value[c]];
          is_before &= value[c] < use[0];
          is_same &= place.of[static_cast<std::size_t>(k)] == static_cast<std::int32_t>(value[c]);
          Substitution& s = all.emplace_back();
          s.shape = place.shape;
          s.operand = k;
          s.source = source.shape;
          // The last one of its shape before the place.
          for (std::size_t m = value[c]; m < use[0]; ++m) s.back += probe.trace.nodes[m].shape == source.shape;
        }
        if (!is_before || is_same || ++made > most) continue;
        const std::string wrong = words_for(probe, static_cast<std::int32_t>(value[0]));
        if (wrong == right || wrong == "...") continue;
        Fault& d = out.emplace_back(
            What{Kind::wrong_value, {"in " + words_for(probe, static_cast<std::int32_t>(use[0])), wrong, right}, Reach::all});
        d.substitutions = std::move(all);
        tell_places_by(d, shared);
      }
    }
}

}  // namespace rainref::faults
