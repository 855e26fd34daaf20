#include "cli/validate_reports.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string_view>
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
#include "reports/figures.h"
#include "reports/html.h"
#include "reports/json.h"
#include "reports/junit.h"

namespace rainref::cli {
void add_report_options(CLI::App& verb, ReportOptions& options) {
  verb.add_option("--json", options.json, "Write the whole judgement as JSON; - is standard output");
  verb.add_option("--junit", options.junit, "Write it as JUnit XML, for continuous integration; or -");
  verb.add_option("--html", options.html, "Write it as one page with pictures of what fails; or -");
  verb.add_option("--baseline", options.baseline, "Known failures (TOML): they pass, and what no longer fails is an error");
}

std::string command_text(int argc, const char* const* argv) {
  std::string out = "rainref";
  for (int i = 1; i < argc; ++i) out += " " + shell_word(argv[i]);
  return out;
}

/// Opens a report's file now; does nothing if it is not requested.
Reports::File Reports::opened(const char* option, const std::optional<std::string>& path) {
  if (!path) return {};
  if (path->empty()) throw Error(ExitCode::usage, fmt::format("{}: expected a file, found ''", option));
  if (*path == "-") return {nullptr, true};
  return {std::make_unique<AtomicFile>(utf8_path(*path)), false};
}
void Reports::finish(File& f, std::string_view text) {
  if (f.is_standard_output) {
    print_report(text);
  } else {
    f.file->write(text);
    f.file->commit();
  }
  f = {};
}

Reports::Reports(const ReportOptions& o, bool allow_untested) : allow_untested_(allow_untested) {
  if (o.baseline) {
    if (o.baseline->empty()) throw Error(ExitCode::usage, "--baseline: expected a file, found ''");
    baseline_ = reports::Baseline::read(utf8_path(*o.baseline));
  }
  json_ = opened("--json", o.json);
  junit_ = opened("--junit", o.junit);
  html_ = opened("--html", o.html);
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
  if (json_.file) claim(*o.json, json_.file->target());
  if (junit_.file) claim(*o.junit, junit_.file->target());
  if (html_.file) claim(*o.html, html_.file->target());
  if (json_.is_standard_output + junit_.is_standard_output + html_.is_standard_output > 1)
    throw Error(ExitCode::usage, "two reports cannot have one name: '-', standard output");
  for (const File* file : {&json_, &junit_, &html_}) {
    if (file->file) remove_leftovers(file->file->target().parent_path());
  }
}

void Reports::check(const std::vector<capture::PackPass>& passes, const std::vector<std::string>& ids) const {
  if (baseline_) baseline_->check(passes, ids);
}
void Reports::apply_baseline(judge::PortJudgement& judgement) const {
  if (baseline_) baseline_->apply(judgement);
}

void Reports::write(const judge::PortJudgement& j, const reports::PageSource& source) {
  const int code = reports::exit_code(j, allow_untested_);
  if (is_asked(html_)) finish(html_, reports::report_html(j, code, source));
  if (is_asked(junit_)) finish(junit_, reports::report_junit(j, allow_untested_));
  if (is_asked(json_)) finish(json_, reports::report_json(j, code, source));
}

void Reports::write_error(const Error& error, const ValidateRequest& request) {
  judge::PortJudgement j;
  j.pack = path_text(request.pack);
  j.port = request.shadow.empty() ? path_text(request.port) : path_text(request.shadow);
  j.profile = request.profile;
  j.command = request.command;
  j.reason = error.what();
  const int code = static_cast<int>(error.code());
  if (is_asked(html_)) finish(html_, reports::report_html(j, code, {}));
  if (is_asked(junit_)) finish(junit_, reports::report_junit(j, false));
  if (is_asked(json_)) finish(json_, reports::report_json(j, code, {}));
}

}  // namespace rainref::cli
