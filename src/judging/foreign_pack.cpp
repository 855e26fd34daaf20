#include "judging/foreign_pack.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/path_text.h"
#include "base/read_file.h"
#include "capture/check_case.h"
#include "capture/json_read.h"
#include "foreign/reference.h"
#include "judge/coverage.h"
#include "judge/null_ports.h"
#include "judge/profiles.h"
#include "judge/reference_outputs.h"
#include "judge/sample.h"
#include "judge/shadow_plan.h"
#include "judge/slots.h"
#include "port_dump/port_info.h"
#include "port_dump/read_buffer.h"
#include "rainref/error.h"

namespace rainref::judging {
namespace {

namespace fs = std::filesystem;
using capture::Array, capture::PassCase;

/// Input and uniform files of the author's run.
class RunFiles {
 public:
  RunFiles(const foreign::EffectFile& effect, fs::path folder) : effect_(effect), folder_(std::move(folder)) {
    std::error_code error;
    if (!fs::is_directory(folder_, error))
      throw Error(ExitCode::port_files, fmt::format("{}: expected a folder with the inputs of a run, found none", path_text(folder_)));
    info_ = port_dump::read_port_info(folder_);
  }
  /// In the order of execution.
  std::vector<judge::DumpedRun> runs() const {
    std::vector<std::string> names;
    for (const foreign::Pass& pass : effect_.passes) names.push_back(pass.name);
    std::vector<judge::DumpedRun> all = judge::dumped_runs(folder_, effect_.info.name, names);
    if (all.empty())
      throw Error(ExitCode::port_files, fmt::format("{}: expected folders such as {}.{}/0000.0, found none", path_text(folder_),
                                                    effect_.info.name, names.front()));
    for (const judge::DumpedRun& run : all)
      if (run.level >= 0)
        throw Error(ExitCode::port_files, fmt::format("{}: expected no level in its name", path_text(folder_ / utf8_path(run.id))));
    const auto place = [&](const judge::DumpedRun& run) {
      return std::tuple(run.frame, run.step, std::find(names.begin(), names.end(), run.pass) - names.begin());
    };
    std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
    return all;
  }
  std::vector<std::byte> uniforms(const foreign::Pass& pass, const std::string& id) const {
    if (pass.block.members.empty()) return std::vector<std::byte>(pass.block.size);
    const fs::path path = folder_ / utf8_path(id) / "uniforms.bin";
    std::vector<std::byte> bytes = read_file(path, {pass.block.size, ExitCode::port_files});
    std::size_t least = 0;  // bytes after the last member are padding, which a host may omit
    for (const scene::Member& m : pass.block.members) least = std::max(least, m.offset + m.size());
    if (bytes.size() < least)
      throw Error(ExitCode::port_files, fmt::format("{}: expected the {} bytes of {}, found {}", path_text(path), pass.block.size,
                                                    pass.block.name, bytes.size()));
    bytes.resize(pass.block.size);
    return bytes;
  }
  bool has(const std::string& id, const std::string& stem) const {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder_ / utf8_path(id), error))
      if (path_text(entry.path().filename()).starts_with(stem + ".")) return true;
    return false;
  }
  Array read(const std::string& id, const std::string& stem, const Array& expected) const {
    port_dump::ReadNotes notes;
    return port_dump::read_port_buffer(folder_ / utf8_path(id), stem, expected, info_, notes);
  }
  std::string path(const std::string& id) const { return path_text(folder_ / utf8_path(id)); }

 private:
  const foreign::EffectFile& effect_;
  fs::path folder_;
  port_dump::PortInfo info_;
};

/// The latest outputs of a pass, and their run.
struct Given {
  int frame = 0, step = 0;
  std::vector<capture::CaseOutput> outputs;
};

class Packing {
 public:
  Packing(const foreign::EffectFile& effect, const RunFiles& files, const parallel::Executor& executor)
      : effect_(effect), files_(files), executor_(executor) {}

  PassCase run(const foreign::Pass& pass, const judge::DumpedRun& at) {
    PassCase c = foreign::case_of(effect_, pass, at.frame, at.step);
    c.uniforms = files_.uniforms(pass, at.id);
    for (std::size_t i = 0; i < c.inputs.size(); ++i) c.inputs[i].array = input(pass.inputs[i], c.inputs[i], at);
    for (capture::CaseOutput& output : c.outputs) {
      const auto texels = static_cast<std::size_t>(output.array.width) * static_cast<std::size_t>(output.array.height);
      output.array.levels = {std::vector<std::byte>(texels * output.array.element_bytes())};
    }
    if (const std::string why = capture::record_fault(c); !why.empty()) refuse(at, why);
    const std::unique_ptr<capture::PassModel> model = foreign::model_of(effect_, pass.name, c);
    const std::vector<Array> stored = judge::reference_outputs(c, *model, executor_);
    for (std::size_t o = 0; o < stored.size(); ++o) c.outputs[o].array = stored[o];
    require_own_texels(pass, c, at);
    require_numbers(c, at);
    given_[pass.name] = {at.frame, at.step, c.outputs};
    exercised_[pass.name].add(judge::coverage_of(c, model.get(), executor_, judge::least_sample, pass.block));
    idle_[pass.name].judge(c, model.get(), judge::profile("vulkan"), &judge::profile("typical"), judge::HalfMode::either, executor_);
    return c;
  }
  void add_coverage(capture::PackWriter& writer) const {
    for (const auto& [pass, exercise] : exercised_) {
      const judge::PassCoverage c = judge::summary(exercise);
      if (c.alternatives > 0) writer.add_coverage(pass, c.taken, c.alternatives, c.never, {}, c.is_sampled);
    }
  }
  std::vector<std::string> warnings() const {
    std::vector<std::string> out;
    for (const auto& [pass, ports] : idle_)
      if (const std::string port = ports.passing(); !port.empty())
        out.push_back(
            fmt::format("this pack says nothing of {}: a port that does nothing passes ({}); take a run with more in it", pass, port));
    return out;
  }

