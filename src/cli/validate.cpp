// `rainref validate` and `rainref mutate`.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/path_text.h"
#include "capture/capture_recorder.h"
#include "capture/manifest_write.h"
#include "cli/commands.h"
#include "cli/judging_times.h"
#include "cli/port_command.h"
#include "cli/progress.h"
#include "registry/registry.h"
#include "cli/scene_file.h"
#include "cli/terminal.h"
#include "faults/mutate.h"
#include "judge/port_files.h"
#include "judge/profiles.h"
#include "judge/shadow_plan.h"
#include "judging/judge_folder.h"
#include "rainref/error.h"
#include "reports/text.h"

namespace rainref::cli {

namespace {

namespace fs = std::filesystem;

/// Creates the output folder of a port's command: `wanted`, which must be new or empty.
void make_empty(const fs::path& wanted) {
  std::error_code error;
  fs::create_directories(wanted, error);
  if (error || !fs::is_directory(wanted, error)) {
    throw Error(ExitCode::io, fmt::format("--port {}: cannot make this folder: {}", path_text(wanted),
                                          error ? error.message() : "a file of that name exists"));
  }
  if (!fs::is_empty(wanted, error)) {
    throw Error(
        ExitCode::usage,
        fmt::format("--port {}: expected a new or empty folder for --exec to write to, found one with files: they could be an older run's",
                    path_text(wanted)));
  }
}

judging::FolderOptions folder_options(const ValidateRequest& request, const parallel::Executor& executor) {
  judging::FolderOptions options;
  options.profile = request.profile;
  options.only = request.only;
  options.partial = request.partial;
  options.fused = request.fused;
  options.foreign_host = request.foreign_host;
  options.executor = &executor;
  options.strict = request.strict;
  if (request.exhaustive) options.sample = 0;
  options.seeks_causes = !request.no_causes;
  options.causes_within = request.causes_within;
  options.spirv = request.spirv;
  return options;
}
/// Shows on the terminal that a diagnosis, which may take minutes, is running, and measures how long all takes.
void show(Progress& progress, JudgingTimes& times, judging::FolderOptions& options) {
  times = JudgingTimes();
  options.progress = [&](int, int) {
    progress.advance();
    times.end_case();
  };
  options.at_cause = [&](const std::string& pass) {
    progress.meanwhile("seeking the cause in " + pass);
    times.begin_causes(pass);
  };
}

/// Results of the port's command.
struct PortRuns {
  std::vector<fs::path> folders;  ///< one for each run; none if a run failed
  std::string failure = "";
  std::vector<std::string> printed{};  ///< output of the run that failed
  std::string last_line = "";          ///< of the last run's output
};
PortRuns run_port(const ValidateRequest& request, const fs::path& folder) {
  PortRuns runs;
  Progress progress("running the port", request.repeat);
  for (int k = 1; k <= request.repeat; ++k) {
    const fs::path out = request.repeat == 1 ? folder : folder / utf8_path(fmt::format("run.{}", k));
    make_empty(out);
    const PortFolders folders(request.pack, out);
    const CommandEnd end =
        run_command(folders.filled_in(request.exec), std::chrono::duration<double>(request.timeout_s), folders.environment());
    if (!end.failure.empty()) return {{}, request.repeat == 1 ? end.failure : fmt::format("run {}: {}", k, end.failure), end.last_lines};
    folders.check();
    runs.last_line = end.last_lines.empty() ? "" : end.last_lines.back();
    runs.folders.push_back(out);
    progress.advance();
  }
  return runs;
}

/// `temporary`: the output folder if the request names none; it must exist until the page is written.
judging::Judged judge_pack(const ValidateRequest& request, const Reports& reports, std::optional<TemporaryRun>& temporary,
                           const parallel::Executor& executor, JudgingTimes& times) {
  const auto pack = std::make_shared<const capture::Pack>(request.pack);
  judging::FolderOptions options = folder_options(request, executor);
  // Errors in the request are reported before the port is run.
  judging::check_request(*pack, options);
  std::vector<std::string> ids;
  for (const capture::PackCase& c : pack->cases) ids.push_back(c.id);
  reports.check(pack->passes, ids);

  PortRuns runs{{request.port}};
  if (!request.exec.empty()) {
    if (request.port.empty()) temporary.emplace();
    runs = run_port(request, temporary ? temporary->path() : request.port);
  }
  judging::Judged judged;
  judge::PortJudgement& judgement = judged.judged;
  if (runs.folders.empty()) {
    judgement = judge::unjudged(*pack, request.profile);
    judgement.status = judge::Status::fail;
    judgement.reason = runs.failure;
    for (const std::string& line : runs.printed) judgement.notes.push_back("the port printed: " + line);
  } else {
    try {
      Progress progress("judging", static_cast<int>(std::count_if(pack->cases.begin(), pack->cases.end(),
                                                                  [&](const capture::PackCase& c) { return options.wants(c.pass); })));
      show(progress, times, options);
      judged = judging::judge_folder(pack, runs.folders, options);
    } catch (const Error& e) {
      // A port that exits with 0 and writes nothing may have printed the reason.
      if (e.code() != ExitCode::port_files || runs.last_line.empty()) throw;
      throw Error(e.code(), fmt::format("{}; the port's command ended with exit code 0 and printed last: {}", e.what(), runs.last_line));
    }
  }
  judgement.port = temporary ? "the outputs of --exec" : path_text(request.port);
  if (!judgement.files.empty() && !runs.last_line.empty())
    judgement.notes.push_back("the port's command ended with exit code 0 and printed last: " + runs.last_line);
  return judged;
}

/// The plan of a dump: from the scene for the dumped frames, or from the manifest beside them.
judge::ShadowPlan shadow_plan(const ValidateRequest& request, const parallel::Executor& executor) {
  const bool has_manifest = fs::exists(request.shadow / capture::manifest_name);
  const auto manifest = [&] {
    const capture::Pack pack(request.shadow);
    if (!pack.with_inputs)
      throw Error(ExitCode::usage, fmt::format("{}: its manifest is of a capture without inputs, which nothing can be recomputed from",
                                               path_text(request.shadow)));
    // A capture of rainref shares equal files. A port that writes its own dumps writes all of them.
    return judge::ShadowPlan::of_manifest(pack, pack.file_beside("port.json").empty());
  };
  if (request.scene.scene.empty()) {
    if (!has_manifest)
      throw Error(ExitCode::usage,
                  fmt::format("--shadow {}: expected a manifest.json there, or the scene that the port ran", path_text(request.shadow)));
    return manifest();
  }
  const scene::Config config = load_scene(request.scene);
  const capture::EffectInfo& info = *registry::find(config.effect())->info;
  judge::ShadowPlan plan = judge::ShadowPlan::of_effect(info, config.variant(), path_text(request.scene.scene.filename()));
  std::set<int> frames;
  for (const judge::DumpedRun& run : judge::dumped_runs(request.shadow, plan.effect, info.pass_names(config.variant())))
    frames.insert(run.frame);
  simulation::Opened opened = open_scene(config, executor);
  capture::CaptureRecorder recorder(
      info, config.variant(), true, [&](int frame, std::string_view) { return frames.contains(frame); },
      [&](const capture::PassCase& c) { plan.add(c, info); });
  const int last = frames.empty() ? -1 : *frames.rbegin();
  // A large frame number in a folder's name must not start a simulation of days.
  constexpr std::int64_t unasked = 3600;
  if (const std::int64_t most = std::max(config.integer("run.frames"), unasked); last >= most) {
    throw Error(ExitCode::port_files,
                fmt::format("{}: expected frames below {}, found {}; where the port ran longer, --set run.frames says so",
                            path_text(request.shadow), most, last));
  }
  Progress progress(config.effect(), last + 1);
  for (int frame = 0; frame <= last; ++frame) {
    opened.next_frame(&recorder);
    progress.advance();
  }
  if (has_manifest) plan.take_files(manifest());
  return plan;
}

judging::Judged judge_shadow(const ValidateRequest& request, const Reports& reports, const parallel::Executor& executor,
                             JudgingTimes& times) {
  static_cast<void>(judge::judging_profile(request.profile));
  if (!fs::is_directory(request.shadow))
    throw Error(ExitCode::port_files,
                fmt::format("--shadow {}: expected a folder with the port's dumps, found none", path_text(request.shadow)));
  const auto planned = std::make_shared<const judge::ShadowPlan>(shadow_plan(request, executor));
  const judge::ShadowPlan& plan = *planned;
  std::vector<std::string> passes;
  for (const capture::PackPass& pass : plan.passes) passes.push_back(pass.name);
  for (const std::string& pass : request.only) {
    if (std::find(passes.begin(), passes.end(), pass) != passes.end()) continue;
    throw Error(ExitCode::usage, fmt::format("--only: expected one of the passes {}, found '{}'{}", fmt::join(passes, ", "), pass,
                                             did_you_mean(pass, passes)));
  }
  const std::vector<judge::DumpedRun> dumped = judge::dumped_runs(request.shadow, plan.effect, passes);
  if (dumped.empty()) {
    throw Error(ExitCode::port_files, fmt::format("{}: expected folders such as {}.{}/0000.0, found none", path_text(request.shadow),
                                                  plan.effect, passes.front()));
  }
  std::vector<std::string> ids;
  for (const judge::DumpedRun& run : dumped) ids.push_back(run.id);
  reports.check(plan.passes, ids);
  judging::FolderOptions options = folder_options(request, executor);
  Progress progress("judging", static_cast<int>(dumped.size()));
  show(progress, times, options);
  return judging::judge_dumps(planned, request.shadow, dumped, options);
}

/// Judges, prints and writes the reports. Returns the judgement, whose files may still be an error.
judge::PortJudgement validate(const ValidateRequest& request, Reports& reports) {
  const parallel::Executor executor(request.threads);
  std::optional<TemporaryRun> temporary;
  JudgingTimes times;
  judging::Judged judged =
      request.shadow.empty() ? judge_pack(request, reports, temporary, executor, times) : judge_shadow(request, reports, executor, times);
  times.end();
  judge::PortJudgement& judgement = judged.judged;
  judgement.command = request.command;
  if (request.no_causes) judgement.notes.push_back("causes of failures were not looked for (--no-causes)");
  reports.apply_baseline(judgement);
  const std::string text = reports::report_text(judgement, request.verbose);
  if (reports.has_standard_output())
    print_aside(text);
  else
    print_text(text);
  reports.write(judgement, judged.source, times.of(judgement));
  return std::move(judgement);
}

}  // namespace

int validate(const ValidateRequest& request) {
  Reports reports(request.reports, request.allow_untested);
  judge::PortJudgement judgement;
  try {
    judgement = validate(request, reports);
  } catch (const Error& e) {
    if (e.code() == ExitCode::port_files) reports.write_error(e, request);
    throw;
  }
  if (!judgement.files.empty()) throw judge::files_error(judgement.files);
  return reports::exit_code(judgement, request.allow_untested);
}

int mutate(const MutateRequest& request) {
  const capture::Pack pack(request.pack);
  static_cast<void>(judge::judging_profile(request.profile));
  const parallel::Executor executor(request.threads);
  judge::ValidateOptions options;
  options.profile = request.profile;
  options.only = request.only;
  options.executor = &executor;
  Progress progress("trying porting bugs", static_cast<int>(pack.cases.size()));
  options.progress = [&](int, int) { progress.advance(); };
  const faults::MutationReport report = faults::mutate(pack, options);
  print_text(reports::report_text(report, request.all));
  return 0;
}

}  // namespace rainref::cli
