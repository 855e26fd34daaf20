#include "faults/mutate.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include <fmt/format.h>

#include "base/path_text.h"
#include "faults/list_faults.h"
#include "faults/list_replay.h"
#include "judge/check_pack.h"
#include "judge/evaluations.h"
#include "judge/invocation_judge.h"
#include "judge/keyed.h"
#include "judge/profiles.h"
#include "judge/reference_outputs.h"
#include "rainref/error.h"

namespace rainref::faults {
namespace {

using capture::Array;
using capture::PassCase;
using judge::Accepted;
using judge::Bind;
using judge::binder;
using judge::check_pack;
using judge::evaluations_of;
using judge::HalfMode;
using judge::InvocationJudge;
using judge::judge_keyed;
using judge::keyed_outputs;
using judge::KeyedJudgement;
using judge::profile;
using judge::read_case;
using judge::reference_outputs;
using judge::Slot;
using judge::slots_of;
using judge::ValidateOptions;

std::vector<Texel> spread(const capture::PassModel& model, int most) {
  std::vector<Texel> all;
  const std::int64_t count = static_cast<std::int64_t>(model.width()) * model.height(), taken = std::min<std::int64_t>(count, most);
  for (std::int64_t k = 0; k < taken; ++k) {
    const std::int64_t i = k * count / taken;
    all.push_back({static_cast<int>(i % model.width()), static_cast<int>(i / model.width())});
  }
  return all;
}
/// Writes the stored values of a texel. False: they were already equal.
bool put(const std::vector<Slot>& slots, const StoredTexel& stored, Texel t, std::vector<Array>& out) {
  bool differs = false;
  for (std::size_t v = 0; v < slots.size(); ++v) {
    const Slot& s = slots[v];
    Array& array = out[static_cast<std::size_t>(s.output)];
    const auto size = static_cast<std::size_t>(s.channel_bytes);
    if (std::memcmp(stored[v].data(), s.at(array, t.x, t.y), size) == 0) continue;
    std::memcpy(array.levels[0].edit().data() + s.offset(t.x, t.y), stored[v].data(), size);
    differs = true;
  }
  return differs;
}

/// A rounding of half stores that a profile allows, with the reference's outputs and the judge for it.
struct Stores {
  HalfMode mode;
  std::vector<Array> finished;
  InvocationJudge judge;
};
std::vector<std::unique_ptr<const Stores>> stores_under(const enclosed::Profile& profile, const PassCase& c,
                                                        const capture::PassModel& model, const parallel::Executor& executor) {
  using enclosed::StoreRounding;
  std::vector<std::unique_ptr<const Stores>> out;
  const auto add = [&](HalfMode mode) {
    out.emplace_back(new Stores{mode, reference_outputs(c, model, executor, mode), InvocationJudge(c, model, profile, mode, true)});
  };
  if (profile.reference) {
    add(HalfMode::either);  // as in the pack
    return out;
  }
  const std::vector<Slot> slots = slots_of(c);
  const bool has_halves =
      model.rounds_inside() || std::any_of(slots.begin(), slots.end(), [](const Slot& s) { return s.kind == FormatInfo::float16; });
  if (profile.half_store != StoreRounding::rtz) add(HalfMode::rne);
  if (profile.half_store != StoreRounding::rne && (has_halves || out.empty())) add(HalfMode::rtz);
  return out;
}

/// Judges one fault on one case. A port is judged by the rounding that fits it best, so an element is outside only if it is outside under
/// every rounding that the profile leaves open.
void judge_mutant(const Fault& d, const PassCase& c, const Bind& bind, const capture::PassModel& model, const std::vector<Texel>& texels,
                  const std::vector<std::unique_ptr<const Stores>>& all_stores, MutantJudgement& out) {
  const std::vector<Slot> slots = slots_of(c);
  if (slots.empty() || d.alter_list) return;
  struct Under {
    const Stores& stores;
    const FaultyPass& faulty;
    const InvocationJudge& judge;
    std::vector<Array> stored;
    std::int64_t outside = 0, rearranged = 0, differing = 0;
  };
  std::vector<std::unique_ptr<const FaultyPass>> faulty;
  std::vector<Under> all;
  for (const std::unique_ptr<const Stores>& stores : all_stores) {
    // Evaluated values are the same under each.
    if (faulty.empty() || d.alter_outputs)
      faulty.push_back(std::make_unique<const FaultyPass>(d, c, bind, model, stores->mode, stores->finished));
    if (!faulty.back()->applies()) return;
    // A device that rounds the other way is judged under that rounding, if a profile leaves it open.
    const auto judges = [&](const auto& other) { return other->mode == d.stores.value_or(stores->mode); };
    const auto judge = all_stores.size() > 1 ? std::find_if(all_stores.begin(), all_stores.end(), judges) : all_stores.begin();
    all.push_back({*stores, *faulty.back(), (*judge)->judge, stores->finished});
  }
  StoredTexel stored;
  for (const Texel t : texels) {
    const std::vector<perturbed::Perturbed> values = d.alter_outputs ? std::vector<perturbed::Perturbed>() : faulty.front()->values(t);
    for (Under& u : all) {
      if (d.alter_outputs)
        u.faulty.store(t, stored);
      else
        u.faulty.store(values, u.stores.mode, stored);
      if (!put(slots, stored, t, u.stored)) continue;
      ++u.differing;
      const Accepted accepted = u.judge.accepts(t.x, t.y, u.stored);
      u.outside += accepted == Accepted::no;
      u.rearranged += accepted == Accepted::rearranged;
    }
  }
  const Under& best = *std::min_element(all.begin(), all.end(),
                                        [](const Under& a, const Under& b) { return a.outside + a.rearranged < b.outside + b.rearranged; });
  out.compared += static_cast<std::int64_t>(texels.size());
  out.differing += all.front().differing;
  out.outside += best.outside;
  out.rearranged += best.rearranged;
}

/// The same for a case's keyed lists: ids whose records differ from the reference's, and ids that no alternative accepts.
void judge_mutant_lists(const Fault& d, const PassCase& c, const capture::PassEvaluations& evaluations, const capture::PassModel* model,
                        const enclosed::Profile& profile, MutantJudgement& out) {
  for (const std::size_t o : keyed_outputs(c)) {
    const capture::CaseOutput& expected = c.outputs[o];
    const std::optional<Array> stored = faulty_list(d, c, o, evaluations, model, expected.array);
    if (!stored) continue;
    const auto want = by_id(expected.array), have = by_id(*stored);
    std::set<std::uint32_t> ids, outside;
    for (const auto* list : {&want, &have})
      for (const auto& [id, unused] : *list) ids.insert(id);
    out.compared += static_cast<std::int64_t>(ids.size());
    for (const std::uint32_t id : ids) {
      const auto a = want.find(id), b = have.find(id);
      out.differing += a == want.end() || b == have.end() || a->second != b->second;
    }
    const KeyedJudgement j = judge_keyed(expected, *stored, model ? model->keyed(expected.name) : nullptr, profile);
    for (const auto* list : {&j.events.missing, &j.events.extra, &j.events.duplicate, &j.events.outside})
      outside.insert(list->begin(), list->end());
    out.outside += static_cast<std::int64_t>(outside.size());
    out.rearranged += j.rearranged;
  }
}

}  // namespace

MutationReport mutate(const capture::Pack& pack, const ValidateOptions& options, int invocations) {
  const enclosed::Profile& chosen = profile(options.profile);
  for (const std::string& pass : options.only) static_cast<void>(pack.pass(pass));
  check_pack(pack);
  MutationReport report;
  report.pack = path_text(pack.folder());
  report.profile = options.profile;
  int done = 0;
  for (const capture::PackPass& pass : pack.passes) {
    if (!options.wants(pass.name)) continue;
    const capture::PassEvaluations* evaluations = evaluations_of(pack.effect, pass.name);
    const Bind bind = binder(pack, pass.name);
    std::map<std::string, std::size_t> places;  // index of a fault in the mutants
    std::optional<PassCase> before;
    bool judged = false;
    for (const capture::PackCase& entry : pack.cases) {
      if (entry.pass != pass.name) continue;
      PassCase c = read_case(pack, entry);
      if ((!evaluations && !bind) || (slots_of(c).empty() && keyed_outputs(c).empty()) || (!bind && !slots_of(c).empty())) continue;
      judged = true;
      const std::unique_ptr<capture::PassModel> model = bind ? bind(c) : std::make_unique<capture::ListPass>("", nullptr);
      const std::vector<Texel> texels = spread(*model, invocations);
      std::vector<Fault> all = faults_of(pass, c, *model, before ? &*before : nullptr);
      std::erase_if(all, [](const Fault& d) { return d.for_diagnosis; });
      const std::vector<std::unique_ptr<const Stores>> stores = stores_under(chosen, c, *model, *options.executor);
      for (const Fault& d : all) {
        if (places.try_emplace(name_of(d), report.mutants.size()).second)
          report.mutants.push_back({pass.name, name_of(d), sentence_of(d), d.legal});
      }
      options.executor->for_range(static_cast<std::int64_t>(all.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t k = begin; k < end; ++k) {
          const Fault& d = all[static_cast<std::size_t>(k)];
          try {
            MutantJudgement& mutant = report.mutants[places.at(name_of(d))];
            if (evaluations) judge_mutant_lists(d, c, *evaluations, model.get(), chosen, mutant);
            judge_mutant(d, c, bind, *model, texels, stores, mutant);
          } catch (const Error&) {
            // the pass cannot run on the altered case: nothing to compare
          }
        }
      });
      before = std::move(c);
      if (options.progress) options.progress(++done, static_cast<int>(pack.cases.size()));
    }
    if (!judged) report.unjudged.push_back(fmt::format("{}: no output is judged by envelope or matched by id", pass.name));
  }
  return report;
}

}  // namespace rainref::faults