 private:
  [[noreturn]] void refuse(const judge::DumpedRun& at, const std::string& why) const {
    throw Error(ExitCode::port_files, fmt::format("{}: {}", files_.path(at.id), why));
  }
  /// A file of the run, or the output of its source pass.
  Array input(const foreign::Input& input, const capture::CaseInput& like, const judge::DumpedRun& at) const {
    const std::string stem = "in." + like.name;
    const auto given = given_.find(input.from);
    if (files_.has(at.id, stem) || input.from.empty()) return files_.read(at.id, stem, like.array);
    const bool is_there = given != given_.end() && (input.previous || (given->second.frame == at.frame && given->second.step == at.step));
    if (!is_there)
      refuse(at, fmt::format("expected a file {}, because no {}run of {} gives it, found none", stem, input.previous ? "earlier " : "",
                             input.from));
    for (const capture::CaseOutput& output : given->second.outputs)
      if (output.name == like.name) return output.array;
    throw Error(ExitCode::internal, fmt::format("{} has no output {}", input.from, like.name));
  }
  /// The judge evaluates each invocation only for its own texel; the whole dispatch must give the same.
  void require_own_texels(const foreign::Pass& pass, const PassCase& c, const judge::DumpedRun& at) const {
    const std::vector<Array> whole = spirv::execute(c, pass.program, pass.words, "'" + path_text(pass.program.spirv.filename()) + "'");
    for (std::size_t o = 0; o < whole.size(); ++o)
      if (whole[o].levels != c.outputs[o].array.levels)
        refuse(at, fmt::format("{} writes other texels of {} than that of its invocation: it cannot be a reference",
                               path_text(pass.program.spirv.filename()), c.outputs[o].name));
  }
  void require_numbers(const PassCase& c, const judge::DumpedRun& at) const {
    for (const judge::Slot& slot : judge::slots_of(c)) {
      const capture::CaseOutput& output = c.outputs[static_cast<std::size_t>(slot.output)];
      for (int y = 0; y < output.array.height; ++y)
        for (int x = 0; x < output.array.width; ++x)
          if (!std::isfinite(judge::stored_value(slot, slot.at(output.array, x, y))))
            refuse(at, fmt::format("the reference stores what is no finite number in {} at ({}, {}), channel {}", output.name, x, y,
                                   slot.channel));
    }
  }

  const foreign::EffectFile& effect_;
  const RunFiles& files_;
  const parallel::Executor& executor_;
  std::map<std::string, Given> given_;
  std::map<std::string, judge::Exercise> exercised_;
  std::map<std::string, judge::NullPorts> idle_;
};

scene::Config config_of(const foreign::EffectFile& effect) {
  const auto entry = [](scene::Parameter p) {
    scene::Value value = p.default_value;
    return scene::Config::Entry{std::move(p), std::move(value), {}};
  };
  return {{entry(scene::text("effect", effect.info.name, "Effect")), entry(scene::text("variant", foreign::variant, "Variant")),
           entry(scene::integer("seed", "", 0, 0, 0, "Seed"))},
          ""};
}

/// Adds the description with its shaders.
void add_reference(capture::PackWriter& writer, const fs::path& description, const foreign::EffectFile& effect) {
  nlohmann::ordered_json json = capture::read_json(description, path_text(description), capture::large_json);
  for (std::size_t p = 0; p < effect.passes.size(); ++p) json["passes"][p]["spirv"] = effect.passes[p].name + ".spv";
  const std::string text = json.dump(1) + "\n";
  writer.add_reference("reference/effect.json", std::as_bytes(std::span(text)));
  for (const foreign::Pass& pass : effect.passes) writer.add_reference("reference/" + pass.name + ".spv", pass.words);
}

}  // namespace

ForeignPack make_foreign_pack(const ForeignPackRequest& request, const parallel::Executor& executor) {
  const foreign::EffectFile effect = foreign::read_effect(request.effect);
  const RunFiles files(effect, request.inputs);
  const std::vector<judge::DumpedRun> runs = files.runs();
  ForeignPack made;
  for (const foreign::Pass& pass : effect.passes)
    if (std::any_of(runs.begin(), runs.end(), [&](const auto& run) { return run.pass == pass.name; })) made.passes.push_back(pass.name);
  capture::PackWriter writer(request.output, effect.info, config_of(effect), path_text(request.effect.filename()), true, made.passes);
  Packing packing(effect, files, executor);
  for (const judge::DumpedRun& at : runs) writer.add(packing.run(*effect.find(at.pass), at));
  packing.add_coverage(writer);
  add_reference(writer, request.effect, effect);
  made.total = writer.finish();
  made.warnings = packing.warnings();
  return made;
}

}  // namespace rainref::judging
