#include "judge/check_pack.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/path_text.h"
#include "capture/check_case.h"
#include "foreign/reference.h"
#include "judge/keyed.h"
#include "judge/reference_outputs.h"
#include "judge/slots.h"
#include "registry/registry.h"
#include "rainref/error.h"

namespace rainref::judge {

void check_pack(const capture::Pack& pack) {
  if (foreign::reference_of(pack)) return;
  const effect::Effect& effect = registry::effect_of_pack(pack.effect);
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::port_files, fmt::format("{}: {}", path_text(pack.folder()), why));
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
  const std::string again = fmt::format("the pack was made by rainref {}; make it again", pack.producer);
  for (const capture::PackPass& pass : pack.passes) {
    const auto declared = std::find_if(effect.info->passes.begin(), effect.info->passes.end(), [&](const capture::PassInfo& one) {
      return one.name == pass.name && one.variant(pack.variant) && scene::same_layout(one.block(pack.variant), pass.block);
    });
    if (declared == effect.info->passes.end())
      refuse(fmt::format("the uniform block of pass '{}' is not that of this version: {}", pass.name, again));
    const std::string own = capture::formula(*effect.info, *declared, *declared->variant(pack.variant));
    if (own != pass.formula) refuse(fmt::format("expected the formula '{}', found '{}': {}", own, pass.formula, again));
  }
}

capture::PassCase read_case(const capture::Pack& pack, const capture::PackCase& entry) {
  capture::PassCase c = pack.read(entry);
  if (const std::string why = capture::record_fault(c); !why.empty())
    throw Error(ExitCode::port_files, fmt::format("{}: {}: {}", path_text(pack.folder()), entry.id, why));
  return c;
}

void require_reference(const capture::Pack& pack, const capture::PassCase& c, const capture::PassModel& model,
                       const parallel::Executor& executor) {
  const std::vector<capture::Array> reference = reference_outputs(c, model, executor);
  for (std::size_t o = 0; o < reference.size(); ++o) {
    const capture::Array& expected = c.outputs[o].array;
    if (reference[o].levels == expected.levels) continue;
    if (c.outputs[o].judge == capture::Judge::keyed && !is_placed(c.outputs[o]) && same_records(reference[o], expected)) continue;
    throw Error(
        ExitCode::port_files,
        fmt::format(
            "{}: {}/out.{}: expected what this version computes, found other values: the pack was made by rainref {}; make it again",
            path_text(pack.folder()), c.folder(), c.outputs[o].name, pack.producer));
  }
}

}  // namespace rainref::judge
