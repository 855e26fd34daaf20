#include "judge/validate.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "judge/check_pack.h"
#include "judge/conclude.h"
#include "judge/evaluations.h"
#include "judge/judge_pass.h"
#include "judge/port_files.h"
#include "judge/profiles.h"
#include "judge/slots.h"
#include "port_dump/dump_file.h"
#include "rainref/error.h"

namespace rainref::judge {
namespace {

using capture::Array;
using capture::Pack;
using capture::PackCase;
using capture::PackPass;
using capture::PassCase;

std::vector<Array> read_outputs(PortFiles& port, const PassCase& c) {
  std::vector<Array> out;
  for (const capture::CaseOutput& o : c.outputs) {
    out.push_back(o.judge == capture::Judge::input_only ? o.array : port.read(c.folder(), "out." + o.name, o.array));
    if (is_placed(o) && out.back().width != o.array.width)
      throw Error(ExitCode::port_files,
                  fmt::format("'{}/out.{}': expected {} records, found {}", c.folder(), o.name, o.array.width, out.back().width));
  }
  return out;
}

bool is_judged(const capture::PackOutput& output) { return output.rules.judge != capture::Judge::input_only; }
bool is_judged(const PackCase& c) {
  return std::any_of(c.outputs.begin(), c.outputs.end(), [](const auto& o) { return is_judged(o); });
}

bool stores_halves(const PackCase& c) {
  return std::any_of(c.outputs.begin(), c.outputs.end(),
                     [](const capture::PackOutput& o) { return !o.shape.is_records && info(o.shape.format).kind == FormatInfo::float16; });
}

/// What there is of a port's outputs.
struct FoundFiles {
  std::set<std::string> absent;  ///< passes without any file, where these may be
  FileFaults faults;
};

/// Whether anything like an output lies in the folder of a pass, under whatever run: a name that is wrong is no reason to
/// believe that nothing was meant.
bool has_output(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::exists(folder, error)) return false;
  for (std::filesystem::recursive_directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) {
    if (i->path().filename().string().starts_with("out")) return true;
    if (i.depth() > 0) i.disable_recursion_pending();
  }
  return static_cast<bool>(error);  // what cannot be looked into is refused later, by name
}

/// Passes whose outputs are judged and of which the port has no file.
std::set<std::string> passes_without_files(const Pack& pack, const PortFiles& port) {
  std::set<std::string> judged, found;
  for (const PackCase& c : pack.cases) {
    if (!is_judged(c)) continue;
    judged.insert(c.pass);
    if (!found.contains(c.pass) && has_output((port.folder() / c.id).parent_path())) found.insert(c.pass);
  }
  for (const std::string& pass : found) judged.erase(pass);
  return judged;
}

/// Reads every file of the port once, before anything is judged.
FoundFiles check_files(const Pack& pack, const ValidateOptions& options, PortFiles& port) {
  FoundFiles found;
  if (options.partial) found.absent = passes_without_files(pack, port);
  // Of a folder where nothing is one sentence says more than one for each file.
  const auto may_be_there = [&](const PackCase& c) { return is_judged(c) && (options.partial || options.wants(c.pass)); };
  const auto first = std::find_if(pack.cases.begin(), pack.cases.end(), may_be_there);
  std::error_code ignored;
  if (first != pack.cases.end() && std::none_of(pack.cases.begin(), pack.cases.end(), [&](const PackCase& c) {
        return may_be_there(c) && !found.absent.contains(c.pass) && std::filesystem::is_directory(port.folder() / c.id, ignored);
      }))
    throw Error(ExitCode::port_files,
                fmt::format("{}: expected folders such as {} with the port's outputs, found none", port.folder().string(), first->id));
  for (const PackCase& entry : pack.cases) {
    if (!options.wants(entry.pass) || found.absent.contains(entry.pass)) continue;
    for (const capture::PackOutput& output : entry.outputs) {
      if (!is_judged(output)) continue;
      capture::Array shape = output.shape;
      shape.levels.resize(output.levels.size());
      const std::string stem = "out." + output.name;
      found.faults.attempt(entry.pass, entry.id, stem, [&] {
        require_apart(pack.folder() / output.levels.front().path, port_dump::find_dump_file(port.folder() / entry.id, stem).path,
                      ExitCode::port_files);
        port.read(entry.id, stem, shape);
      });
    }
  }
  found.faults.require_files();
  return found;
}

PassJudgement without_files(const PackPass& pass) {
  PassJudgement out;
  out.pass = pass.name;
  out.formula = pass.formula;
  out.status = Status::not_judged;
  out.reason = "the port has no files of this pass";
  return out;
}

}  // namespace

