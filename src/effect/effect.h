// The description of an effect, which its room provides and the registry holds.
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

/// Data that a scene prepares, cached by what it reads (cache/prepared.h).
struct Prepared {
  std::string name;               ///< name of the function that makes it
  std::vector<std::string> keys;  ///< if one of these keys changes, it is made again
};
/// Returns the concatenation of two lists of keys.
inline std::vector<std::string> joined(std::vector<std::string> keys, const std::vector<std::string>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

struct Effect {
  std::string name;
  std::vector<std::string> variants;
  std::span<const scene::Parameter> parameters;  ///< the effect's own; the parameters common to all scenes are added
  const capture::EffectInfo* info;               ///< passes, buffers, layouts
  /// Returns the memory of a scene: the effect, and the pictures generated for it.
  RunMemory (*memory)(const scene::Config& config);
  /// Reads the scene's input files, adds them to `inputs`, and builds the effect. Throws Error with key, expected and found.
  std::unique_ptr<Instance> (*open)(const scene::Config& config, const parallel::Executor& executor, Inputs& inputs);
  /// Data that it prepares.
  std::vector<Prepared> prepared = {};
};

}  // namespace rainref::effect
