// Verdicts on outputs in memory, and their reports.
#include <algorithm>

#include "c_library/call.h"
#include "c_library/handles.h"
#include "faults/diagnose.h"
#include "image/code_range.h"
#include "judge/check_pack.h"
#include "judge/conclude.h"
#include "judge/judge_pass.h"
#include "judge/profiles.h"
#include "reports/figures.h"
#include "reports/html.h"
#include "reports/json.h"
#include "reports/text.h"

using namespace rainref;
using c_library::call;
using c_library::require_index;
using c_library::required;
using c_library::Run;
using c_library::sized;
using c_library::WorstElement;

namespace {

std::optional<judge::HalfMode> half_mode(const char* half) {
  if (!half) return std::nullopt;
  const std::string_view mode = half;
  if (mode != "rne" && mode != "rtz")
    throw Error(ExitCode::usage, fmt::format("rr_judge_options.half: expected \"rne\", \"rtz\" or NULL, found \"{}\"", mode));
  return mode == "rne" ? judge::HalfMode::rne : judge::HalfMode::rtz;
}

/// A run as the judge takes it.
judge::PortRun port_run(const Run& run) {
  judge::PortRun out;
  out.c = *run.c;
  for (std::size_t o = 0; o < run.given.size(); ++o) {
    if (run.given[o]) {
      out.stored.push_back(*run.given[o]);
    } else if (run.c->outputs[o].judge == capture::Judge::input_only) {
      out.stored.push_back(run.c->outputs[o].array);
    } else if (out.untested.empty()) {
      out.has_no_files = true;
      out.untested = fmt::format("output {} was not given", run.c->outputs[o].name);
    }
  }
  return out;
}

judge::PortJudgement judged(const rr_cases& cases, const std::vector<Run>& runs, const rr_judge_options& o) {
  const std::string name = o.profile ? o.profile : judge::ValidateOptions().profile;
  const enclosed::Profile& profile = judge::judging_profile(name);
  const parallel::Executor executor(o.threads);
  const judge::JudgeOptions options{&profile, profile.reference ? nullptr : &judge::profile("typical"), &executor, half_mode(o.half)};
  std::vector<judge::PassTask> tasks;
  for (const capture::PackPass& pass : cases.passes) {
    std::vector<const Run*> own;
    for (const Run& run : runs)
      if (run.c->pass == pass.name) own.push_back(&run);
    if (std::none_of(own.begin(), own.end(), [](const Run* r) { return r->has_any(); })) continue;
    judge::PassRuns all;
    all.count = own.size();
    all.explain = faults::diagnose;
    all.tries_null_ports = true;
    all.counts_coverage = cases.pack != nullptr;
    all.load = [own](std::size_t k) { return port_run(*own[k]); };
    if (cases.pack)
      all.settle = [&](judge::PortRun& run, const capture::PassModel* model) {
        if (model && run.untested.empty()) judge::require_reference(*cases.pack, run.c, *model, executor);
      };
    tasks.push_back({&pass, judge::binder(cases.effect, pass.name), std::move(all)});
  }
  if (tasks.empty()) throw Error(ExitCode::port_files, "cases: expected outputs of a port (rr_give), found none");
  judge::PortJudgement result;
  result.pack = cases.pack ? cases.pack->folder().string() : cases.scene;
  result.port = o.port ? o.port : "outputs in memory";
  result.profile = name;
  result.effect = cases.effect;
  result.variant = cases.variant;
  result.scene = cases.scene;
  result.passes = judge::judge_passes(tasks, options);
  judge::conclude(result);
  return result;
}

/// What the page of a judgement shows: the outputs as they were when it was made.
reports::PageSource source_of(const rr_cases& cases, std::vector<Run> runs) {
  reports::PageSource source;
  source.edges = cases.edges;
  for (const capture::PackPass& p : cases.passes) source.sentences[p.name] = p.sentence;
  source.read = [runs = std::move(runs)](const std::string& id, const std::string& output) -> std::optional<reports::OutputBuffers> {
    for (const Run& run : runs) {
      if (run.id != id) continue;
      for (std::size_t o = 0; o < run.given.size(); ++o)
        if (run.c->outputs[o].name == output && run.given[o]) return reports::OutputBuffers{run.c->outputs[o], *run.given[o]};
    }
    return std::nullopt;
  };
  return source;
}

WorstElement worst_element(const std::string& id, const judge::OutputJudgement& o, const judge::Failure& f) {
  WorstElement w{{}, id, o.name, f.field, ""};
  const FormatInfo::Kind kind = o.records ? f.field_kind : info(o.format).kind;
  const reports::FailureText t = reports::failure_text(o, f);
  w.text = fmt::format("{}/out.{} {}: ", id, o.name, t.place);
  if (!t.got.empty()) w.text += fmt::format("got {}, accepted {}, expected {}; ", t.got, t.accepted, t.expected);
  w.text += t.distance;
  const auto value = [kind](std::int64_t code) { return static_cast<double>(enclosed::code_value(kind, code)); };
  w.failure.struct_bytes = sizeof w.failure;
  w.failure.x = f.x;
  w.failure.y = f.y;
  w.failure.channel = f.channel;
  w.failure.is_a_number = !f.not_a_number;
  if (o.records && f.field.empty()) return w;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool is_bounded = f.low != INT64_MIN;
  w.failure.got = f.not_a_number ? std::numeric_limits<double>::quiet_NaN() : value(f.got);
  w.failure.low = is_bounded ? value(f.low) : -infinity;
  w.failure.high = is_bounded ? value(f.high) : infinity;
  w.failure.expected = value(f.expected);
  return w;
}

/// The elements of a pass that failed, those of the worst output first.
std::vector<WorstElement> worst_of(const judge::PassJudgement& pass) {
  std::vector<std::pair<const judge::CaseJudgement*, const judge::OutputJudgement*>> outputs;
  for (const judge::CaseJudgement& c : pass.cases)
    for (const judge::OutputJudgement& o : c.outputs)
      if (!o.worst.empty()) outputs.emplace_back(&c, &o);
  std::stable_sort(outputs.begin(), outputs.end(), [](const auto& a, const auto& b) { return reports::fails_worse(*a.second, *b.second); });
  std::vector<WorstElement> out;
  for (const auto& [c, o] : outputs)
    for (const judge::Failure& f : o->worst) out.push_back(worst_element(c->id, *o, f));
  for (WorstElement& w : out) {
    w.failure.case_id = w.case_id.c_str();  // now that none of them moves any more
    w.failure.output = w.output.c_str();
    w.failure.field = w.field.c_str();
    w.failure.text = w.text.c_str();
  }
  return out;
}

const judge::PassJudgement& pass_of(const rr_judgement* judgement, size_t pass) {
  const rr_judgement& j = required(judgement, "judgement");
  require_index(pass, j.judged.passes.size(), "pass");
  return j.judged.passes[pass];
}

/// A report, which is made once.
template <class Make>
int report(rr_judgement* judgement, const char** text, std::optional<std::string> rr_judgement::*which, const Make& make) {
  return call([&] {
    std::optional<std::string>& own = required(judgement, "judgement").*which;
    required(text, "text") = nullptr;
    if (!own) own = make(*judgement);
    *text = own->c_str();
  });
}

}  // namespace

