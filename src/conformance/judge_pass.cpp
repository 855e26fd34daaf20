#include "conformance/judge_pass.h"

#include <algorithm>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "conformance/list_slips.h"
#include "conformance/validate.h"
#include "rainref/error.h"

namespace rainref::conformance {
namespace {

using capture::PassModel;

/// Binds and settles a run.
std::unique_ptr<PassModel> prepare(const capture::PackPass& pass, Bind bind, const PassRuns& runs, PortRun& run) {
  std::unique_ptr<PassModel> model = bound(pass.name, bind, run.c);
  if (runs.settle) runs.settle(run, model.get());
  return model;
}

/// A run that was not judged counts under every rounding.
ModeJudgements not_judged(const PortRun& run) {
  ModeJudgements out;
  out.judgements.resize(1);
  CaseJudgement& j = out.judgements.front();
  j.id = run.c.folder();
  j.status = run.broken.empty() ? Status::untested : Status::fail;
  j.reason = run.broken.empty() ? run.untested : run.broken;
  j.broken = !run.broken.empty();
  return out;
}

/// Sums a pass's cases under each rounding and keeps those of the best one.
void choose_mode(PassJudgement& pass, std::vector<ModeJudgements>& cases, const JudgeOptions& options) {
  const auto judged = std::find_if(cases.begin(), cases.end(), [](const ModeJudgements& c) { return !c.modes.empty(); });
  std::size_t best = 0;
  if (judged != cases.end()) {
    const std::vector<HalfMode> modes = judged->modes;
    std::vector<std::int64_t> failing(modes.size(), 0);
    for (const ModeJudgements& c : cases)
      for (std::size_t m = 0; m < c.modes.size(); ++m) failing[m] += c.judgements[m].failing;
    // Stores of one device round one way. Only when both ways fail and a mixture does not is it a mixture.
    if (modes.size() > 1 && failing[1] < failing[0]) best = 1;
    if (modes.size() == 3) {
      pass.half_mode_voted = true;
      std::copy(failing.begin(), failing.end(), pass.half_votes.begin());
      if (failing[best] > 0 && failing[2] == 0) best = 2;
    }
    pass.half_mode = modes[best];
    if (modes.size() == 2 && best == 1) {
      pass.reason = fmt::format("stores to binary16 round {}, where the profile {} asks for {}", modes[1] == HalfMode::rne ? "to nearest" : "toward zero",
                                options.profile->name, modes[0] == HalfMode::rne ? "to nearest" : "toward zero");
    }
  }
  for (ModeJudgements& c : cases) pass.cases.push_back(std::move(c.judgements[c.modes.empty() ? 0 : best]));
}

void conclude_pass(PassJudgement& pass) {
  const std::string doubt = std::move(pass.reason);  // of the rounding that was found
  pass.status = doubt.empty() ? Status::pass : Status::warn;
  pass.reason = doubt;
  for (const CaseJudgement& c : pass.cases) {
    const Status both = worse(pass.status, c.status);
    if (both != pass.status || (c.status == both && pass.reason.empty())) pass.reason = c.reason.empty() ? doubt : c.reason;
    pass.status = both;
  }
  if (!pass.cases.empty() && std::all_of(pass.cases.begin(), pass.cases.end(), [](const CaseJudgement& c) { return c.status == Status::data; })) {
    pass.status = Status::data;
    pass.reason = pass.cases[0].reason;
  }
  if (pass.cases.empty()) {
    pass.status = Status::untested;
    pass.reason = "there is no run of this pass";
  }
  if (pass.half_mode_voted && pass.half_mode == HalfMode::either && pass.status == Status::pass) {
    pass.status = Status::warn;
    pass.reason = "some stores to binary16 round to nearest and some toward zero";
  }
}

/// Asks about the run with the most failures, which says most.
std::vector<Cause> causes_of(const capture::PackPass& pass, Bind bind, const PassRuns& runs, const PassJudgement& judged, const JudgeOptions& options) {
  const auto worst = std::max_element(judged.cases.begin(), judged.cases.end(), [](const auto& a, const auto& b) { return a.failing < b.failing; });
  if (worst == judged.cases.end() || worst->failing == 0) return {};
  const auto k = static_cast<std::size_t>(worst - judged.cases.begin());
  PortRun run = runs.load(k);
  const bool has_lists = !keyed_outputs(run.c).empty();
  if (!is_enveloped(run.c) && !has_lists) return {};
  const std::unique_ptr<PassModel> model = prepare(pass, bind, runs, run);
  std::optional<PortRun> before;
  if (k > 0) {
    before = runs.load(k - 1);
    if (before->untested.empty()) prepare(pass, bind, runs, *before);
    else before.reset();
  }
  // A wrong list is behind what is wrong in an image that goes with it.
  if (has_lists) {
    std::vector<Cause> causes = diagnose_lists(pass, run.c, before ? &before->c : nullptr, model.get(), run.stored, *options.profile, *options.executor);
    if (!causes.empty() || !bind || !is_enveloped(run.c)) return causes;
  }
  return diagnose(pass, run.c, before ? &before->c : nullptr, bind, *model, run.stored, *worst, *options.profile, judged.half_mode, *options.executor);
}

}  // namespace

bool is_enveloped(const capture::PassCase& c) {
  return std::any_of(c.outputs.begin(), c.outputs.end(), [](const auto& o) { return o.judge == capture::Judge::envelope; });
}

std::unique_ptr<PassModel> bound(const std::string& pass, Bind bind, const capture::PassCase& c) {
  if (!bind && is_enveloped(c)) throw Error(ExitCode::internal, fmt::format("no reading of pass {}", pass));
  const auto has_model = [](const capture::CaseOutput& o) { return o.judge == capture::Judge::envelope || o.judge == capture::Judge::keyed; };
  return bind && std::any_of(c.outputs.begin(), c.outputs.end(), has_model) ? bind(c) : nullptr;
}

PassJudgement judge_pass(const capture::PackPass& pass, Bind bind, const PassRuns& runs, const JudgeOptions& options) {
  PassJudgement judged;
  judged.pass = pass.name;
  judged.formula = pass.formula;
  std::vector<ModeJudgements> cases;
  for (std::size_t k = 0; k < runs.count; ++k) {
    PortRun run = runs.load(k);
    std::unique_ptr<PassModel> model;
    if (run.untested.empty()) model = prepare(pass, bind, runs, run);
    if (!run.untested.empty()) {
      cases.push_back(not_judged(run));
    } else {
      cases.push_back(judge_case(run.c, model.get(), run.stored, options));
      for (CaseJudgement& j : cases.back().judgements) {
        if (run.broken.empty()) continue;
        j.status = Status::fail;
        j.reason = run.broken;
        j.broken = true;
      }
    }
    if (runs.done_one) runs.done_one();
  }
  choose_mode(judged, cases, options);
  conclude_pass(judged);
  if (runs.diagnose && judged.status == Status::fail) judged.causes = causes_of(pass, bind, runs, judged, options);
  return judged;
}

}  // namespace rainref::conformance
