// `rainref list`.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/json_text.h"
#include "cli/preset_json.h"
#include "cli/terminal.h"
#include "math/simd_target.h"
#include "rainref/executor.h"
#include "rainref/version.h"
#include "registry/registry.h"
#include "simulation/opened.h"
#include "simulation/preset_texts.h"
#include "simulation/scene_index.h"

namespace rainref::cli {
namespace {

/// The effect of that name alone, or all of them for "".
std::vector<const effect::Effect*> effects_of(const std::string& name) {
  std::vector<const effect::Effect*> out;
  for (const effect::Effect* e : registry::effects())
    if (name.empty() || e->name == name) out.push_back(e);
  return out;
}

/// Its sentence, and the effects that it describes unless it describes all.
std::string preset_words(const scene::Preset& preset) {
  std::vector<std::string> names;
  for (const effect::Effect* e : registry::effects())
    if (preset.keys.contains(e->name)) names.push_back(e->name);
  if (names.size() == registry::effects().size()) return preset.sentence;
  return fmt::format("{} ({} only)", preset.sentence, fmt::join(names, ", "));
}

}  // namespace

int list(const std::string& effect, bool json) {
  if (!effect.empty()) static_cast<void>(simulation::effect_table().find(effect));
  const std::vector<simulation::KnownScene> scenes = simulation::scene_index(effect);
  if (json) {
    nlohmann::ordered_json out;
    out["effects"] = nlohmann::ordered_json::array();
    for (const effect::Effect* e : effects_of(effect)) {
      nlohmann::ordered_json one{{"name", e->name}, {"variants", e->variants}, {"passes", nlohmann::ordered_json::array()}};
      for (const capture::PassInfo& pass : e->info->passes) one["passes"].push_back(pass.name);
      out["effects"].push_back(one);
    }
    out["scenes"] = nlohmann::ordered_json::array();
    out["scene_sentences"] = nlohmann::ordered_json::array();
    for (const simulation::KnownScene& scene : scenes) {
      out["scenes"].push_back(scene.name);
      out["scene_sentences"].push_back(scene.sentence);
    }
    out["presets"] = presets_json(effect);
    out["simd_targets"] = simd_targets();
    out["threads"] = parallel::Executor().threads();
    say("{}\n", json_text(out));
    return 0;
  }
  say("rainref {}\n\nEffects\n", version());
  for (const effect::Effect* e : effects_of(effect)) {
    for (const std::string& variant : e->variants) {
      say("  {:<14} {:<13}", e->name, variant);
      for (const std::string& pass : e->info->pass_names(variant)) say(" {}", pass);
      say("\n");
    }
  }
  say("\nScenes\n");
  std::size_t width = 0;
  for (const simulation::KnownScene& scene : scenes) width = std::max(width, scene.name.size());
  for (const simulation::KnownScene& scene : scenes)
    say("  {}\n", scene.sentence.empty() ? scene.name : fmt::format("{:<{}}  {}", scene.name, width, scene.sentence));
  const std::vector<scene::Preset> presets = simulation::known_presets(effect);
  if (!presets.empty()) say("\nPresets, for --preset: weather, light or both\n");
  for (const scene::Preset& preset : presets)
    say("  {:<14} {:<8} {}\n", preset.name, preset.kind, effect.empty() ? preset_words(preset) : preset.sentence);
  say("\nSIMD targets    {}\nThreads         {}\n", fmt::join(simd_targets(), " "), parallel::Executor().threads());
  return 0;
}

}  // namespace rainref::cli
