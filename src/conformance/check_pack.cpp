#include "conformance/check_pack.h"

#include <fmt/format.h>

#include "capture/check_case.h"
#include "conformance/known_effects.h"
#include "rainref/error.h"

namespace rainref::conformance {
namespace {

/// The case without its values.
capture::PassCase shapes_of(const capture::Pack& pack, const capture::PackCase& entry) {
  capture::PassCase c;
  c.effect = pack.effect;
  c.variant = pack.variant;
  c.pass = entry.pass;
  c.frame = entry.frame;
  c.step = entry.step;
  c.level = entry.level;
  c.uniforms = entry.block;
  for (const capture::PackInput& input : entry.inputs) {
    c.inputs.push_back(input.rules);
    c.inputs.back().array.levels.resize(input.levels.size());
  }
  for (const capture::PackOutput& output : entry.outputs) {
    c.outputs.push_back(output.rules);
    c.outputs.back().array.levels.resize(output.levels.size());
  }
  return c;
}

}  // namespace

void check_pack(const capture::Pack& pack) {
  const KnownEffect& effect = known_effect(pack.effect);
  const auto refuse = [&](const std::string& why) { throw Error(ExitCode::port_files, fmt::format("{}: {}", pack.folder().string(), why)); };
  for (const capture::PackCase& entry : pack.cases) {
    const capture::PassCase c = shapes_of(pack, entry);
    try {
      capture::check_case(*effect.info, effect.parameters, c);
    } catch (const Error& e) {
      refuse(e.what());
    }
    if (const std::string why = capture::uniform_fault(*effect.info, c); !why.empty()) refuse(fmt::format("{}: {}", entry.id, why));
  }
  for (const capture::PackPass& pass : pack.passes) {
    if (effect.info->pass_names(pack.variant).empty()) refuse(fmt::format("{} has no variant '{}'", pack.effect, pack.variant));
    bool is_same = false;
    for (const capture::PassInfo& declared : effect.info->passes)
      if (declared.name == pass.name && declared.variant(pack.variant)) is_same = scene::same_layout(declared.block(pack.variant), pass.block);
    if (!is_same) refuse(fmt::format("the uniform block of pass '{}' is not that of this version: the pack was made by rainref {}; make it again", pass.name, pack.producer));
  }
}

capture::PassCase read_case(const capture::Pack& pack, const capture::PackCase& entry) {
  capture::PassCase c = pack.read(entry);
  std::string why = capture::uniform_fault(*known_effect(pack.effect).info, c);
  if (why.empty()) why = capture::record_fault(c);
  if (!why.empty()) throw Error(ExitCode::port_files, fmt::format("{}: {}: {}", pack.folder().string(), entry.id, why));
  return c;
}

}  // namespace rainref::conformance
