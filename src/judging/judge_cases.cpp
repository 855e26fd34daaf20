#include "judging/judge_cases.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/path_text.h"
#include "faults/diagnose.h"
#include "image/code_range.h"
#include "judge/check_pack.h"
#include "judge/conclude.h"
#include "judge/judge_pass.h"
#include "judge/profiles.h"
#include "judging/shader_answer.h"
#include "rainref/error.h"
#include "reports/figures.h"
#include "reports/html.h"
#include "reports/json.h"
#include "reports/junit.h"
#include "reports/text.h"

namespace rainref::judging {
namespace {

/// Converts a run to the judge's form.
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

judge::PortJudgement judged(const CaseList& cases, const JudgeOptions& o, const parallel::Executor& executor) {
  const Programs programs = o.spirv.empty() ? Programs() : spirv::read_programs(o.spirv);
  const enclosed::Profile& profile = judge::judging_profile(o.profile);
  std::optional<judge::HalfMode> half;
  if (o.half) half = *o.half == Rounding::rne ? judge::HalfMode::rne : judge::HalfMode::rtz;
  const judge::JudgeOptions options{&profile, profile.reference ? nullptr : &judge::profile("typical"), &executor, half,
                                    o.exhaustive ? 0 : judge::least_sample};
  std::vector<judge::PassTask> tasks;
  for (const capture::PackPass& pass : cases.passes()) {
    std::vector<const Run*> own;
    for (const Run& run : cases.runs())
      if (run.c->pass == pass.name) own.push_back(&run);
    if (std::none_of(own.begin(), own.end(), [](const Run* r) { return r->has_any(); })) continue;
    judge::PassRuns all;
    all.count = own.size();
    for (const Run* run : own)
      all.invocations += judge::invocations_of(
          run->c->outputs, [](const auto& output) -> const auto& { return output.array; });
    all.explain = [&](const judge::FailedRun& failed) { return explain(failed, programs, faults::SearchLimit(0)); };
    all.tries_null_ports = true;
    all.counts_coverage = cases.pack() != nullptr;
    all.load = [own](std::size_t k) { return port_run(*own[k]); };
    if (cases.pack())
      all.settle = [&](judge::PortRun& run, const capture::PassModel* model) {
        if (model && run.untested.empty()) judge::require_reference(*cases.pack(), run.c, *model, executor);
      };
    tasks.push_back({&pass, judge::binder(cases.effect(), pass.name), std::move(all)});
  }
  if (tasks.empty()) throw Error(ExitCode::port_files, "cases: expected outputs of a port, given for one case or more, found none");
  judge::PortJudgement result;
  result.pack = cases.pack() ? path_text(cases.pack()->folder()) : cases.scene();
  result.port = o.port;
  result.profile = o.profile;
  result.effect = cases.effect();
  result.variant = cases.variant();
  result.scene = cases.scene();
  for (const Run& run : cases.runs())
    for (const std::vector<std::string>& notes : run.notes) result.notes.insert(result.notes.end(), notes.begin(), notes.end());
  result.passes = judge::judge_passes(tasks, options);
  judge::conclude(result);
  const auto load = [&](const std::string& id) -> std::optional<StoredRun> {
    for (const Run& run : cases.runs())
      for (const capture::PackPass& pass : cases.passes())
        if (run.id == id && run.has_any() && pass.name == run.c->pass) return StoredRun{*run.c, port_run(run).stored, pass.block};
    return std::nullopt;
  };
  if (!programs.empty())
    ask_shaders(
        load, [&](const std::string& pass) { return judge::binder(cases.effect(), pass); }, programs, result);
  if (o.strict) judge::fail_warnings(result);
  return result;
}

reports::PageSource source_of(const CaseList& cases) {
  reports::PageSource source;
  source.edges = cases.edges();
  for (const capture::PackPass& p : cases.passes()) source.sentences[p.name] = p.sentence;
  source.read = [runs = cases.runs()](const std::string& id, const std::string& output) -> std::optional<reports::OutputBuffers> {
    for (const Run& run : runs) {
      if (run.id != id) continue;
      for (std::size_t o = 0; o < run.given.size(); ++o)
        if (run.c->outputs[o].name == output && run.given[o]) return reports::OutputBuffers{run.c->outputs[o], *run.given[o]};
    }
    return std::nullopt;
  };
  return source;
}

Failure failure(const std::string& id, const judge::OutputJudgement& o, const judge::Failure& f) {
  Failure out;
  out.case_id = id;
  out.output = o.name;
  out.field = f.field;
  out.x = f.x;
  out.y = f.y;
  out.channel = f.channel;
  out.is_a_number = !f.not_a_number;
  const reports::FailureText t = reports::failure_text(o, f);
  out.text = fmt::format("{}/out.{} {}: ", id, o.name, t.place);
  if (!t.got.empty()) out.text += fmt::format("got {}, accepted {}, expected {}; ", t.got, t.accepted, t.expected);
  out.text += t.distance;
  if (o.records && f.field.empty()) return out;
  const FormatInfo::Kind kind = o.records ? f.field_kind : info(o.format).kind;
  const auto value = [kind](std::int64_t code) { return static_cast<double>(enclosed::code_value(kind, code)); };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool is_bounded = f.low != INT64_MIN;
  out.got = f.not_a_number ? std::numeric_limits<double>::quiet_NaN() : value(f.got);
  out.low = is_bounded ? value(f.low) : -infinity;
  out.high = is_bounded ? value(f.high) : infinity;
  out.expected = value(f.expected);
  return out;
}

/// The failing elements of a pass, those of the worst output first.
std::vector<Failure> worst_of(const judge::PassJudgement& pass) {
  std::vector<std::pair<const judge::CaseJudgement*, const judge::OutputJudgement*>> outputs;
  for (const judge::CaseJudgement& c : pass.cases)
    for (const judge::OutputJudgement& o : c.outputs)
      if (!o.worst.empty()) outputs.emplace_back(&c, &o);
  std::stable_sort(outputs.begin(), outputs.end(), [](const auto& a, const auto& b) { return reports::fails_worse(*a.second, *b.second); });
  std::vector<Failure> out;
  for (const auto& [c, o] : outputs)
    for (const judge::Failure& f : o->worst) out.push_back(failure(c->id, *o, f));
  return out;
}

}  // namespace

Verdict verdict_of(const judge::PortJudgement& j) {
  Verdict v{judge::name(j.status), j.reason, j.first_bad_pass, j.profile, {}};
  for (const judge::PassJudgement& p : j.passes) {
    const reports::Figures f = reports::figures_of(p);
    PassVerdict pass{p.pass,     p.formula, judge::name(p.status), p.reason,  p.where, static_cast<std::int64_t>(p.cases.size()),
                     f.judged(), f.outside, f.differing,           f.vacuous, {},      worst_of(p),
                     f.sampled()};
    for (const judge::Cause& c : p.causes)
      pass.causes.push_back({c.name, c.sentence, c.explained, c.of, c.inside, c.is_likely, reports::line_texts(c)});
    v.passes.push_back(std::move(pass));
  }
  return v;
}

std::string Judged::text() const { return reports::report_text(judged); }
std::string Judged::json() const { return reports::report_json(judged, reports::exit_code(judged, false), source); }
std::string Judged::html() const { return reports::report_html(judged, reports::exit_code(judged, false), source); }
std::string Judged::junit() const { return reports::report_junit(judged, false); }

Judged judge_cases(const CaseList& cases, const JudgeOptions& options, const parallel::Executor& executor) {
  Judged out{judged(cases, options, executor), source_of(cases), {}};
  out.verdict = verdict_of(out.judged);
  return out;
}

}  // namespace rainref::judging
