#include "cli/validate_reports.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/folders.h"
#include "base/hidden.h"
#include "base/path_text.h"
#include "cli/commands.h"
#include "cli/run_command.h"
#include "cli/terminal.h"
#include "rainref/error.h"
#include "reports/annotations.h"
#include "reports/figures.h"
#include "reports/html.h"
#include "reports/json.h"
#include "reports/markdown.h"

namespace rainref::cli {
void add_report_options(CLI::App& verb, ReportOptions& options) {
  verb.add_option("--json", options.json, "Write the whole judgement as JSON; - is standard output");
  verb.add_option("--junit", options.junit, "Write it as JUnit XML, for continuous integration; or -");
  verb.add_option("--html", options.html, "Write it as one page with pictures of what fails; or -");
  verb.add_option("--markdown", options.markdown, "Write it as Markdown, for a job's summary such as $GITHUB_STEP_SUMMARY; or -");
  verb.add_flag("--github", options.annotates,
                "Print what fails as annotations of GitHub's actions too: with --spirv at the line of the shader");
  verb.add_option("--baseline", options.baseline, "Known failures (TOML): they pass, and what no longer fails is an error");
}

std::string command_text(int argc, const char* const* argv) {
  std::string out = "rainref";
  for (int i = 1; i < argc; ++i) out += " " + shell_word(argv[i]);
  return out;
}

Reports::Reports(const ReportOptions& o, bool allow_untested) : allow_untested_(allow_untested), annotates_(o.annotates) {
  if (o.baseline) {
    if (o.baseline->empty()) throw Error(ExitCode::usage, "--baseline: expected a file, found ''");
    baseline_ = reports::Baseline::read(utf8_path(*o.baseline));
  }
  const auto add = [&](const char* option, const std::optional<std::string>& path, auto text) {
    if (!path) return;
    if (path->empty()) throw Error(ExitCode::usage, fmt::format("{}: expected a file, found ''", option));
    reports_.push_back({*path, *path == "-" ? nullptr : std::make_unique<AtomicFile>(utf8_path(*path)), text});
  };
  add("--json", o.json, [](const Content& c) { return reports::report_json(c.judgement, c.exit_code, c.source); });
  add("--junit", o.junit, [allow_untested](const Content& c) { return reports::report_junit(c.judgement, allow_untested, c.times); });
  add("--html", o.html, [](const Content& c) { return reports::report_html(c.judgement, c.exit_code, c.source); });
  add("--markdown", o.markdown, [](const Content& c) { return reports::report_markdown(c.judgement); });
  // Compares resolved paths: "r" and "./r" are one file, and so are a link and its target.
  std::map<std::filesystem::path, std::string> named;
  const auto claim = [&](const std::string& name, const std::filesystem::path& target) {
    std::error_code ignored;
    const std::filesystem::path folder = target.parent_path().empty() ? "." : target.parent_path();
    const auto [other, is_new] = named.emplace(std::filesystem::canonical(folder, ignored) / target.filename(), name);
    if (is_new) return;
    if (o.baseline && other->second == *o.baseline)
      throw Error(ExitCode::usage, fmt::format("'{}': a report would replace the baseline '{}'", name, *o.baseline));
    throw Error(ExitCode::usage, other->second == name ? fmt::format("two reports cannot have one name: '{}'", name)
                                                       : fmt::format("two reports cannot be one file: '{}' and '{}'", other->second, name));
  };
  if (o.baseline) claim(*o.baseline, followed(utf8_path(*o.baseline)));
  for (const Report& r : reports_)
    if (r.file) claim(r.name, r.file->target());
  if (std::count_if(reports_.begin(), reports_.end(), [](const Report& r) { return !r.file; }) > 1)
    throw Error(ExitCode::usage, "two reports cannot have one name: '-', standard output");
  for (const Report& r : reports_)
    if (r.file) remove_leftovers(r.file->target().parent_path());
}

bool Reports::has_standard_output() const {
  return std::any_of(reports_.begin(), reports_.end(), [](const Report& r) { return !r.file; });
}

void Reports::check(const std::vector<capture::PackPass>& passes, const std::vector<std::string>& ids) const {
  if (baseline_) baseline_->check(passes, ids);
}
void Reports::apply_baseline(judge::PortJudgement& judgement) const {
  if (baseline_) baseline_->apply(judgement);
}

void Reports::write(const judge::PortJudgement& j, const reports::PageSource& source, const reports::Times& times) {
  write({j, reports::exit_code(j, allow_untested_), source, times});
}

void Reports::write_error(const Error& error, const ValidateRequest& request) {
  judge::PortJudgement j;
  j.pack = path_text(request.pack);
  j.port = request.shadow.empty() ? path_text(request.port) : path_text(request.shadow);
  j.profile = request.profile;
  j.command = request.command;
  j.reason = error.what();
  const reports::PageSource no_source;
  const reports::Times not_measured;
  write({j, static_cast<int>(error.code()), no_source, not_measured});
}

void Reports::write(const Content& content) {
  if (annotates_) (has_standard_output() ? print_aside : print_text)(reports::report_annotations(content.judgement, allow_untested_));
  for (const Report& r : reports_) {
    const std::string text = r.text(content);
    if (!r.file) {
      print_report(text);
      continue;
    }
    r.file->write(text);
    r.file->commit();
  }
  reports_.clear();
}

}  // namespace rainref::cli