void describe_port(const port_dump::PortInfo& info, PortJudgement& j) {
  j.api = info.api;
  j.device = info.device;
  j.driver = info.driver;
}

std::optional<HalfMode> declared_mode(const port_dump::PortInfo& port) {
  if (!port.half_store) return std::nullopt;
  return *port.half_store == Rounding::rne ? HalfMode::rne : HalfMode::rtz;
}

PortJudgement validate(const Pack& pack, const std::filesystem::path& folder, const ValidateOptions& options) {
  const enclosed::Profile& chosen = profile(options.profile);
  for (const std::string& pass : options.only) static_cast<void>(pack.pass(pass));
  if (!pack.with_inputs)
    throw Error(ExitCode::usage, fmt::format("{}: a capture without inputs cannot judge a port; make a pack", pack.folder().string()));
  check_pack(pack);
  require_apart(pack.folder(), folder, ExitCode::usage);
  PortFiles port(folder, pack.effect, pack.variant);
  const FoundFiles found = check_files(pack, options, port);

  PortJudgement result;
  result.pack = pack.folder().string();
  result.port = folder.string();
  result.profile = options.profile;
  result.effect = pack.effect;
  result.variant = pack.variant;
  result.scene = pack.scene;
  describe_port(port.info(), result);

  const JudgeOptions how{&chosen, chosen.reference ? nullptr : &profile("typical"), options.executor, declared_mode(port.info())};
  int done = 0;
  const auto wanted = static_cast<int>(std::count_if(
      pack.cases.begin(), pack.cases.end(), [&](const PackCase& c) { return options.wants(c.pass) && !found.absent.contains(c.pass); }));
  std::vector<PassTask> tasks, voters;
  FileFaults unread;
  PortFiles other_files(folder, pack.effect, pack.variant);  // what is said of a voter's files is said when it is judged
  for (const PackPass& pass : pack.passes) {
    const bool is_wanted = options.wants(pass.name);
    if (is_wanted && found.absent.contains(pass.name)) continue;
    std::vector<const PackCase*> cases;
    for (const PackCase& entry : pack.cases)
      if (entry.pass == pass.name) cases.push_back(&entry);
    if (!is_wanted && (cases.empty() || !stores_halves(*cases.front()))) continue;
    PassRuns runs;
    runs.count = cases.size();
    runs.load = [&, cases, is_wanted](std::size_t k) {
      PortRun run;
      run.c = read_case(pack, *cases[k]);
      const std::string id = cases[k]->id;
      if (!is_wanted) unread.attempt(run.c.pass, id, "its outputs", [&] { run.stored = read_outputs(other_files, run.c); });
      if (const std::string unusable = unusable_text(is_wanted ? found.faults.all() : unread.all(), id); !unusable.empty()) {
        run.has_no_files = true;
        run.untested = fmt::format("{}: missing, or cannot be used", unusable);
      } else if (is_wanted) {
        run.stored = read_outputs(port, run.c);
      }
      return run;
    };
    runs.settle = [&](PortRun& run, const capture::PassModel* model) {
      if (model) require_reference(pack, run.c, *model, *options.executor);
    };
    if (is_wanted) {
      runs.explain = options.explain;
      runs.tries_null_ports = runs.counts_coverage = true;
      runs.done_one = [&] {
        if (options.progress) options.progress(++done, wanted);
      };
    }
    (is_wanted ? tasks : voters).push_back({&pass, binder(pack.effect, pass.name), std::move(runs)});
  }
  std::vector<PassJudgement> judged = judge_passes(tasks, how, voters);
  auto next = judged.begin();
  for (const PackPass& pass : pack.passes)
    if (options.wants(pass.name)) result.passes.push_back(found.absent.contains(pass.name) ? without_files(pass) : std::move(*next++));
  result.files = found.faults.all();
  result.notes = port.notes();
  conclude(result);
  return result;
}

}  // namespace rainref::judge
