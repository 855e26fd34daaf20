#include "cli/registry.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/floating_point.h"
#include "cli/effects.h"

namespace rainref::cli {

void Simulation::frame(Recorder* recorder) {
  const FloatingPointGuard guard;
  advance(recorder);
}
nlohmann::ordered_json Simulation::compare_truth(const std::filesystem::path&) { return nullptr; }

const std::vector<EffectEntry>& effects() {
  static const std::vector<EffectEntry> all = [] {
    std::vector<EffectEntry> entries{puddle_entry(), windshield_entry(), edge_splash_entry(), screen_drops_entry(), rainy_glass_entry()};
    for (EffectEntry& e : entries) {
      e.make = [make = std::move(e.make), memory = e.memory](const scene::Config& config, const parallel::Executor& executor,
                                                             std::vector<InputFile>& inputs) {
        const FloatingPointGuard guard;
        require_memory(memory(config));
        return make(config, executor, inputs);
      };
    }
    return entries;
  }();
  return all;
}

scene::Config config_of_passes(const scene::Config& config) {
  std::vector<scene::Config::Entry> entries;
  for (const scene::Config::Entry& e : config.entries()) {
    if (!e.parameter.key.starts_with("compositor.")) entries.push_back(e);
  }
  return scene::Config(std::move(entries), config.directory());
}

const EffectEntry& effect(std::string_view name) {
  const scene::Effect& found = effect_table().find(name);
  return *std::find_if(effects().begin(), effects().end(), [&](const EffectEntry& e) { return e.name == found.name; });
}

const scene::EffectTable& effect_table() {
  static const scene::EffectTable table = [] {
    scene::EffectTable t;
    for (const EffectEntry& e : effects()) t.effects.push_back({e.name, e.variants, e.parameters});
    return t;
  }();
  return table;
}

}  // namespace rainref::cli
