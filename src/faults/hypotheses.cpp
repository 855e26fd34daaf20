#include "faults/hypotheses.h"

#include <cmath>

#include "faults/failing_texels.h"
#include "faults/place_faults.h"
#include "faults/whole_faults.h"

namespace rainref::faults {
namespace {

using capture::Array;
using judge::Slot;

std::vector<Wanted> wanted_at(const capture::PassCase& c, const std::vector<Array>& port, const std::vector<Array>& reference,
                              const std::vector<Texel>& texels) {
  const std::vector<Slot> slots = judge::slots_of(c);
  std::vector<Wanted> out;
  for (const Texel t : texels) {
    Wanted& w = out.emplace_back(Wanted{t, {}, {}, {}});
    for (const Slot& s : slots) {
      const auto o = static_cast<std::size_t>(s.output);
      w.port.push_back(judge::stored_value(s, s.at(port[o], t.x, t.y)));
      w.reference.push_back(judge::stored_value(s, s.at(reference[o], t.x, t.y)));
      const float size = std::abs(w.port.back());
      w.step.push_back(s.kind == FormatInfo::unorm8    ? 1 / 255.0f
                       : s.kind == FormatInfo::float16 ? size * 0x1p-10f + 0x1p-24f
                                                       : size * 0x1p-22f);
    }
  }
  return out;
}

/// Texels whose stored values say most about a constant: where the port is farthest off, in steps of the store.
std::vector<Wanted> telling(std::vector<Wanted> all, std::size_t most) {
  const auto far = [](const Wanted& w) {
    double steps = 0;
    for (std::size_t s = 0; s < w.port.size(); ++s)
      if (std::isfinite(w.port[s]))
        steps = std::max(steps, std::abs(static_cast<double>(w.port[s]) - w.reference[s]) / std::max(w.step[s], 1e-30f));
    return steps;
  };
  std::stable_sort(all.begin(), all.end(), [&](const Wanted& a, const Wanted& b) { return far(a) > far(b); });
  if (all.size() > most) all.resize(most);
  return all;
}

/// Failing texels away from the edges, if there are some: what stands beyond an edge has no name.
std::vector<Texel> inner(const std::vector<Texel>& failing, const capture::PassModel& model) {
  std::vector<Texel> out;
  for (const int margin : {8, 3, 1}) {
    for (const Texel t : failing)
      if (t.x >= margin && t.y >= margin && t.x < model.width() - margin && t.y < model.height() - margin) out.push_back(t);
    if (!out.empty()) return out;
  }
  return failing;
}

}  // namespace

bool is_mixed_up_uniform(const Fault& d) {
  const bool is_plain = d.name.ends_with("is zero") || d.name.ends_with("negated") || d.name.ends_with("stale");
  return d.name.starts_with("uniform") && !is_plain;
}

Hypotheses hypotheses(const Probed& p, const capture::PassCase* before, const std::vector<Texel>& failing) {
  std::vector<Fault> all = faults_of(p.pass, p.c, p.model, before), uniforms, operations;
  // Constants are tried by their names; uniforms and what an operation may be mistaken for everywhere, after each place by itself.
  std::erase_if(all, [](const Fault& d) { return d.behaviour.fault == perturbed::Fault::constant; });
  take(all, uniforms, is_mixed_up_uniform);
  take(all, operations, [](const Fault& d) {
    return d.behaviour.fault >= perturbed::Fault::strict_for_weak && d.behaviour.fault <= perturbed::Fault::atan2_swapped;
  });
  add_output_mixups(all, p, before);
  add_tap_faults(all, p);
  add_input_mixups(all, p);
  const std::vector<float> known = constants_everywhere(p.model);
  const std::vector<Probe> probes = probes_of(p, spread(inner(failing, p.model), 4), known);
  const Constants constants = names_of_constants(probes, known);
  add_named_constants(all, constants, false);
  add_place_faults(all, probes, known);
  std::move(uniforms.begin(), uniforms.end(), std::back_inserter(all));
  add_scaled_inputs(all, p);
  add_uniform_mixups(all, p, uniforms_met(probes, p.pass));
  add_named_constants(all, constants, true);
  // The same places, with all constants alike: the components of a vector are one place then, whatever they are multiplied by.
  add_place_faults(all, probes_again(p.model, probes, {}), {});
  std::move(operations.begin(), operations.end(), std::back_inserter(all));
  add_odd_constants(all, p, constants);
  return {std::move(all), constants};
}

std::vector<Fault> fits(const Probed& p, const Constants& constants, const std::vector<Array>& port, const std::vector<Array>& reference,
                        const std::vector<Texel>& failing) {
  const auto evaluate = [&](const Wanted& w, std::size_t slot, float constant, float replacement) {
    perturbed::Behaviour b;
    b.fault = perturbed::Fault::constant;
    b.constant = constant;
    b.replacement = replacement;
    const perturbed::Scope scope(b);
    std::vector<perturbed::Perturbed> values(w.port.size());
    p.model.evaluate(w.at.x, w.at.y, values.data());
    return values[slot].v;
  };
  std::vector<Fault> out;
  add_fitted_constants(out, evaluate, constants, telling(wanted_at(p.c, port, reference, spread(failing, 100)), 12));
  return out;
}

}  // namespace rainref::faults
