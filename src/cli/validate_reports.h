// The options of `validate` that write reports and read a baseline.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "capture/pack_read.h"
#include "judge/verdict.h"
#include "rainref/error.h"
#include "reports/baseline.h"
#include "reports/junit.h"
#include "reports/source.h"

namespace CLI {
class App;
}

namespace rainref::cli {

struct ValidateRequest;

/// Values of the options.
struct ReportOptions {
  std::optional<std::string> json, junit, html, markdown, baseline;
  bool annotates = false;  ///< prints annotations of GitHub's actions after the text
};
/// Adds --json, --junit, --html, --markdown, --github and --baseline to a verb.
void add_report_options(CLI::App& verb, ReportOptions& options);

/// Quotes a command line for a shell, for reports: "rainref validate 'my pack' --port out".
std::string command_text(int argc, const char* const* argv);

/// The reports of one run. Construct it before the work: it opens every file and reads the baseline, so that errors appear at once.
class Reports {
 public:
  /// Throws Error(io) for a file that cannot be written or a baseline that cannot be read, Error(usage) for an invalid baseline, an empty
  /// name, or two reports with one name.
  Reports(const ReportOptions& options, bool allow_untested);

  /// Throws Error(usage) if the baseline names a pass, output or case that does not exist.
  void check(const std::vector<capture::PackPass>& passes, const std::vector<std::string>& ids) const;
  /// Permits the failures in the baseline. Call before write, and before computing the exit code.
  void apply_baseline(judge::PortJudgement& judgement) const;
  /// True if a report goes to standard output, so that nothing else may.
  bool has_standard_output() const;
  /// Prints the annotations and writes the files; each gets its name only when complete.
  void write(const judge::PortJudgement& judgement, const reports::PageSource& source, const reports::Times& times);
  /// Call if nothing could be judged: the reports contain the error, so that none of an earlier run remains.
  void write_error(const Error& error, const ValidateRequest& request);

 private:
  struct Content {
    const judge::PortJudgement& judgement;
    int exit_code;
    const reports::PageSource& source;
    const reports::Times& times;
  };
  /// A report that was asked for.
  struct Report {
    std::string name;                  ///< as given
    std::unique_ptr<AtomicFile> file;  ///< null: standard output
    std::function<std::string(const Content&)> text;
  };
  void write(const Content& content);

  std::vector<Report> reports_;
  std::optional<reports::Baseline> baseline_;
  bool allow_untested_, annotates_;
};

}  // namespace rainref::cli
