// A wrong variable: the components of a vector that are those of another, and how the catalogue knows what the search found.
#include <algorithm>
#include <memory>
#include <utility>

#include "faults/generators.h"
#include "faults/place_faults.h"
#include "faults/targets.h"
#include "faults/text.h"

namespace rainref::faults {

using Node = perturbed::Trace::Node;
using perturbed::Change;
using perturbed::Op;
using perturbed::Put;
using perturbed::Substitution;

namespace {

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

namespace {

/// Whether a node is a factor of another, through products alone; `of` a term, through sums.
bool is_part(const Probe& p, std::int32_t whole, std::int32_t part, bool is_factor, int depth = 3) {
  if (whole < 0 || depth < 0) return false;
  if (whole == part) return true;
  const Op op = node_of(p, whole).op;
  if (is_factor ? op != Op::product && op != Op::negation : op != Op::sum && op != Op::difference) return false;
  return is_part(p, node_of(p, whole).of[0], part, is_factor, depth - 1) || is_part(p, node_of(p, whole).of[1], part, is_factor, depth - 1);
}

}  // namespace

What said(const Probe& p, const Target& t, const Source& s, Put how, Change change) {
  const std::int32_t value = t.value_at(p, 0);
  const std::string right = words_for(p, value), wrong = changed_text(change, s.text);
  const auto what = [&](Kind kind) { return What{kind, {place_text(p, t), wrong, right, closed(wrong)}}; };
  const bool is_itself = s.nodes.size() == t.nodes.size() && !s.nodes.empty() && s.nodes[0] == value;
  const std::int32_t source = s.nodes.empty() ? -1 : s.nodes[0];
  if (is_itself && how == Put::instead) {
    if (change == Change::floored || change == Change::rounded || change == Change::truncated) return what(Kind::rounded_there);
    if (change == Change::as_half || change == Change::as_code) return what(Kind::precision);
    if (change == Change::saturated) return what(Kind::clamp_too_many);
  }
  if (source >= 0 && source != value && change == Change::none && s.nodes.size() == 1) {
    if (how == Put::divided_by && is_part(p, value, source, true)) return what(Kind::own_factor_too_many);
    if (how == Put::minus && is_part(p, value, source, false)) return what(Kind::own_term_too_many);
  }
  // A cube is written out: it is an odd number of times that a factor counts.
  if (change == Change::cubed && (how == Put::times || how == Put::plus || how == Put::minus)) {
    const Kind kind = how == Put::times  ? Kind::cubed_factor_too_many
                      : how == Put::plus ? Kind::cubed_term_too_many
                                         : Kind::negative_cubed_term_too_many;
    return {kind, {place_text(p, t), closed(s.text), right}};
  }
  if (how == Put::instead) return what(wrong == right ? Kind::wrong_texel : Kind::wrong_value);
  return what(how == Put::times        ? Kind::factor_too_many
              : how == Put::divided_by ? Kind::divisor_too_many
              : how == Put::plus       ? Kind::term_too_many
              : how == Put::minus      ? Kind::negative_term_too_many
              : how == Put::from       ? Kind::wrong_value_from
              : how == Put::over       ? Kind::wrong_value_over
              : how == Put::larger     ? Kind::max_too_many
                                       : Kind::min_too_many);
}

}  // namespace rainref::faults
