// The options of `validate` that write reports and read a baseline.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/atomic_file.h"
#include "capture/pack_read.h"
#include "judge/verdict.h"
#include "rainref/error.h"
#include "reports/baseline.h"
#include "reports/source.h"

namespace CLI {
class App;
}

namespace rainref::cli {

struct ValidateRequest;

/// Values of the options.
struct ReportOptions {
  std::optional<std::string> json, junit, html, baseline;
};
/// Adds --json, --junit, --html and --baseline to a verb.
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
  bool has_standard_output() const { return json_.is_standard_output || junit_.is_standard_output || html_.is_standard_output; }
  /// Writes the files; each gets its name only when complete.
  void write(const judge::PortJudgement& judgement, const reports::PageSource& source);
  /// Call if nothing could be judged: the reports contain the error, so that none of an earlier run remains.
  void write_error(const Error& error, const ValidateRequest& request);

 private:
  /// Neither name nor standard output: not requested.
  struct File {
    std::unique_ptr<AtomicFile> file;
    bool is_standard_output = false;
  };
  static File opened(const char* option, const std::optional<std::string>& path);
  static void finish(File& file, std::string_view text);
  static bool is_asked(const File& file) { return file.file || file.is_standard_output; }
  File json_, junit_, html_;
  std::optional<reports::Baseline> baseline_;
  bool allow_untested_;
};

}  // namespace rainref::cli
