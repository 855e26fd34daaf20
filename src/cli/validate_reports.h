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

/// What the command line asks for.
struct ReportOptions {
  std::optional<std::string> json, junit, html, baseline;
};
/// --json, --junit, --html and --baseline of a verb.
void add_report_options(CLI::App& verb, ReportOptions& options);

/// A command line as a shell would read it, for reports: "rainref validate 'my pack' --port out".
std::string command_text(int argc, const char* const* argv);

/// The reports of one run. Make it before the work: it opens every file and reads the baseline, so that what cannot be
/// written or read is known at once.
class Reports {
 public:
  /// Throws Error(io) for a file that cannot be written or a baseline that cannot be read, Error(usage) for a bad
  /// baseline, an empty name, and two reports under one name.
  Reports(const ReportOptions& options, bool allow_untested);

  /// Throws Error(usage) where the baseline names a pass, an output or a case that is not there.
  void check(const std::vector<capture::PackPass>& passes, const std::vector<std::string>& ids) const;
  /// Lets the listed failures pass. Before write, and before the exit code is taken.
  void apply_baseline(judge::PortJudgement& judgement) const;
  /// Whether one of them goes to standard output, so that nothing else may.
  bool has_standard_output() const { return json_.is_standard_output || junit_.is_standard_output || html_.is_standard_output; }
  /// Writes the files, each under its name only when whole.
  void write(const judge::PortJudgement& judgement, const reports::PageSource& source);
  /// When nothing could be judged: the reports say why, so that none of an earlier run stays behind.
  void write_error(const Error& error, const ValidateRequest& request);

 private:
  /// Neither: not asked for.
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
