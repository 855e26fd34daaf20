#include "judge/judge_pass.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "judge/conclude.h"
#include "judge/coverage.h"
#include "judge/evaluations.h"
#include "judge/half_votes.h"
#include "judge/keyed.h"
#include "judge/null_ports.h"
#include "judge/sample.h"
#include "judge/sampled_votes.h"
#include "judge/slots.h"
#include "rainref/error.h"

namespace rainref::judge {
namespace {

using capture::PassModel;

/// A run that was not judged has this judgement under every rounding.
ModeJudgements not_judged(const PortRun& run) {
  ModeJudgements out;
  out.judgements.resize(1);
  CaseJudgement& j = out.judgements.front();
  j.id = run.c.folder();
  j.status = !run.broken.empty() ? Status::fail : run.has_no_files ? Status::not_judged : Status::untested;
  j.reason = run.broken.empty() ? run.untested : run.broken;
  j.broken = !run.broken.empty();
  return out;
}

/// Failures of a pass under each rounding, over all of its cases.
HalfVotes votes_of(const std::string& pass, const std::vector<ModeJudgements>& cases) {
  HalfVotes votes{pass, {}, {}};
  const auto judged = std::find_if(cases.begin(), cases.end(), [](const ModeJudgements& c) { return !c.modes.empty(); });
  if (judged == cases.end()) return votes;
  votes.modes = judged->modes;
  votes.rounds_inside = judged->rounds_inside;
  votes.failing.resize(votes.modes.size(), 0);
  votes.undecided.resize(votes.modes.size(), 0);
  votes.with_bits.resize(votes.modes.size(), 0);
  for (const ModeJudgements& c : cases) {
    for (std::size_t m = 0; m < c.modes.size(); ++m) {
      votes.failing[m] += c.judgements[m].failing;
      votes.undecided[m] += c.judgements[m].undecided;
      votes.with_bits[m] += c.judgements[m].with_bits;
    }
  }
  return votes;
}

/// Keeps the judgement of each case under the found rounding.
void choose_mode(PassJudgement& pass, std::vector<ModeJudgements>& cases, const HalfVotes& own, const std::vector<HalfVotes>& all,
                 const JudgeOptions& options) {
  FoundRounding found;
  if (!own.modes.empty()) {
    found = pass_rounding(own, all, half_mode_of(*options.profile), options.profile->name);
    pass.half_mode = own.modes[found.mode];
    pass.reason = found.doubt;
    pass.half_mode_voted = own.modes.size() == 3;
    for (std::size_t m = 0; pass.half_mode_voted && m < 3; ++m) {
      pass.half_votes[m] = own.failing[m];
      pass.half_is_least[m] = own.most(m) != own.failing[m];
    }
  }
  for (ModeJudgements& c : cases) pass.cases.push_back(std::move(c.judgements[c.modes.empty() ? 0 : found.mode]));
}

/// A run and the previous one, for the diagnosis.
struct Asked {
  PortRun run;
  std::unique_ptr<PassModel> model;
  std::optional<PortRun> before;
};
Asked asked(const PassTask& task, std::size_t k) {
  Asked a{task.runs.load(k), nullptr, {}};
  a.model = prepare(task, a.run);
  if (k == 0) return a;
  a.before = task.runs.load(k - 1);
  if (a.before->untested.empty()) prepare(task, *a.before);
  if (!a.before->untested.empty()) a.before.reset();
  return a;
}

/// Diagnoses the run with the most failures, which is most informative, together with the next. `otherwise`: the pass judged by the other
/// rounding of halves, if nothing else tells the port's; or null.
Explanation explained(const PassTask& task, const PassJudgement& judged, const JudgeOptions& options, bool is_warned = false,
                      const PassJudgement* otherwise = nullptr) {
  std::vector<std::size_t> failing;
  for (std::size_t k = 0; k < judged.cases.size(); ++k)
    if (judged.cases[k].failing > 0) failing.push_back(k);
  std::stable_sort(failing.begin(), failing.end(),
                   [&](std::size_t a, std::size_t b) { return judged.cases[a].failing > judged.cases[b].failing; });
  if (failing.empty()) return {};
  failing.resize(std::min<std::size_t>(failing.size(), 2));
  std::vector<std::unique_ptr<const Asked>> runs;  // a model refers to its run, which must stay where it is
  for (const std::size_t k : failing) runs.emplace_back(new Asked(asked(task, k)));
  // From the second run to the first, which refers to it. The other rounding may have more failures in the second.
  const auto failed_by = [&](const PassJudgement& by, std::vector<FailedRun>& all) {
    const bool is_swapped = runs.size() == 2 && by.cases[failing[1]].failing > by.cases[failing[0]].failing;
    for (std::size_t k = runs.size(); k-- > 0;) {
      const std::size_t n = is_swapped ? 1 - k : k;
      const Asked& a = *runs[n];
      const PassCase* const before = a.before ? &a.before->c : nullptr;
      all.push_back({*task.pass, a.run, before, task.bind, a.model.get(), by.cases[failing[n]], by, by.half_mode, options,
                     all.empty() ? nullptr : &all.back(), is_warned});
    }
  };
  std::vector<FailedRun> all, by_other;
  all.reserve(runs.size()), by_other.reserve(runs.size());
  failed_by(judged, all);
  if (otherwise) failed_by(*otherwise, by_other), all.back().otherwise = &by_other.back();
  return task.runs.explain(all.back());
}

/// The same judgement with warned elements counted as failing.
PassJudgement as_failing(PassJudgement judged) {
  for (CaseJudgement& c : judged.cases) {
    if (c.status != Status::warn) continue;
    for (OutputJudgement& o : c.outputs) {
      o.failing = o.atypical + o.rearranged;
      for (std::uint8_t& texel : o.map) {
        c.failing += texel == 2;
        if (texel == 2) texel = 3;
      }
    }
  }
  return judged;
}
/// The likely cause of elements that are warned of, or nothing. A device may be the reason, so less certain causes are omitted.
std::vector<Cause> causes_of_warning(const PassTask& task, const PassJudgement& judged, const JudgeOptions& options) {
  JudgeOptions how = options;
  // What a known device would do defines what is near, except for rearrangements, which only the profile allows.
  const bool is_rearranged = std::any_of(judged.cases.begin(), judged.cases.end(), [](const CaseJudgement& c) { return c.rearranged > 0; });
  if (options.typical && !is_rearranged) how.profile = options.typical;
  std::vector<Cause> causes = explained(task, as_failing(judged), how, true).causes;
  std::erase_if(causes, [](const Cause& c) { return !c.is_likely; });
  return causes;
}

/// If nothing else tells the port's rounding of halves, diagnoses under each, and sets `judged` to the one with the better result. `cases`:
/// every run under each rounding.
Explanation explained_by_each(const PassTask& task, std::vector<ModeJudgements> cases, PassJudgement& judged, const JudgeOptions& options) {
  PassJudgement other = judged;
  other.cases.clear();
  other.reason.clear();
  for (ModeJudgements& c : cases) {
    const std::size_t mode = c.modes.empty() || c.modes[0] != judged.half_mode ? 0 : 1;
    if (!c.modes.empty()) other.half_mode = c.modes[mode];
    other.cases.push_back(std::move(c.judgements[mode]));
  }
  conclude(other, *options.profile);
  Explanation why = explained(task, judged, options, false, &other);
  if (why.is_otherwise) judged = std::move(other);
  return why;
}

/// A null port that passes all of these runs, which must be settled; "": none.
std::string null_port_of(const PassTask& task, const PassJudgement& judged, const JudgeOptions& options) {
  NullPorts ports;
  for (std::size_t k = 0; k < task.runs.count; ++k) {
    PortRun run = task.runs.load(k);
    if (!run.untested.empty()) continue;
    const std::unique_ptr<PassModel> model = bound(task.pass->name, task.bind, run.c);
    ports.judge(run.c, model.get(), *options.profile, options.typical, judged.half_mode, *options.executor);
  }
  return ports.passing();
}

/// The options of a run: its share of its pass's sample.
JudgeOptions options_of_run(const PassModel* model, const PassRuns& runs, JudgeOptions options) {
  const std::int64_t own = model ? static_cast<std::int64_t>(model->width()) * model->height() : 0;
  options.sample = sample_of_run(options.sample, own, std::max(own, runs.invocations));
  return options;
}

/// Judges every run of a pass under each possible rounding of the port; adds what they exercise to `coverage`, if it is not null.
std::vector<ModeJudgements> judge_runs(const PassTask& task, const JudgeOptions& options, Exercise* coverage) {
  const PassRuns& runs = task.runs;
  std::vector<ModeJudgements> cases;
  for (std::size_t k = 0; k < runs.count; ++k) {
    PortRun run = runs.load(k);
    std::unique_ptr<PassModel> model;
    if (run.untested.empty()) model = prepare(task, run);
    if (!run.untested.empty()) {
      cases.push_back(not_judged(run));
    } else {
      JudgeOptions of_run = options_of_run(model.get(), runs, options);
      of_run.kept = &run.kept;
      cases.push_back(judge_case(run.c, model.get(), run.stored, of_run));
      if (coverage && runs.counts_coverage)
        coverage->add(coverage_of(run.c, model.get(), *options.executor, of_run.sample, task.pass->block));
      for (CaseJudgement& j : cases.back().judgements) {
        if (run.broken.empty()) continue;
        j.status = Status::fail;
        j.reason = run.broken;
        j.broken = true;
      }
    }
    if (coverage && runs.done_one) runs.done_one();
  }
  return cases;
}

}  // namespace

std::unique_ptr<PassModel> prepare(const PassTask& task, PortRun& run) {
  std::unique_ptr<PassModel> model;
  try {
    model = bound(task.pass->name, task.bind, run.c);
    if (task.runs.settle) task.runs.settle(run, model.get());
  } catch (const Error& e) {
    if (!task.runs.takes_inputs_of_port || e.code() != ExitCode::port_files) throw;
    run.broken = run.untested = e.what();
  }
  if (!run.untested.empty()) return model;
  if (const std::string fault = length_fault(run.c, run.stored, run.kept); !fault.empty()) run.broken = run.untested = fault;
  return model;
}

std::vector<PassJudgement> judge_passes(const std::vector<PassTask>& tasks, const JudgeOptions& options,
                                        const std::vector<PassTask>& voters) {
  std::vector<std::vector<ModeJudgements>> cases;
  std::vector<HalfVotes> votes;
  std::vector<Exercise> coverage(tasks.size());
  for (const PassTask& task : tasks) {
    cases.push_back(judge_runs(task, options, &coverage[cases.size()]));
    votes.push_back(votes_of(task.pass->name, cases.back()));
  }
  // Invocations accepted under one rounding are tested under the others only if the port's rounding may depend on it.
  JudgeOptions every = options;
  every.every_rounding = true;
  if (std::any_of(votes.begin(), votes.end(), [](const HalfVotes& v) { return v.modes.size() >= 2; }))
    for (const PassTask& voter : voters) votes.push_back(sampled_votes(voter, options));
  while (const auto k = first_undecided(votes, half_mode_of(*options.profile))) {
    cases[*k] = judge_runs(tasks[*k], every, nullptr);
    votes[*k] = votes_of(tasks[*k].pass->name, cases[*k]);
  }
  std::vector<PassJudgement> all;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const PassTask& task = tasks[k];
    PassJudgement& judged = all.emplace_back();
    judged.pass = task.pass->name;
    judged.formula = task.pass->formula;
    judged.causes_sought = static_cast<bool>(task.runs.explain);
    judged.coverage = summary(coverage[k], task.pass->unexercised);
    judged.half_mode_is_open = fails_by_each(votes[k]) && is_rounding_open(votes);
    std::vector<ModeJudgements> by_each;
    if (judged.half_mode_is_open && task.runs.explain) by_each = votes[k].is_whole() ? cases[k] : judge_runs(task, every, nullptr);
    choose_mode(judged, cases[k], votes[k], votes, options);
    conclude(judged, *options.profile);
    if (task.runs.tries_null_ports && (judged.status == Status::pass || judged.status == Status::warn)) {
      judged.null_port = null_port_of(task, judged, options);
      if (!judged.null_port.empty()) {
        judged.status = Status::untested;
        judged.reason = "a port that does nothing passes: " + judged.null_port;
      }
    }
    if (!task.runs.explain) continue;
    if (judged.status == Status::warn) judged.causes = causes_of_warning(task, judged, options);
    if (judged.status != Status::fail) continue;
    Explanation why =
        judged.half_mode_is_open ? explained_by_each(task, std::move(by_each), judged, options) : explained(task, judged, options);
    judged.causes = std::move(why.causes);
    judged.where = std::move(why.where);
  }
  return all;
}

}  // namespace rainref::judge
