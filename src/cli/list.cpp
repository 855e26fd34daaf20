// `rainref list` and `rainref describe`.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/json_text.h"
#include "cli/layout_text.h"
#include "cli/terminal.h"
#include "foreign/draft.h"
#include "math/simd_target.h"
#include "rainref/error.h"
#include "rainref/version.h"
#include "registry/registry.h"
#include "scene/describe.h"
#include "simulation/describe.h"
#include "simulation/opened.h"
#include "simulation/own_scenes.h"

namespace rainref::cli {
namespace {

std::string reads_text(const capture::PassInfo& pass) {
  std::string text;
  for (const capture::ReadInfo& r : pass.reads) {
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", r.buffer, r.variant.empty() ? "" : fmt::format(" ({})", r.variant));
  }
  return text.empty() ? "nothing" : text;
}
std::vector<std::string> variants_of(const capture::PassInfo& pass) {
  std::vector<std::string> out;
  for (const capture::PassVariant& v : pass.variants) out.push_back(v.name);
  return out;
}

}  // namespace

int list(bool json) {
  if (json) {
    nlohmann::ordered_json out;
    out["effects"] = nlohmann::ordered_json::array();
    for (const effect::Effect* e : registry::effects()) {
      nlohmann::ordered_json effect{{"name", e->name}, {"variants", e->variants}, {"passes", nlohmann::ordered_json::array()}};
      for (const capture::PassInfo& pass : e->info->passes) effect["passes"].push_back(pass.name);
      out["effects"].push_back(effect);
    }
    out["scenes"] = simulation::known_scenes();
    out["simd_targets"] = simd_targets();
    out["threads"] = parallel::Executor().threads();
    say("{}\n", json_text(out));
    return 0;
  }
  say("rainref {}\n\nEffects\n", version());
  for (const effect::Effect* e : registry::effects()) {
    for (const std::string& variant : e->variants) {
      say("  {:<14} {:<13}", e->name, variant);
      for (const std::string& pass : e->info->pass_names(variant)) say(" {}", pass);
      say("\n");
    }
  }
  say("\nScenes\n");
  for (const std::string& scene : simulation::known_scenes()) say("  {}\n", scene);
  say("\nSIMD targets    {}\nThreads         {}\n", fmt::join(simd_targets(), " "), parallel::Executor().threads());
  return 0;
}

int describe_shaders(const std::vector<std::filesystem::path>& shaders) {
  say("{}", foreign::draft_of(shaders));
  return 0;
}

int describe(const std::string& name, bool json, const LayoutRequest& layout) {
  const scene::EffectTable& table = simulation::effect_table();
  const scene::Effect& declared = table.find(name);
  const effect::Effect& e = *registry::find(declared.name);
  const std::vector<scene::Parameter> parameters = scene::scene_parameters(declared, table);
  if (layout.language) {
    say("{}", layout_text(*e.info, scene::language_from_name(*layout.language), layout.pass, layout.variant));
    return 0;
  }
  if (layout.pass || layout.variant)
    throw Error(ExitCode::usage, fmt::format("{}: only beside --layout", layout.pass ? "--pass" : "--variant"));
  if (json) {
    say("{}\n", simulation::describe_json(name));
    return 0;
  }
  say("{}: variants {}\n\nParameters\n\n{}\nPasses, in the order of execution\n\n", e.name, fmt::join(e.variants, ", "),
      scene::describe_text(parameters));
  for (const capture::PassInfo& p : e.info->passes) {
    const bool all = p.variants.size() == e.variants.size();
    say("{}{}\n    {}\n    reads {}; writes {}; judged by {}\n", p.name, all ? "" : fmt::format(" ({})", fmt::join(variants_of(p), ", ")),
        p.sentence, reads_text(p), fmt::join(p.writes, ", "), capture::judge_text(p));
  }
  say("\nBuffers\n\n");
  for (const capture::BufferInfo& b : e.info->buffers) {
    say("{:<16} {:<15} {}{}{}\n", b.name, b.format, b.variant.empty() ? "" : b.variant + ": ", b.sentence,
        b.encoding == "none" ? "" : fmt::format(" {}.", b.encoding));
  }
  return 0;
}

}  // namespace rainref::cli
