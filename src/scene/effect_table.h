// What the caller tells the scene room about the effects, which live on a higher floor.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/parameter.h"

namespace rainref::scene {

/// An effect as a scene sees it. The parameters must outlive the table.
struct Effect {
  std::string name;
  std::vector<std::string> variants;
  std::span<const Parameter> parameters;
};

struct EffectTable {
  std::vector<Effect> effects;

  std::vector<std::string> names() const;
  /// Throws Error(usage) naming the nearest effect when there is none of this name.
  const Effect& find(std::string_view name) const;
};

/// `effect`: which effect a scene is about; required.
Parameter effect_parameter(const EffectTable& table);
/// `variant`: which reading of the effect; required.
Parameter variant_parameter(const Effect& effect);
/// Everything that a scene of this effect may set, in order: effect, variant, seed, run.frames, run.fps, run.size, then
/// the effect's own parameters. Throws Error(internal) when the effect's table contradicts itself.
std::vector<Parameter> scene_parameters(const Effect& effect, const EffectTable& table);

}  // namespace rainref::scene
