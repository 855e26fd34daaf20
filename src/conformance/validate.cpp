#include "conformance/validate.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "conformance/judge.h"
#include "conformance/profiles.h"
#include "port_dump/port_info.h"
#include "port_dump/read_buffer.h"
#include "puddle/readings.h"
#include "rainref/error.h"

namespace rainref::conformance {
namespace {

using capture::Array;
using capture::Pack;
using capture::PackCase;
using capture::PackPass;
using capture::PassCase;

const std::vector<capture::PassReadings>& readings_of(const std::string& effect) {
  static const std::map<std::string, const std::vector<capture::PassReadings>*> all{{"puddle", &puddle::readings()}};
  const auto found = all.find(effect);
  if (found != all.end()) return *found->second;
  std::vector<std::string> names;
  for (const auto& [name, unused] : all) names.push_back(name);
  throw Error(ExitCode::usage, fmt::format("this build judges {}; the pack is of '{}'", fmt::join(names, ", "), effect));
}

std::optional<HalfMode> declared_mode(const port_dump::PortInfo& port) {
  if (!port.half_store) return std::nullopt;
  return *port.half_store == Rounding::rne ? HalfMode::rne : HalfMode::rtz;
}

bool enveloped(const PassCase& c) {
  return std::any_of(c.outputs.begin(), c.outputs.end(), [](const auto& o) { return o.judge == capture::Judge::envelope; });
}

/// The pack's expected outputs are the reference's: else the pack is of another version, or damaged in a way that its
/// hashes do not show.
void require_reference(const Pack& pack, const PassCase& c, const capture::PassModel& model, const parallel::Executor& executor) {
  const std::vector<Array> reference = reference_outputs(c, model, executor);
  for (std::size_t o = 0; o < reference.size(); ++o) {
    if (reference[o].levels == c.outputs[o].array.levels) continue;
    throw Error(ExitCode::port_files,
                fmt::format("{}: {}/out.{}: expected what this version computes, found other values: the pack was made by rainref {}; make it again",
                            pack.folder().string(), c.folder(), c.outputs[o].name, pack.producer));
  }
}

std::vector<Array> read_outputs(const std::filesystem::path& port, const PassCase& c, const port_dump::PortInfo& info, std::vector<std::string>& notes) {
  std::vector<Array> out;
  port_dump::ReadNotes read_notes;
  for (const capture::CaseOutput& o : c.outputs) {
    if (o.judge == capture::Judge::input_only) out.push_back(o.array);
    else out.push_back(port_dump::read_port_buffer(port / c.folder(), "out." + o.name, o.array, info, read_notes));
  }
  for (const std::string& note : read_notes.lines)
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
  return out;
}

/// Sums a pass's cases under each rounding and keeps those of the best one.
void choose_mode(PassJudgement& pass, std::vector<ModeJudgements>& cases) {
  const std::vector<HalfMode>& modes = cases.front().modes;
  std::vector<std::int64_t> failing(modes.size(), 0);
  for (const ModeJudgements& c : cases)
    for (std::size_t m = 0; m < modes.size(); ++m) failing[m] += c.judgements[m].failing;
  std::size_t best = 0;
  if (modes.size() == 3) {
    pass.half_mode_voted = true;
    for (std::size_t m = 0; m < 3; ++m) pass.half_votes[m] = failing[m];
    // Stores of one device round one way. Only when both ways fail and a mixture does not is it a mixture.
    best = failing[1] < failing[0] ? 1 : 0;
    if (failing[best] > 0 && failing[2] == 0) best = 2;
  }
  pass.half_mode = modes[best];
  for (ModeJudgements& c : cases) pass.cases.push_back(std::move(c.judgements[best]));
}

void conclude_pass(PassJudgement& pass) {
  pass.status = Status::pass;
  for (const CaseJudgement& c : pass.cases) {
    if (worse(pass.status, c.status) != pass.status) pass.reason = c.reason;
    pass.status = worse(pass.status, c.status);
  }
  if (pass.cases.empty()) {
    pass.status = Status::untested;
    pass.reason = "the pack has no case of this pass";
  }
  if (pass.half_mode_voted && pass.half_mode == HalfMode::either && pass.status == Status::pass) {
    pass.status = Status::warn;
    pass.reason = "some stores to binary16 round to nearest and some toward zero";
  }
}

}  // namespace

Bind binder(const std::string& effect, const std::string& pass) {
  for (const capture::PassReadings& r : readings_of(effect))
    if (r.pass == pass) return r.bind;
  return nullptr;
}

void conclude(PortJudgement& j) {
  j.status = Status::pass;
  for (const PassJudgement& p : j.passes) {
    j.status = worse(j.status, p.status);
    if (j.first_bad_pass.empty() && p.status == Status::fail) j.first_bad_pass = p.pass;
  }
  if (j.passes.empty()) {
    j.status = Status::untested;
    j.reason = "nothing was judged";
  }
}

PortJudgement validate(const Pack& pack, const std::filesystem::path& port, const ValidateOptions& options) {
  const enclosed::Profile& chosen = profile(options.profile);
  if (!options.only.empty()) static_cast<void>(pack.pass(options.only));
  if (!pack.with_inputs) throw Error(ExitCode::usage, fmt::format("{}: a capture without inputs cannot judge a port; make a pack", pack.folder().string()));
  if (!std::filesystem::is_directory(port)) throw Error(ExitCode::port_files, fmt::format("{}: expected a folder with the port's outputs, found none", port.string()));
  const port_dump::PortInfo info = port_dump::read_port_info(port);

  PortJudgement result;
  result.pack = pack.folder().string();
  result.port = port.string();
  result.profile = options.profile;
  result.effect = pack.effect;
  result.variant = pack.variant;
  result.scene = pack.scene;
  result.api = info.api;
  result.device = info.device;
  result.driver = info.driver;

  int done = 0;
  for (const PackPass& pass : pack.passes) {
    if (!options.only.empty() && pass.name != options.only) continue;
    PassJudgement judged;
    judged.pass = pass.name;
    judged.formula = pass.formula;
    const Bind bind = binder(pack.effect, pass.name);
    std::vector<ModeJudgements> cases;
    for (const PackCase& entry : pack.cases) {
      if (entry.pass != pass.name) continue;
      const PassCase c = pack.read(entry);
      std::unique_ptr<capture::PassModel> model;
      if (enveloped(c)) {
        if (!bind) throw Error(ExitCode::internal, fmt::format("no reading of pass {}", pass.name));
        model = bind(c);
        require_reference(pack, c, *model, *options.executor);
      }
      const std::vector<Array> stored = read_outputs(port, c, info, result.notes);
      const JudgeOptions how{&chosen, chosen.reference ? nullptr : &profile("typical"), options.executor, declared_mode(info)};
      cases.push_back(judge_case(c, model.get(), stored, how));
      if (options.progress) options.progress(++done, static_cast<int>(pack.cases.size()));
    }
    if (!cases.empty()) choose_mode(judged, cases);
    conclude_pass(judged);
    if (options.diagnose && judged.status == Status::fail && bind) {
      // The case with the most failures says most.
      const auto worst = std::max_element(judged.cases.begin(), judged.cases.end(), [](const auto& a, const auto& b) { return a.failing < b.failing; });
      const PackCase* before = nullptr;
      for (const PackCase& entry : pack.cases) {
        if (entry.pass != pass.name) continue;
        const PassCase c = pack.read(entry);
        if (c.folder() != worst->id) {
          before = &entry;
          continue;
        }
        if (!enveloped(c)) break;
        const std::unique_ptr<capture::PassModel> model = bind(c);
        std::optional<PassCase> earlier;
        if (before) earlier = pack.read(*before);
        std::vector<std::string> unused;
        judged.causes = diagnose(pass, c, earlier ? &*earlier : nullptr, bind, *model, read_outputs(port, c, info, unused), *worst, chosen, judged.half_mode, *options.executor);
        break;
      }
    }
    result.passes.push_back(std::move(judged));
  }
  conclude(result);
  return result;
}

}  // namespace rainref::conformance
