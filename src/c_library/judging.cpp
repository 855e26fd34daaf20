// Verdicts on outputs in memory for C: texts point into the judgement.
#include "base/path_text.h"
#include "c_library/call.h"
#include "c_library/handles.h"
#include "judging/judge_folder.h"

using namespace rainref;
using c_library::call;
using c_library::required;
using c_library::sized;
using judging::require_index;

namespace {

std::optional<Rounding> rounding(const char* half) {
  if (!half) return std::nullopt;
  const std::string_view mode = half;
  if (mode != "rne" && mode != "rtz")
    throw Error(ExitCode::usage, fmt::format("rr_judge_options.half: expected \"rne\", \"rtz\" or NULL, found \"{}\"", mode));
  return mode == "rne" ? Rounding::rne : Rounding::rtz;
}

const PassVerdict& pass_of(const rr_judgement* judgement, size_t pass) {
  const rr_judgement& j = required(judgement, "judgement");
  require_index(pass, j.made.verdict.passes.size(), "pass");
  return j.made.verdict.passes[pass];
}

/// A report, which is made on the first call.
template <class Make>
int report(rr_judgement* judgement, const char** text, std::optional<std::string> rr_judgement::*which, const Make& make) {
  return call([&] {
    std::optional<std::string>& own = required(judgement, "judgement").*which;
    required(text, "text") = nullptr;
    if (!own) own = make(judgement->made);
    *text = own->c_str();
  });
}

}  // namespace

int rr_judge(const rr_cases* cases, const rr_judge_options* options, rr_judgement** judgement) {
  return call([&] {
    const rr_cases& c = required(cases, "cases");
    required(judgement, "judgement") = nullptr;
    const rr_judge_options o =
        options ? sized(options, "rr_judge_options") : rr_judge_options{sizeof o, nullptr, nullptr, nullptr, 0, 0, 0, nullptr};
    JudgeOptions how;
    if (o.profile) how.profile = o.profile;
    if (o.port) how.port = o.port;
    how.half = rounding(o.half);
    how.strict = o.strict != 0;
    how.exhaustive = o.exhaustive != 0;
    if (o.spirv) how.spirv = utf8_path(o.spirv);
    *judgement = std::make_unique<rr_judgement>(rr_judgement{judging::judge_cases(c.list, how, parallel::Executor(o.threads))}).release();
  });
}
int rr_judge_folder(const char* pack, const char* port, const rr_folder_options* options, rr_judgement** judgement) {
  return call([&] {
    required(judgement, "judgement") = nullptr;
    const rr_folder_options o = options ? sized(options, "rr_folder_options")
                                        : rr_folder_options{sizeof o, nullptr, nullptr, 0, 0, 0, nullptr, nullptr, 0, 0, nullptr};
    judging::FolderOptions how;
    if (o.profile) how.profile = o.profile;
    how.only = c_library::texts(o.passes, o.pass_count, "rr_folder_options.passes");
    how.partial = o.partial != 0;
    how.strict = o.strict != 0;
    if (o.exhaustive != 0) how.sample = 0;
    if (o.spirv) how.spirv = utf8_path(o.spirv);
    how.progress = c_library::progress_of(o.progress, o.user, "rr_folder_options.progress", "runs");
    const parallel::Executor executor(o.threads);
    how.executor = &executor;
    const auto opened = std::make_shared<const capture::Pack>(utf8_path(&required(pack, "pack")));
    *judgement =
        std::make_unique<rr_judgement>(rr_judgement{judging::judge_folder(opened, {utf8_path(&required(port, "port"))}, how)}).release();
  });
}
void rr_free_judgement(rr_judgement* judgement) {
  call([&] { delete judgement; });
}

int rr_get_verdict(const rr_judgement* judgement, rr_verdict* verdict) {
  return call([&] {
    const Verdict& v = required(judgement, "judgement").made.verdict;
    sized(verdict, "rr_verdict") = {sizeof(rr_verdict),       v.status.c_str(),  v.reason.c_str(),
                                    v.first_bad_pass.c_str(), v.profile.c_str(), v.passes.size()};
  });
}
int rr_get_pass_verdict(const rr_judgement* judgement, size_t pass, rr_pass_verdict* verdict) {
  return call([&] {
    const PassVerdict& p = pass_of(judgement, pass);
    sized(verdict, "rr_pass_verdict") = {sizeof(rr_pass_verdict),
                                         p.pass.c_str(),
                                         p.formula.c_str(),
                                         p.status.c_str(),
                                         p.reason.c_str(),
                                         p.where.c_str(),
                                         p.cases,
                                         p.elements,
                                         p.outside,
                                         p.differing,
                                         p.vacuous,
                                         p.causes.size(),
                                         p.worst.size(),
                                         p.sampled};
  });
}
int rr_get_cause(const rr_judgement* judgement, size_t pass, size_t index, rr_cause* cause) {
  return call([&] {
    const PassVerdict& p = pass_of(judgement, pass);
    require_index(index, p.causes.size(), "cause");
    const Cause& c = p.causes[index];
    sized(cause, "rr_cause") = {sizeof(rr_cause), c.name.c_str(), c.sentence.c_str(), c.explained, c.of,
                                c.inside,         c.is_likely,    c.lines.size()};
  });
}
int rr_get_line(const rr_judgement* judgement, size_t pass, size_t cause, size_t index, const char** line) {
  return call([&] {
    required(line, "line") = nullptr;
    const PassVerdict& p = pass_of(judgement, pass);
    require_index(cause, p.causes.size(), "cause");
    require_index(index, p.causes[cause].lines.size(), "line");
    *line = p.causes[cause].lines[index].c_str();
  });
}
int rr_get_failure(const rr_judgement* judgement, size_t pass, size_t index, rr_failure* failure) {
  return call([&] {
    const PassVerdict& p = pass_of(judgement, pass);
    rr_failure& to = sized(failure, "rr_failure");
    require_index(index, p.worst.size(), "failure");
    const Failure& f = p.worst[index];
    to = {sizeof to, f.case_id.c_str(), f.output.c_str(), f.field.c_str(), f.x, f.y, f.channel, f.is_a_number, f.got, f.low,
          f.high,    f.expected,        f.text.c_str()};
  });
}

int rr_report_text(rr_judgement* judgement, const char** text) {
  return report(judgement, text, &rr_judgement::text, [](const judging::Judged& j) { return j.text(); });
}
int rr_report_json(rr_judgement* judgement, const char** json) {
  return report(judgement, json, &rr_judgement::json, [](const judging::Judged& j) { return j.json(); });
}
int rr_report_html(rr_judgement* judgement, const char** html) {
  return report(judgement, html, &rr_judgement::html, [](const judging::Judged& j) { return j.html(); });
}
int rr_report_junit(rr_judgement* judgement, const char** junit) {
  return report(judgement, junit, &rr_judgement::junit, [](const judging::Judged& j) { return j.junit(); });
}
