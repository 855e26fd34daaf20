#include "judge/validate.h"

#include <algorithm>

#include <fmt/format.h>

#include "judge/check_pack.h"
#include "judge/conclude.h"
#include "judge/evaluations.h"
#include "judge/judge_pass.h"
#include "judge/keyed.h"
#include "judge/port_files.h"
#include "judge/profiles.h"
#include "judge/reference_outputs.h"
#include "port_dump/dump_file.h"
#include "rainref/error.h"

namespace rainref::judge {
namespace {

using capture::Array;
using capture::Pack;
using capture::PackCase;
using capture::PackPass;
using capture::PassCase;

/// The pack's expected outputs are the reference's: else the pack is of another version, or damaged in a way that its
/// hashes do not show.
void require_reference(const Pack& pack, const PassCase& c, const capture::PassModel& model, const parallel::Executor& executor) {
  const std::vector<Array> reference = reference_outputs(c, model, executor);
  for (std::size_t o = 0; o < reference.size(); ++o) {
    const Array& expected = c.outputs[o].array;
    if (reference[o].levels == expected.levels) continue;
    if (c.outputs[o].judge == capture::Judge::keyed && same_records(reference[o], expected)) continue;
    throw Error(
        ExitCode::port_files,
        fmt::format(
            "{}: {}/out.{}: expected what this version computes, found other values: the pack was made by rainref {}; make it again",
            pack.folder().string(), c.folder(), c.outputs[o].name, pack.producer));
  }
}

std::vector<Array> read_outputs(PortFiles& port, const PassCase& c) {
  std::vector<Array> out;
  for (const capture::CaseOutput& o : c.outputs)
    out.push_back(o.judge == capture::Judge::input_only ? o.array : port.read(c.folder(), "out." + o.name, o.array));
  return out;
}

/// Reads every file of the port once: whatever is wrong with them is one error, before anything is judged.
void check_files(const Pack& pack, const std::string& only, PortFiles& port) {
  FileErrors errors;
  const auto is_wanted = [&](const PackCase& c) {
    return (only.empty() || c.pass == only) &&
           std::any_of(c.outputs.begin(), c.outputs.end(), [](const auto& o) { return o.rules.judge != capture::Judge::input_only; });
  };
  // Of a folder where nothing is one sentence says more than one for each file.
  const auto first = std::find_if(pack.cases.begin(), pack.cases.end(), is_wanted);
  std::error_code ignored;
  if (first != pack.cases.end() && std::none_of(pack.cases.begin(), pack.cases.end(), [&](const PackCase& c) {
        return is_wanted(c) && std::filesystem::is_directory(port.folder() / c.id, ignored);
      }))
    throw Error(ExitCode::port_files,
                fmt::format("{}: expected folders such as {} with the port's outputs, found none", port.folder().string(), first->id));
  for (const PackCase& entry : pack.cases) {
    if (!only.empty() && entry.pass != only) continue;
    for (const capture::PackOutput& output : entry.outputs) {
      if (output.rules.judge == capture::Judge::input_only) continue;
      capture::Array shape = output.shape;
      shape.levels.resize(output.levels.size());
      errors.attempt([&] {
        require_apart(pack.folder() / output.levels.front().path,
                      port_dump::find_dump_file(port.folder() / entry.id, "out." + output.name).path);
        port.read(entry.id, "out." + output.name, shape);
      });
    }
  }
  errors.raise();
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
  if (!options.only.empty()) static_cast<void>(pack.pass(options.only));
  if (!pack.with_inputs)
    throw Error(ExitCode::usage, fmt::format("{}: a capture without inputs cannot judge a port; make a pack", pack.folder().string()));
  check_pack(pack);
  require_apart(pack.folder(), folder);
  PortFiles port(folder);
  check_files(pack, options.only, port);

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
  std::vector<PassTask> tasks;
  for (const PackPass& pass : pack.passes) {
    if (!options.only.empty() && pass.name != options.only) continue;
    std::vector<const PackCase*> cases;
    for (const PackCase& entry : pack.cases)
      if (entry.pass == pass.name) cases.push_back(&entry);
    PassRuns runs;
    runs.count = cases.size();
    runs.explain = options.explain;
    runs.tries_null_ports = true;
    runs.load = [&, cases](std::size_t k) {
      PortRun run;
      run.c = read_case(pack, *cases[k]);
      run.stored = read_outputs(port, run.c);
      return run;
    };
    runs.settle = [&](PortRun& run, const capture::PassModel* model) {
      if (model) require_reference(pack, run.c, *model, *options.executor);
    };
    runs.done_one = [&] {
      if (options.progress) options.progress(++done, static_cast<int>(pack.cases.size()));
    };
    tasks.push_back({&pass, binder(pack.effect, pass.name), std::move(runs)});
  }
  result.passes = judge_passes(tasks, how);
  result.notes = port.notes();
  conclude(result);
  return result;
}

}  // namespace rainref::judge
