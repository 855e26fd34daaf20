#include "judge/check_pack.h"

#include <algorithm>

#include <fmt/format.h>

#include "capture/check_case.h"
#include "registry/registry.h"
#include "rainref/error.h"

namespace rainref::judge {

void check_pack(const capture::Pack& pack) {
  const effect::Effect& effect = registry::effect_of_pack(pack.effect);
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::port_files, fmt::format("{}: {}", pack.folder().string(), why));
  };
  if (effect.info->pass_names(pack.variant).empty()) refuse(fmt::format("{} has no variant '{}'", pack.effect, pack.variant));
  for (const capture::PackCase& entry : pack.cases) {
    const capture::PassCase c = pack.described(entry);
    try {
      capture::check_case(*effect.info, effect.parameters, c);
    } catch (const Error& e) {
      refuse(e.what());
    }
    if (const std::string why = capture::uniform_fault(*effect.info, c); !why.empty()) refuse(fmt::format("{}: {}", entry.id, why));
  }
  for (const capture::PackPass& pass : pack.passes) {
    const bool is_same = std::any_of(effect.info->passes.begin(), effect.info->passes.end(), [&](const capture::PassInfo& declared) {
      return declared.name == pass.name && declared.variant(pack.variant) && scene::same_layout(declared.block(pack.variant), pass.block);
    });
    if (!is_same)
      refuse(fmt::format("the uniform block of pass '{}' is not that of this version: the pack was made by rainref {}; make it again",
                         pass.name, pack.producer));
  }
}

capture::PassCase read_case(const capture::Pack& pack, const capture::PackCase& entry) {
  capture::PassCase c = pack.read(entry);
  if (const std::string why = capture::record_fault(c); !why.empty())
    throw Error(ExitCode::port_files, fmt::format("{}: {}: {}", pack.folder().string(), entry.id, why));
  return c;
}

}  // namespace rainref::judge
