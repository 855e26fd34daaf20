// `rainref validate` and `rainref mutate`.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "capture/capture_recorder.h"
#include "capture/manifest_write.h"
#include "cli/commands.h"
#include "cli/port_command.h"
#include "cli/progress.h"
#include "registry/registry.h"
#include "cli/scene_file.h"
#include "cli/terminal.h"
#include "faults/diagnose.h"
#include "faults/mutate.h"
#include "judge/conclude.h"
#include "judge/port_files.h"
#include "judge/profiles.h"
#include "judge/races.h"
#include "judge/shadow.h"
#include "judge/validate.h"
#include "rainref/error.h"
#include "reports/text.h"

namespace rainref::cli {

namespace {

namespace fs = std::filesystem;

/// A folder for a port's command to write to: `wanted`, which must be new or empty.
void make_empty(const fs::path& wanted) {
  std::error_code error;
  fs::create_directories(wanted, error);
  if (error || !fs::is_directory(wanted, error)) {
    throw Error(ExitCode::io, fmt::format("--port {}: cannot make this folder: {}", wanted.string(),
                                          error ? error.message() : "a file of that name exists"));
  }
  if (!fs::is_empty(wanted, error)) {
    throw Error(
        ExitCode::usage,
        fmt::format("--port {}: expected a new or empty folder for --exec to write to, found one with files: they could be an older run's",
                    wanted.string()));
  }
}

/// The diagnosis, which may take minutes; the terminal says so.
judge::Explain seeking(Progress& progress) {
  return [&](const judge::FailedRun& failed) {
    progress.meanwhile("seeking the cause in " + failed.pass.name);
    return faults::diagnose(failed);
  };
}

/// Runs the port's command and gives the folders of its runs; a failure goes into the judgement. `last_line` is what the
/// last run printed last.
std::vector<fs::path> run_port(const ValidateRequest& request, const fs::path& folder, judge::PortJudgement& judgement,
                               std::string& last_line) {
  std::vector<fs::path> runs;
  Progress progress("running the port", request.repeat);
  for (int k = 1; k <= request.repeat; ++k) {
    const fs::path out = request.repeat == 1 ? folder : folder / fmt::format("run.{}", k);
    make_empty(out);
    const PortFolders folders(request.pack, out);
    const CommandEnd end =
        run_command(folders.filled_in(request.exec), std::chrono::duration<double>(request.timeout_s), folders.environment());
    if (!end.failure.empty()) {
      judgement.status = judge::Status::fail;
      judgement.reason = request.repeat == 1 ? end.failure : fmt::format("run {}: {}", k, end.failure);
      for (const std::string& line : end.last_lines) judgement.notes.push_back("the port printed: " + line);
      return {};
    }
    folders.check();
    last_line = end.last_lines.empty() ? "" : end.last_lines.back();
    runs.push_back(out);
    progress.advance();
  }
  return runs;
}

/// A judgement, and what a page shows of it. The folders and the executor that it reads from live as long.
struct Judged {
  judge::PortJudgement judgement;
  reports::PageSource source;
};

Judged judge_pack(const ValidateRequest& request, const Reports& reports, const parallel::Executor& executor) {
  const auto opened = std::make_shared<const capture::Pack>(request.pack);
  const capture::Pack& pack = *opened;
  judge::ValidateOptions options;
  options.profile = request.profile;
  options.only = request.only;
  options.partial = request.partial;
  // What is wrong with the request shows before the port is run.
  static_cast<void>(judge::judging_profile(options.profile));
  for (const std::string& pass : options.only) static_cast<void>(pack.pass(pass));
  std::vector<std::string> ids;
  for (const capture::PackCase& c : pack.cases) ids.push_back(c.id);
  reports.check(pack.passes, ids);

  judge::PortJudgement judgement;
  judgement.pack = request.pack.string();
  judgement.profile = request.profile;
  judgement.effect = pack.effect;
  judgement.variant = pack.variant;
  judgement.scene = pack.scene;
  std::shared_ptr<TemporaryRun> temporary;
  std::string last_line;
  std::vector<fs::path> runs{request.port};
  if (!request.exec.empty()) {
    if (request.port.empty()) temporary = std::make_shared<TemporaryRun>();
    const fs::path folder = temporary ? temporary->path() : request.port;
    judgement.port = request.port.empty() ? "the outputs of --exec" : request.port.string();
    runs = run_port(request, folder, judgement, last_line);
    if (runs.empty()) return {judgement, {}};
  }
  options.executor = &executor;
  try {
    Progress progress("judging", static_cast<int>(std::count_if(pack.cases.begin(), pack.cases.end(),
                                                                [&](const capture::PackCase& c) { return options.wants(c.pass); })));
    options.progress = [&](int, int) { progress.advance(); };
    if (!request.no_causes) options.explain = seeking(progress);
    const std::string shown = judgement.port;
    judgement = judge::validate(pack, runs.front(), options);
    if (!shown.empty()) judgement.port = shown;
    if (runs.size() > 1) {
      std::vector<std::string> judged;
      for (const judge::PassJudgement& pass : judgement.passes)
        if (!pass.cases.empty()) judged.push_back(pass.pass);
      const judge::Races races = judge::find_races(pack, runs, judged);
      judge::add_races(races.found, judgement);
      judgement.files.insert(judgement.files.end(), races.files.begin(), races.files.end());
      judgement.notes.push_back(fmt::format("the port ran {} times; the first run was judged", runs.size()));
    }
  } catch (const Error& e) {
    // A port that exits with 0 and has written nothing may have said why.
    if (e.code() != ExitCode::port_files || last_line.empty()) throw;
    throw Error(e.code(), fmt::format("{}; the port's command ended with exit code 0 and printed last: {}", e.what(), last_line));
  }
  if (!judgement.files.empty() && !last_line.empty())
    judgement.notes.push_back("the port's command ended with exit code 0 and printed last: " + last_line);
  reports::PageSource source = reports::page_source(opened, runs.front());
  source.read = [temporary, read = source.read](const std::string& id, const std::string& output) { return read(id, output); };
  return {std::move(judgement), std::move(source)};
}

/// The plan of a dump: what the scene does in the frames that are there, or what the manifest beside them says.
judge::ShadowPlan shadow_plan(const ValidateRequest& request, const parallel::Executor& executor) {
  const bool has_manifest = fs::exists(request.shadow / capture::manifest_name);
  const auto manifest = [&] {
    const capture::Pack pack(request.shadow);
    if (!pack.with_inputs)
      throw Error(ExitCode::usage, fmt::format("{}: its manifest is of a capture without inputs, which nothing can be recomputed from",
                                               request.shadow.string()));
    // A capture of rainref shares equal files. A port that dumped files of its own has dumped all of them.
    return judge::ShadowPlan::of_manifest(pack, pack.file_beside("port.json").empty());
  };
  if (request.scene.scene.empty()) {
    if (!has_manifest)
      throw Error(ExitCode::usage,
                  fmt::format("--shadow {}: expected a manifest.json there, or the scene that the port ran", request.shadow.string()));
    return manifest();
  }
  const scene::Config config = load_scene(request.scene);
  const capture::EffectInfo& info = *registry::find(config.effect())->info;
  judge::ShadowPlan plan = judge::ShadowPlan::of_effect(info, config.variant(), request.scene.scene.filename().string());
  std::set<int> frames;
  for (const judge::DumpedRun& run : judge::dumped_runs(request.shadow, plan.effect, info.pass_names(config.variant())))
    frames.insert(run.frame);
  simulation::Opened opened = open_scene(config, executor);
  capture::CaptureRecorder recorder(
      info, config.variant(), true, [&](int frame, std::string_view) { return frames.contains(frame); },
      [&](const capture::PassCase& c) { plan.add(c, info); });
  const int last = frames.empty() ? -1 : *frames.rbegin();
  // A folder's name must not have a simulation run for days.
  constexpr std::int64_t unasked = 3600;
  if (const std::int64_t most = std::max(config.integer("run.frames"), unasked); last >= most) {
    throw Error(ExitCode::port_files,
                fmt::format("{}: expected frames below {}, found {}; where the port ran longer, --set run.frames says so",
                            request.shadow.string(), most, last));
  }
  Progress progress(config.effect(), last + 1);
  for (int frame = 0; frame <= last; ++frame) {
    opened.next_frame(&recorder);
    progress.advance();
  }
  if (has_manifest) plan.take_files(manifest());
  return plan;
}

Judged judge_shadow(const ValidateRequest& request, const Reports& reports, const parallel::Executor& executor) {
  static_cast<void>(judge::judging_profile(request.profile));
  if (!fs::is_directory(request.shadow))
    throw Error(ExitCode::port_files,
                fmt::format("--shadow {}: expected a folder with the port's dumps, found none", request.shadow.string()));
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
    throw Error(ExitCode::port_files,
                fmt::format("{}: expected folders such as {}.{}/0000.0, found none", request.shadow.string(), plan.effect, passes.front()));
  }
  std::vector<std::string> ids;
  for (const judge::DumpedRun& run : dumped) ids.push_back(run.id);
  reports.check(plan.passes, ids);
  judge::ValidateOptions options;
  options.profile = request.profile;
  options.only = request.only;
  options.foreign_host = request.foreign_host;
  options.executor = &executor;
  Progress progress("judging", static_cast<int>(dumped.size()));
  options.progress = [&](int, int) { progress.advance(); };
  if (!request.no_causes) options.explain = seeking(progress);
  judge::PortJudgement judgement = judge::shadow(plan, request.shadow, dumped, options);
  options.progress = nullptr;
  options.explain = nullptr;
  return {std::move(judgement), reports::page_source(planned, request.shadow, dumped, options)};
}

/// Judges, prints and writes the reports; the judgement, whose files may still be an error.
judge::PortJudgement validate(const ValidateRequest& request, Reports& reports) {
  const parallel::Executor executor(request.threads);
  Judged judged = request.shadow.empty() ? judge_pack(request, reports, executor) : judge_shadow(request, reports, executor);
  judged.judgement.command = request.command;
  if (request.no_causes) judged.judgement.notes.push_back("causes of failures were not looked for (--no-causes)");
  if (request.strict) judge::fail_warnings(judged.judgement);
  reports.apply_baseline(judged.judgement);
  const std::string text = reports::report_text(judged.judgement, request.verbose);
  if (reports.has_standard_output())
    print_aside(text);
  else
    print_text(text);
  reports.write(judged.judgement, judged.source);
  return std::move(judged.judgement);
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
