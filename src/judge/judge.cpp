#include "judge/judge.h"

#include <algorithm>

#include <fmt/format.h>

#include "judge/bits.h"
#include "judge/conclude.h"
#include "judge/envelopes.h"
#include "judge/keyed.h"
#include "judge/quantities.h"
#include "judge/slots.h"
#include "rainref/error.h"

namespace rainref::judge {

using capture::Array;
using capture::PassCase;
using capture::PassModel;

HalfMode half_mode_of(const enclosed::Profile& profile) {
  return profile.half_store == enclosed::StoreRounding::rne   ? HalfMode::rne
         : profile.half_store == enclosed::StoreRounding::rtz ? HalfMode::rtz
                                                              : HalfMode::either;
}

std::vector<HalfMode> modes_of(const PassCase& c, const JudgeOptions& options) {
  const bool has_half = std::any_of(c.outputs.begin(), c.outputs.end(), [](const capture::CaseOutput& o) {
    return o.judge == capture::Judge::envelope && !o.array.is_records && info(o.array.format).kind == FormatInfo::float16;
  });
  const HalfMode declared = half_mode_of(*options.profile);
  if (options.profile->reference || !has_half) return {declared == HalfMode::either ? HalfMode::rne : declared};
  if (declared != HalfMode::either && options.half_mode == declared) return {declared};
  if (declared != HalfMode::either) return {declared, declared == HalfMode::rne ? HalfMode::rtz : HalfMode::rne};
  if (options.half_mode) return {*options.half_mode};
  return {HalfMode::rne, HalfMode::rtz, HalfMode::either};
}

namespace {

/// Adds the outputs judged by bits and by ids to those judged by envelope, and concludes.
void settle(const PassCase& c, const PassModel* model, const std::vector<Array>& port, const JudgeOptions& options, bool enveloped,
            CaseJudgement& j) {
  j.id = c.folder();
  std::vector<OutputJudgement> outputs;  // each judged output once, in the case's order
  std::string events;
  const std::vector<Slot> slots = enveloped ? slots_of(c, *model) : std::vector<Slot>();
  for (std::size_t o = 0; o < c.outputs.size(); ++o) {
    if (is_placed(c.outputs[o]) && enveloped) {
      outputs.push_back(std::move(j.outputs[o]));
      name_quantities(quantities_of(c.outputs[o]), outputs.back());
      for (std::size_t v = 0; v < slots.size(); ++v)
        if (slots[v].output == static_cast<int>(o) && model->extent(static_cast<int>(v)))
          outputs.back().quantities[static_cast<std::size_t>(slots[v].channel)].extent = slots[v].range;
    }
    if (c.outputs[o].judge == capture::Judge::bits) {
      outputs.push_back(judge_bits(c.outputs[o], port[o]));
      j.invocations = std::max(j.invocations, outputs.back().elements);
      j.failing += outputs.back().failing;
    }
    if (c.outputs[o].judge != capture::Judge::keyed || is_placed(c.outputs[o])) continue;
    KeyedJudgement k = judge_keyed(c.outputs[o], port[o], model ? model->keyed(c.outputs[o].name) : nullptr, *options.profile);
    j.invocations += k.groups;
    j.failing += k.failing;
    j.ambiguous += k.ambiguous;
    j.other_branch += k.other_branch;
    j.gave_up += k.gave_up;
    j.rearranged += k.rearranged;
    j.rearranged_distance = std::max(j.rearranged_distance, k.rearranged_distance);
    outputs.push_back(std::move(k.output));
    if (const std::string text = k.events.text(); !text.empty())
      events += fmt::format("{}{}, {}", events.empty() ? "" : "; ", c.outputs[o].name, text);
  }
  j.outputs = std::move(outputs);
  conclude(j, *options.profile);
  if (!events.empty()) j.reason = events;
  if (std::all_of(c.outputs.begin(), c.outputs.end(), [](const auto& o) { return o.judge == capture::Judge::input_only; })) {
    j.status = Status::data;
    j.reason = "taken as data: no GPU can reproduce it";
  }
}

}  // namespace

ModeJudgements judge_case(const PassCase& c, const PassModel* model, const std::vector<Array>& port, const JudgeOptions& options) {
  ModeJudgements result{modes_of(c, options), {}};
  result.rounds_inside = model && model->rounds_inside();
  const bool enveloped = !slots_of(c).empty();
  if (enveloped && !model) throw Error(ExitCode::internal, fmt::format("{}: no evaluation of this pass", c.pass));
  if (enveloped)
    result.judgements = judge_envelopes(c, *model, port, options, result.modes);
  else
    result.judgements.assign(result.modes.size(), CaseJudgement{});
  for (CaseJudgement& j : result.judgements) settle(c, model, port, options, enveloped, j);
  if (std::none_of(result.judgements.begin(), result.judgements.end(), is_open_by_sample)) return result;
  JudgeOptions all = options;
  all.sample = 0;
  return judge_case(c, model, port, all);
}

}  // namespace rainref::judge
