// What a rainref::Simulation holds.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "rainref/simulation.h"
#include "scene/toml.h"
#include "simulation/opened.h"

namespace rainref {

struct Simulation::State {
  SceneText scene;  ///< with every change since
  const parallel::Executor& executor;
  simulation::Opened opened;

  State(SceneText text, const parallel::Executor& e)
      : scene(std::move(text)), executor(e), opened(scene::parse(scene, simulation::effect_table()), e) {}

  std::vector<std::byte> save() const {
    std::vector<std::byte> bytes;
    opened.save("", [&](std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); });
    return bytes;
  }
};

}  // namespace rainref
