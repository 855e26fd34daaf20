#include "foreign/reference.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/path_text.h"
#include "rainref/error.h"
#include "spirv/spirv_model.h"

namespace rainref::foreign {
namespace {

/// Explains why a case does not belong to this pass, or returns "".
std::string case_fault(const EffectFile& effect, const Pass& pass, const capture::PassCase& c) {
  const capture::PassCase like = case_of(effect, pass, c.frame, c.step);
  const auto differs = [](const capture::Array& a, const capture::Array& b) {
    if (a.is_records != b.is_records) return true;
    if (a.is_records) return !scene::same_layout(a.record, b.record) || b.levels.size() != 1;
    return a.format != b.format || a.width != b.width || a.height != b.height || a.levels.size() != b.levels.size();
  };
  if (c.inputs.size() != like.inputs.size() || c.outputs.size() != like.outputs.size() || c.level != -1)
    return "expected the inputs and outputs of its description";
  for (std::size_t i = 0; i < c.inputs.size(); ++i)
    if (c.inputs[i].name != like.inputs[i].name || differs(like.inputs[i].array, c.inputs[i].array))
      return fmt::format("in.{} is not as the description says", c.inputs[i].name);
  for (std::size_t o = 0; o < c.outputs.size(); ++o)
    if (c.outputs[o].name != like.outputs[o].name || differs(like.outputs[o].array, c.outputs[o].array) ||
        c.outputs[o].judge != capture::Judge::envelope)
      return fmt::format("out.{} is not as the description says", c.outputs[o].name);
  return "";
}

}  // namespace

std::shared_ptr<const EffectFile> reference_of(const capture::Pack& pack) {
  if (pack.reference.empty()) return nullptr;
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::port_files, fmt::format("{}: {}", path_text(pack.folder()), why));
  };
  // Hashes first, and no other file: a description may name any path.
  for (const capture::PackFileEntry& file : pack.reference) static_cast<void>(pack.read_file(file));
  const auto must_be_named = [&](const std::filesystem::path& path) {
    const std::string shader = path_text(path.lexically_relative(pack.folder()));
    if (std::none_of(pack.reference.begin(), pack.reference.end(), [&](const auto& f) { return f.path == shader; }))
      refuse(fmt::format("the manifest does not name the shader '{}'", shader));
  };
  auto effect = std::make_shared<EffectFile>(read_effect(pack.folder() / utf8_path(pack.reference.front().path), must_be_named));
  if (effect->info.name != pack.effect || pack.variant != variant)
    refuse(
        fmt::format("its reference is of effect '{}', the manifest of '{}', variant '{}'", effect->info.name, pack.effect, pack.variant));
  const auto pass_named = [&](const std::string& name) -> const Pass& {
    const Pass* found = effect->find(name);
    if (!found) refuse(fmt::format("its reference has no pass '{}'", name));
    return *found;
  };
  for (const capture::PackPass& said : pack.passes) {
    const Pass& pass = pass_named(said.name);
    const capture::PassInfo& declared = effect->info.pass(said.name);
    if (said.formula != capture::formula(effect->info, declared, *declared.variant(variant)) || !scene::same_layout(said.block, pass.block))
      refuse(fmt::format("pass '{}' is not as its reference describes it", said.name));
  }
  for (const capture::PackCase& entry : pack.cases)
    if (const std::string why = case_fault(*effect, pass_named(entry.pass), pack.described(entry)); !why.empty())
      refuse(fmt::format("{}: {}", entry.id, why));
  return effect;
}

std::unique_ptr<capture::PassModel> model_of(const EffectFile& effect, const std::string& name, const capture::PassCase& c) {
  const Pass* pass = effect.find(name);
  if (!pass) return nullptr;
  return spirv::spirv_model(c, pass->program, pass->words, "'" + path_text(pass->program.spirv.filename()) + "'");
}

capture::PassCase case_of(const EffectFile& effect, const Pass& pass, int frame, int step) {
  capture::PassCase c;
  c.effect = effect.info.name;
  c.variant = variant;
  c.pass = pass.name;
  c.frame = frame;
  c.step = step;
  c.uniforms.resize(pass.block.size);
  for (const Input& input : pass.inputs) {
    c.inputs.push_back(input.like);
    c.inputs.back().array.levels.resize(input.levels);
  }
  for (const capture::CaseOutput& output : pass.outputs) {
    c.outputs.push_back(output);
    c.outputs.back().array.levels.resize(1);
  }
  return c;
}

}  // namespace rainref::foreign
