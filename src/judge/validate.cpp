#include "judge/validate.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/path_text.h"
#include "judge/check_pack.h"
#include "judge/conclude.h"
#include "judge/evaluations.h"
#include "judge/fused.h"
#include "judge/judge_pass.h"
#include "judge/port_files.h"
#include "judge/profiles.h"
#include "port_dump/apis.h"
#include "port_dump/dump_file.h"
#include "rainref/error.h"

namespace rainref::judge {
namespace {

using capture::Pack;
using capture::PackCase;
using capture::PackPass;

bool is_judged(const capture::PackOutput& output) { return output.rules.judge != capture::Judge::input_only; }
bool is_judged(const PackCase& c) {
  return std::any_of(c.outputs.begin(), c.outputs.end(), [](const auto& o) { return is_judged(o); });
}

bool stores_halves(const PackCase& c) {
  return std::any_of(c.outputs.begin(), c.outputs.end(),
                     [](const capture::PackOutput& o) { return !o.shape.is_records && info(o.shape.format).kind == FormatInfo::float16; });
}

/// Passes whose outputs are judged and that have no file of the port.
std::set<std::string> passes_without_files(const Pack& pack, const PortFiles& port) {
  std::set<std::string> judged, found;
  for (const PackCase& c : pack.cases) {
    if (!is_judged(c)) continue;
    judged.insert(c.pass);
    if (!found.contains(c.pass) && port.has_output(c.id)) found.insert(c.pass);
  }
  for (const std::string& pass : found) judged.erase(pass);
  return judged;
}

/// For an empty folder, one error instead of one for each file. `absent`: passes that may lack files.
void require_any_folder(const Pack& pack, const ValidateOptions& options, const std::set<std::string>& absent, const PortFiles& port) {
  const auto may_be_there = [&](const PackCase& c) { return is_judged(c) && (options.partial || options.wants(c.pass)); };
  const auto first = std::find_if(pack.cases.begin(), pack.cases.end(), may_be_there);
  std::error_code ignored;
  if (first != pack.cases.end() && std::none_of(pack.cases.begin(), pack.cases.end(), [&](const PackCase& c) {
        return may_be_there(c) && !absent.contains(c.pass) && std::filesystem::is_directory(port.folder() / utf8_path(c.id), ignored);
      }))
    throw Error(ExitCode::port_files,
                fmt::format("{}: expected folders such as {} with the port's outputs, found none", path_text(port.folder()), first->id));
}

/// Reads a case with the port's outputs, and collects errors of its files.
PortRun read_run(const Pack& pack, const PackCase& entry, const FusedInputs& fused, PortFiles& port, FileFaults& faults) {
  PortRun run;
  run.c = read_case(pack, entry);
  for (std::size_t o = 0; o < entry.outputs.size(); ++o) {
    const capture::CaseOutput& output = run.c.outputs[o];
    if (!is_judged(entry.outputs[o])) {
      run.stored.push_back(output.array);
      run.kept.push_back(nullptr);
      continue;
    }
    const std::string stem = "out." + output.name;
    faults.attempt(entry.pass, entry.id, stem, [&] {
      for (const std::string& file : port_dump::stems_of(stem, port.info()))
        require_apart(pack.folder() / utf8_path(entry.outputs[o].levels.front().path),
                      port_dump::find_dump_file(port.folder() / utf8_path(entry.id), file).path, ExitCode::port_files);
      port_dump::KeptForm kept;
      capture::Array own = port.read(utf8_path(entry.id), stem, output.array, &kept);
      if (output.judge == capture::Judge::bits && kept && kept->widest > 0)
        throw Error(ExitCode::port_files,
                    fmt::format("'{}': encodings.{}: expected an exact form, as its bits are judged, found one that rounds",
                                path_text(port.folder() / "port.json"), output.name));
      run.stored.push_back(std::move(own));
      run.kept.push_back(std::move(kept));
    });
  }
  faults.require_files();
  if (const std::string unusable = unusable_text(faults.all(), entry.id); !unusable.empty()) {
    run.has_no_files = true;
    run.untested = fmt::format("{}: missing, or cannot be used", unusable);
  } else {
    fused.replace(entry, run.c, port);
  }
  return run;
}

/// `last`: the pass in whose shader the port computes it, or "".
PassJudgement without_files(const PackPass& pass, const std::string& last) {
  PassJudgement out;
  out.pass = pass.name;
  out.formula = pass.formula;
  out.status = Status::not_judged;
  out.reason = last.empty() ? "the port has no files of this pass" : fmt::format("the port computes it in the shader of {}", last);
  return out;
}

/// Says what a pass was judged from, if the port computes `from` in the same shader.
std::string fused_note(const Pack& pack, const PortFiles& port, const std::string& pass, const std::string& from) {
  const bool is_given =
      std::any_of(pack.cases.begin(), pack.cases.end(), [&](const PackCase& c) { return c.pass == from && port.has_output(c.id); });
  return is_given ? fmt::format("{} is judged from the port's own outputs of {}, which is in the same shader", pass, from)
                  : fmt::format("{} is judged from all that {} may give, which is in the same shader and has no files", pass, from);
}

}  // namespace

PortJudgement unjudged(const Pack& pack, const std::string& profile) {
  PortJudgement j;
  j.pack = path_text(pack.folder());
  j.profile = profile;
  j.effect = pack.effect;
  j.variant = pack.variant;
  j.scene = pack.scene;
  return j;
}

void describe_port(const port_dump::PortInfo& info, PortJudgement& j) {
  j.api = info.api;
  j.device = info.device;
  j.driver = info.driver;
  const port_dump::Api* api = port_dump::api_of(info.api);
  if (api && !api->profile.empty() && api->profile != j.profile && !profile(j.profile).reference)
    j.notes.push_back(fmt::format("port.json names {}, whose profile is {}; this is judged under {}", api->name, api->profile, j.profile));
}

std::optional<HalfMode> declared_mode(const port_dump::PortInfo& port) {
  if (!port.half_store) return std::nullopt;
  return *port.half_store == Rounding::rne ? HalfMode::rne : HalfMode::rtz;
}

PortJudgement validate(const Pack& pack, const std::filesystem::path& folder, const ValidateOptions& options) {
  const enclosed::Profile& chosen = profile(options.profile);
  for (const std::string& pass : options.only) static_cast<void>(pack.pass(pass));
  if (!pack.with_inputs)
    throw Error(ExitCode::usage, fmt::format("{}: a capture without inputs cannot judge a port; make a pack", path_text(pack.folder())));
  check_pack(pack);
  require_apart(pack.folder(), folder, ExitCode::usage);
  const std::shared_ptr<ReadBuffers> buffers = options.buffers ? options.buffers : std::make_shared<ReadBuffers>();
  PortFiles port(folder, pack.effect, pack.variant, buffers);
  PortFiles other_files(folder, pack.effect, pack.variant, buffers);  // errors in a voter's files are reported when it is judged
  std::vector<FusedPasses> groups;
  for (const std::string& text : options.fused) groups.push_back(fused_passes(text, pack));
  const FusedInputs fused(pack, groups, chosen, *options.executor);
  std::set<std::string> absent = passes_without_files(pack, port);
  if (!options.partial) std::erase_if(absent, [&](const std::string& pass) { return fused.last_of(pass).empty(); });
  require_any_folder(pack, options, absent, port);

  PortJudgement result = unjudged(pack, options.profile);
  result.port = path_text(folder);
  describe_port(port.info(), result);

  const JudgeOptions how{&chosen, chosen.reference ? nullptr : &profile("typical"), options.executor, declared_mode(port.info()),
                         options.sample};
  int done = 0;
  const auto wanted = static_cast<int>(std::count_if(pack.cases.begin(), pack.cases.end(),
                                                     [&](const PackCase& c) { return options.wants(c.pass) && !absent.contains(c.pass); }));
  std::vector<PassTask> tasks, voters;
  std::vector<FileFaults> faults(pack.cases.size());
  for (const PackPass& pass : pack.passes) {
    const bool is_wanted = options.wants(pass.name);
    if (is_wanted && absent.contains(pass.name)) continue;
    std::vector<const PackCase*> cases;
    for (const PackCase& entry : pack.cases)
      if (entry.pass == pass.name) cases.push_back(&entry);
    if (!is_wanted && (cases.empty() || !stores_halves(*cases.front()))) continue;
    PassRuns runs;
    runs.count = cases.size();
    for (const PackCase* c : cases)
      runs.invocations += invocations_of(
          c->outputs, [](const auto& o) -> const auto& { return o.shape; });
    runs.load = [&, cases, is_wanted](std::size_t k) {
      FileFaults own;
      PortRun run = read_run(pack, *cases[k], fused, is_wanted ? port : other_files, own);
      if (is_wanted) faults[static_cast<std::size_t>(cases[k] - pack.cases.data())] = own;
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
    (is_wanted ? tasks : voters).push_back({&pass, binder(pack, pass.name), std::move(runs)});
  }
  std::vector<PassJudgement> judged = judge_passes(tasks, how, voters);
  auto next = judged.begin();
  for (const PackPass& pass : pack.passes)
    if (options.wants(pass.name))
      result.passes.push_back(absent.contains(pass.name) ? without_files(pass, fused.last_of(pass.name)) : std::move(*next++));
  for (const FileFaults& own : faults) result.files.insert(result.files.end(), own.all().begin(), own.all().end());
  const std::vector<std::string> notes = port.notes();
  result.notes.insert(result.notes.end(), notes.begin(), notes.end());
  for (const PassJudgement& pass : result.passes)
    for (const std::string& from : fused.computed_for(pass.pass))
      if (!pass.cases.empty()) result.notes.push_back(fused_note(pack, port, pass.pass, from));
  conclude(result);
  return result;
}

}  // namespace rainref::judge
