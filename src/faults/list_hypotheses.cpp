// All that the diagnosis of a failing list tries.
#include "faults/draw_faults.h"
#include "faults/generators.h"
#include "faults/hypotheses.h"
#include "faults/list_faults.h"
#include "faults/place_faults.h"
#include "judge/evaluations.h"

namespace rainref::faults {
namespace {

/// That one is not set is plain, as what is wrong with all of a list.
bool is_mixed_up_uniform(const Fault& d) { return d.is(trait::uniform) && !d.is(trait::unset); }

/// Some records, each by itself, that with the most operations first; of a list whose records are not alone all of it.
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
  // As for texels, constants are tried by their names.
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
  // The members of the records of other lists are no numbers that tell places apart: of wipers each is met in a round of a loop.
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
  // Where records stand alone most are none after a few of them; else all are evaluated for each, so that fewer are asked where they
  // are many.
  const std::size_t nodes = probes.empty() ? 1 : probes[0].trace.nodes.size();
  const std::size_t most = std::min<std::size_t>(1200, 1 + (alone.empty() ? 8000000 : 40000000) / nodes);
  add_shared_place_faults(all, again, own);
  add_order_faults(all, again, own, most);
  add_order_faults(all, alike, {}, most);
  add_edit_faults(all, {again.begin(), again.begin() + std::min<std::ptrdiff_t>(1, std::ssize(again))}, own, most, true, again);
  if (!again.empty()) add_vector_substitutions(all, again[0], own, most);
  return {std::move(all), constants, {}, {}, {}};
}

}  // namespace rainref::faults
