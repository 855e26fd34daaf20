// All that rainref knows of an effect: what the registry holds, and what a new effect's room offers.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "capture/pass_info.h"
#include "effect/inputs.h"
#include "effect/instance.h"
#include "effect/run_memory.h"
#include "rainref/executor.h"
#include "scene/parameter.h"

namespace rainref::effect {

/// A thing that a scene prepares, remembered by what it reads (cache/prepared.h).
struct Prepared {
  std::string name;               ///< of its maker
  std::vector<std::string> keys;  ///< of which another value makes it again
};
/// Keys, and more of them.
inline std::vector<std::string> joined(std::vector<std::string> keys, const std::vector<std::string>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

struct Effect {
  std::string name;
  std::vector<std::string> variants;
  std::span<const scene::Parameter> parameters;  ///< its own; what every scene may say comes on top
  const capture::EffectInfo* info;               ///< passes, buffers, layouts
  /// What a scene takes: the effect, the pictures made for it.
  RunMemory (*memory)(const scene::Config& config);
  /// Reads the scene's input files, which are added to `inputs`, and builds the effect. Throws Error naming key, expected and found.
  std::unique_ptr<Instance> (*open)(const scene::Config& config, const parallel::Executor& executor, Inputs& inputs);
  /// What it prepares.
  std::vector<Prepared> prepared = {};
};

}  // namespace rainref::effect
