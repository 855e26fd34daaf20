// The effects as the scene room needs them; they live on a higher floor.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/parameter.h"

namespace rainref::scene {

/// An effect as a scene uses it. The parameters must outlive the table.
struct Effect {
  std::string name;
  std::vector<std::string> variants;
  std::span<const Parameter> parameters;
};

struct EffectTable {
  std::vector<Effect> effects;
  std::filesystem::path presets{};  ///< the folder of the presets that their scenes may name; "": none

  std::vector<std::string> names() const;
  /// Throws Error(usage) with the nearest effect if this name is unknown.
  const Effect& find(std::string_view name) const;
};

/// The parameter `effect`: the effect of a scene; required.
Parameter effect_parameter(const EffectTable& table);
/// The parameter `variant`: the variant of the effect; required.
Parameter variant_parameter(const Effect& effect);
/// All parameters of a scene of this effect, in order: effect, variant, seed, run.frames, run.fps, run.size, then the effect's own
/// parameters. Throws Error(internal) if the effect's table contradicts itself.
std::vector<Parameter> scene_parameters(const Effect& effect, const EffectTable& table);

}  // namespace rainref::scene
