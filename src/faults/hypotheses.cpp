#include "faults/hypotheses.h"

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "faults/draw_faults.h"
#include "faults/generators.h"
#include "faults/list_faults.h"
#include "faults/place_faults.h"
#include "faults/text.h"
#include "judge/evaluations.h"

namespace rainref::faults {
namespace {

using capture::Array;
using judge::Slot;

std::vector<Wanted> wanted_at(const capture::PassCase& c, const std::vector<Array>& port, const std::vector<Array>& reference,
                              const std::vector<Texel>& texels, judge::HalfMode mode) {
  const std::vector<Slot> slots = judge::slots_of(c);
  std::vector<Wanted> out;
  for (const Texel t : texels) {
    Wanted& w = out.emplace_back(Wanted{t, {}, {}, {}});
    for (const Slot& s : slots) {
      const auto o = static_cast<std::size_t>(s.output);
      w.port.push_back(judge::middle_value(s, s.at(port[o], t.x, t.y), mode));
      w.reference.push_back(judge::middle_value(s, s.at(reference[o], t.x, t.y), mode));
      const float size = std::abs(w.port.back());
      w.step.push_back(s.kind == FormatInfo::unorm8    ? 1 / 255.0f
                       : s.kind == FormatInfo::float16 ? size * 0x1p-10f + 0x1p-24f
                                                       : size * 0x1p-22f);
    }
  }
  return out;
}

/// The most informative texels for a constant: those where the port differs most, in steps of the store, and others all over the rest,
/// because a small change of a number may move the former to quite another texel of a picture.
std::vector<Wanted> telling(std::vector<Wanted> all, std::size_t most) {
  const auto far = [](const Wanted& w) {
    double steps = 0;
    for (std::size_t s = 0; s < w.port.size(); ++s)
      if (std::isfinite(w.port[s]))
        steps = std::max(steps, std::abs(static_cast<double>(w.port[s]) - w.reference[s]) / std::max(w.step[s], 1e-30f));
    return steps;
  };
  std::stable_sort(all.begin(), all.end(), [&](const Wanted& a, const Wanted& b) { return far(a) > far(b); });
  if (all.size() <= most) return all;
  std::vector<Wanted> some;
  for (std::size_t k = 0; k < most / 2; ++k) {
    some.push_back(all[k]);
    some.push_back(all[most / 2 + k * (all.size() - most / 2) / (most / 2)]);
  }
  return some;
}

/// Failing texels away from the edges, if there are any, because texels beyond an edge have no name.
std::vector<Texel> inner(const std::vector<Texel>& failing, const capture::PassModel& model) {
  std::vector<Texel> out;
  for (const int margin : {8, 3, 1}) {
    for (const Texel t : failing)
      if (t.x >= margin && t.y >= margin && t.x < model.width() - margin && t.y < model.height() - margin) out.push_back(t);
    if (!out.empty()) return out;
  }
  return failing;
}

/// Constants in comparisons, changed so much that each failing texel has a value between the old and new threshold: there the outcome
/// changes.
void add_fitted_thresholds(std::vector<Fault>& out, const Probed& p, const Constants& constants, const std::vector<Texel>& failing) {
  struct Range {
    float above = 0, below = 0;  ///< least change of the constant for every texel to fail
    std::size_t has_above = 0, has_below = 0;
  };
  std::map<float, Range> ranges;
  for (const Texel at : failing) {
    const perturbed::Trace trace = trace_of(p.model, at);
    std::map<float, std::array<float, 2>> nearest;  // values compared with it: nearest above and below
    for (const perturbed::Trace::Node& n : trace.nodes)
      for (const std::size_t k : {0u, 1u}) {
        if (n.op != perturbed::Op::comparison || n.of[k] < 0 ||
            trace.nodes[static_cast<std::size_t>(n.of[k])].op != perturbed::Op::constant)
          continue;
        const float constant = n.with[k], other = n.with[1 - k];
        auto& [above, below] = nearest.try_emplace(constant, std::array<float, 2>{HUGE_VALF, -HUGE_VALF}).first->second;
        if (other >= constant) above = std::min(above, other);
        if (other <= constant) below = std::max(below, other);
      }
    for (const auto& [constant, sides] : nearest) {
      Range& r = ranges.try_emplace(constant, Range{constant, constant}).first->second;
      if (std::isfinite(sides[0])) ++r.has_above, r.above = std::max(r.above, sides[0]);
      if (std::isfinite(sides[1])) ++r.has_below, r.below = std::min(r.below, sides[1]);
    }
  }
  for (const Constant& constant : constants) {
    const auto found = ranges.find(constant.value);
    if (found == ranges.end() || constant.value == 0) continue;
    const auto add = [&](float bound, Kind kind) {
      const float other = bound + (bound - constant.value) * 1e-3f;
      if (other != constant.value) out.push_back(another_value(kind, constant, bound, other));
    };
    const Range& r = found->second;
    if (r.has_above == failing.size()) add(r.above, Kind::another_threshold_above);
    if (r.has_below == failing.size()) add(r.below, Kind::another_threshold_below);
  }
}

}  // namespace

std::vector<float> without_records(std::vector<float> known, const std::vector<Probe>& probes) {
  std::set<float> of_records;
  for (const Probe& p : probes)
    for (std::size_t n = 0; n < p.names.size(); ++n)
      if (p.trace.nodes[n].op == perturbed::Op::constant && is_of_list(p.names[n])) of_records.insert(p.trace.nodes[n].value);
  std::erase_if(known, [&](float v) { return of_records.contains(v); });
  return known;
}

bool is_of_operation(const Fault& d) {
  return d.behaviour.fault >= perturbed::Fault::strict_for_weak && d.behaviour.fault <= perturbed::Fault::atan2_swapped;
}

Hypotheses hypotheses(const Probed& p, const capture::PassCase* before, const std::vector<Texel>& failing) {
  std::vector<Fault> all = faults_of(p.pass, p.c, p.model, before), uniforms, operations, channels;
  // Constants are tried under their names; uniforms, and operations replaced everywhere, come after the single places.
  std::erase_if(all, [](const Fault& d) { return d.behaviour.fault == perturbed::Fault::constant; });
  // Mistakes in a uniform itself: an equivalent mistake in the text is preferred.
  take(all, uniforms, [](const Fault& d) { return d.is(trait::uniform); });
  take(all, operations, is_of_operation);
  const std::vector<random::Purpose> drawn = purposes_drawn([&] {
    std::vector<perturbed::Perturbed> unused(static_cast<std::size_t>(p.model.values()));
    for (const Texel at : spread(failing, 4)) p.model.evaluate(at.x, at.y, unused.data());
  });
  if (!drawn.empty()) add_draw_faults(all, drawn), add_counter_faults(all, p.pass, p.c);
  add_output_mixups(all, p, before);
  add_tap_faults(all, p);
  add_input_mixups(all, p);
  add_level_faults(all, p);
  // A channel of an input that is negated, subtracted from 1, or counts as 0: a text error would be a term.
  take(all, channels, [](const Fault& d) { return d.is(trait::channel); });
  const std::vector<float> known = constants_everywhere(p.model);
  const std::vector<Probe> probes = probes_of(p, spread(inner(failing, p.model), 4), known);
  const Constants constants = names_of_constants(probes, known);
  const std::vector<Probe> alike = probes_again(p.model, probes, {});
  add_place_faults(all, probes, known, PlaceKind::plain);
  // A scalar that is missing in three components is more likely an unset uniform, so vectors come after the uniforms.
  std::vector<Fault> vectors;
  take(all, vectors, [](const Fault& d) { return d.is_of_all_components(); });
  add_named_constants(all, constants, false);
  take(uniforms, all, [](const Fault& d) { return d.is(trait::set_at_all); });
  add_uniform_mixups(all, p, uniforms_met(probes, p.pass));
  // The same places with all constants treated alike: the components of a vector are then one place, whatever their factors.
  std::move(vectors.begin(), vectors.end(), std::back_inserter(all));
  add_place_faults(all, alike, {}, PlaceKind::plain);
  std::move(uniforms.begin(), uniforms.end(), std::back_inserter(all));
  add_whole_mixups(all, p);
  std::move(channels.begin(), channels.end(), std::back_inserter(all));
  std::move(operations.begin(), operations.end(), std::back_inserter(all));
  add_place_faults(all, probes, known, PlaceKind::multiple);
  add_scaled_inputs(all, p);
  add_named_constants(all, constants, true);
  add_place_faults(all, alike, {}, PlaceKind::multiple);
  add_odd_constants(all, p, constants);
  std::vector<Fault> orders;
  add_order_faults(orders, probes, known);
  add_order_faults(orders, alike, {});
  std::size_t nodes = 1;
  for (const Probe& probe : probes) nodes = std::max(nodes, probe.trace.nodes.size());
  constexpr std::size_t most_edited = 20000000, most_edits = 6000;  // nodes evaluated, about five times for each edit
  // Members of records do not distinguish places: an edit applies to each round of a loop over them.
  const std::vector<float> own = without_records(known, probes);
  const std::vector<Probe> again = own.size() == known.size() ? probes : probes_again(p.model, probes, own);
  add_edit_faults(orders, {again.begin(), again.begin() + std::min<std::ptrdiff_t>(1, std::ssize(again))}, own,
                  std::min(most_edits, most_edited / nodes / 5), again);
  add_shared_place_faults(orders, again, own);
  return {std::move(all), constants, std::move(orders), again, own};
}

std::vector<Fault> fits(const Probed& p, const Constants& constants, const std::vector<Array>& port, const std::vector<Array>& reference,
                        const std::vector<Texel>& failing, judge::HalfMode mode) {
  const auto evaluate = [&](const Wanted& w, std::size_t slot, float constant, float replacement) {
    const perturbed::Scope scope(perturbed::replacing(constant, replacement));
    std::vector<perturbed::Perturbed> values(w.port.size());
    p.model.evaluate(w.at.x, w.at.y, values.data());
    return values[slot].v;
  };
  std::vector<Fault> out;
  add_fitted_constants(out, evaluate, constants, telling(wanted_at(p.c, port, reference, spread(failing, 100), mode), 12));
  add_fitted_thresholds(out, p, constants, spread(failing, 100));
  return out;
}

// ---- lists

namespace {

/// An unset uniform is plain, like mistakes in a whole list.
bool is_mixed_up_uniform(const Fault& d) { return d.is(trait::uniform) && !d.is(trait::unset); }

/// Traces some records separately, the one with most operations first; if records are not separate, the whole list.
std::vector<Probe> probes_of_records(const Probed& p, const std::string& list, const std::vector<float>& known,
                                     const std::vector<Probed>& alone) {
  if (alone.empty()) return probes_of_list(p, list, known);
  constexpr std::size_t most = 3;
  std::vector<Probe> out;
  for (const Probed& one : alone) out.push_back(std::move(probes_of_list(one, list, known)[0]));
  std::stable_sort(out.begin(), out.end(), [](const Probe& a, const Probe& b) { return a.trace.nodes.size() > b.trace.nodes.size(); });
  if (out.size() > most) out.resize(most);
  return out;
}

}  // namespace

std::vector<Fault> plain_list_hypotheses(const Probed& p, const capture::PassCase* before) {
  std::vector<Fault> all = faults_of(p.pass, p.c, p.model, before);
  // As for texels, constants are tried under their names.
  std::erase_if(
      all, [](const Fault& d) { return d.behaviour.fault == perturbed::Fault::constant || is_of_operation(d) || is_mixed_up_uniform(d); });
  const capture::PassEvaluations* evaluations = judge::evaluations_of(p.c.effect, p.c.pass);
  if (!p.bind && evaluations && evaluations->recompute) {
    add_draw_faults(all, purposes_drawn([&] { static_cast<void>(evaluations->recompute(p.c)); }));
    add_counter_faults(all, p.pass, p.c);
    add_uniform_values(all, p);
  }
  return all;
}

Hypotheses list_hypotheses(const Probed& p, const std::string& list, const std::vector<Probed>& alone) {
  std::vector<Fault> all;
  add_input_mixups(all, p, false);
  const std::vector<float> known = constants_of_lists(p.model, p.c);
  const bool is_followed = p.bind && p.model.keyed(list);
  const std::vector<Probe> probes = is_followed ? probes_of_records(p, list, known, alone) : std::vector<Probe>();
  const Constants constants = names_of_constants(probes, known);
  add_named_constants(all, constants, false);
  add_place_faults(all, probes, known, PlaceKind::plain);
  // Members of records of other lists do not distinguish places: each wiper is used in one round of a loop.
  const std::vector<float> own = without_records(known, probes);
  const std::vector<Probe> again = own.size() == known.size() || !is_followed ? probes : probes_of_records(p, list, own, alone);
  if (own.size() < known.size()) add_place_faults(all, again, own, PlaceKind::plain);
  std::set<std::string> used = uniforms_met(probes, p.pass);
  if (!is_followed)
    for (const scene::Member& m : p.pass.block.members) used.insert(m.name);
  add_uniform_mixups(all, p, used);
  add_whole_mixups(all, p);
  const std::vector<Probe> alike = is_followed ? probes_of_records(p, list, {}, alone) : std::vector<Probe>();
  add_place_faults(all, alike, {}, PlaceKind::plain);
  for (Fault& d : faults_of(p.pass, p.c, p.model, nullptr))
    if (is_of_operation(d) || is_mixed_up_uniform(d)) all.push_back(std::move(d));
  add_place_faults(all, probes, known, PlaceKind::multiple);
  add_named_constants(all, constants, true);
  add_place_faults(all, alike, {}, PlaceKind::multiple);
  add_odd_constants(all, p, constants);
  // For separate records, most faults are rejected after a few of them. Otherwise all records are evaluated for each fault, so fewer are
  // tried for long lists.
  const std::size_t nodes = probes.empty() ? 1 : probes[0].trace.nodes.size();
  const std::size_t most = std::min<std::size_t>(1200, 1 + (alone.empty() ? 8000000 : 40000000) / nodes);
  add_shared_place_faults(all, again, own);
  add_order_faults(all, again, own, most);
  add_order_faults(all, alike, {}, most);
  add_edit_faults(all, {again.begin(), again.begin() + std::min<std::ptrdiff_t>(1, std::ssize(again))}, own, most, again);
  return {std::move(all), constants, {}, {}, {}};
}

}  // namespace rainref::faults
