// `rainref validate` and `rainref mutate`.
#include <cstdio>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "cli/commands.h"
#include "cli/progress.h"
#include "conformance/report_text.h"
#include "conformance/validate.h"
#include "rainref/error.h"

namespace rainref::cli {

namespace {

int validate(const ValidateRequest& request, Reports& reports) {
  const capture::Pack pack(request.pack);
  reports.check(pack);
  const parallel::Executor executor(request.threads);
  conformance::ValidateOptions options;
  options.profile = request.profile;
  options.only = request.only;
  options.executor = &executor;
  conformance::PortJudgement judgement;
  {
    Progress progress("judging", static_cast<int>(pack.cases.size()));
    options.progress = [&](int, int) { progress.advance(); };
    judgement = conformance::validate(pack, request.port, options);
  }
  judgement.command = request.command;
  reports.apply_baseline(judgement);
  fmt::print("{}", conformance::report_text(judgement));
  reports.write(judgement, pack, request.port);
  return conformance::exit_code(judgement, request.allow_untested);
}

}  // namespace

int validate(const ValidateRequest& request) {
  Reports reports(request.reports, request.allow_untested);
  try {
    return validate(request, reports);
  } catch (const Error& e) {
    if (e.code() == ExitCode::port_files) reports.write_error(e, request);
    throw;
  }
}

int mutate(const MutateRequest& request) {
  const capture::Pack pack(request.pack);
  const parallel::Executor executor(request.threads);
  conformance::ValidateOptions options;
  options.profile = request.profile;
  options.only = request.only;
  options.executor = &executor;
  const conformance::MutationReport report = conformance::mutate(pack, options);
  fmt::print("{}", conformance::report_text(report, request.all));
  return 0;
}

}  // namespace rainref::cli