int rr_judge(const rr_cases* cases, const rr_judge_options* options, rr_judgement** judgement) {
  return call([&] {
    const rr_cases& c = required(cases, "cases");
    required(judgement, "judgement") = nullptr;
    const rr_judge_options o = options ? sized(options, "rr_judge_options") : rr_judge_options{sizeof o, nullptr, nullptr, nullptr, 0};
    auto made = std::make_unique<rr_judgement>(rr_judgement{judged(c, c.runs, o), source_of(c, c.runs)});
    for (const judge::PassJudgement& pass : made->judged.passes) made->worst.push_back(worst_of(pass));
    *judgement = made.release();
  });
}
void rr_free_judgement(rr_judgement* judgement) {
  call([&] { delete judgement; });
}

int rr_get_verdict(const rr_judgement* judgement, rr_verdict* verdict) {
  return call([&] {
    const judge::PortJudgement& j = required(judgement, "judgement").judged;
    sized(verdict, "rr_verdict") = {sizeof(rr_verdict),       judge::name(j.status), j.reason.c_str(),
                                    j.first_bad_pass.c_str(), j.profile.c_str(),     j.passes.size()};
  });
}
int rr_get_pass_verdict(const rr_judgement* judgement, size_t pass, rr_pass_verdict* verdict) {
  return call([&] {
    const judge::PassJudgement& p = pass_of(judgement, pass);
    const reports::Figures f = reports::figures_of(p);
    sized(verdict, "rr_pass_verdict") = {sizeof(rr_pass_verdict),
                                         p.pass.c_str(),
                                         p.formula.c_str(),
                                         judge::name(p.status),
                                         p.reason.c_str(),
                                         p.where.c_str(),
                                         static_cast<int64_t>(p.cases.size()),
                                         f.judged(),
                                         f.outside,
                                         f.differing,
                                         f.vacuous,
                                         p.causes.size(),
                                         judgement->worst[pass].size()};
  });
}
int rr_get_cause(const rr_judgement* judgement, size_t pass, size_t index, rr_cause* cause) {
  return call([&] {
    const judge::PassJudgement& p = pass_of(judgement, pass);
    require_index(index, p.causes.size(), "cause");
    const judge::Cause& c = p.causes[index];
    sized(cause, "rr_cause") = {sizeof(rr_cause), c.name.c_str(), c.sentence.c_str(), c.explained, c.of, c.inside, c.is_likely};
  });
}
int rr_get_failure(const rr_judgement* judgement, size_t pass, size_t index, rr_failure* failure) {
  return call([&] {
    pass_of(judgement, pass);
    const std::vector<WorstElement>& worst = judgement->worst[pass];
    rr_failure& to = sized(failure, "rr_failure");
    require_index(index, worst.size(), "failure");
    to = worst[index].failure;
  });
}

int rr_report_text(rr_judgement* judgement, const char** text) {
  return report(judgement, text, &rr_judgement::text, [](const rr_judgement& j) { return reports::report_text(j.judged); });
}
int rr_report_json(rr_judgement* judgement, const char** json) {
  return report(judgement, json, &rr_judgement::json,
                [](const rr_judgement& j) { return reports::report_json(j.judged, reports::exit_code(j.judged, false)); });
}
int rr_report_html(rr_judgement* judgement, const char** html) {
  return report(judgement, html, &rr_judgement::html, [](const rr_judgement& j) { return reports::report_html(j.judged, j.source); });
}
