// The puddle of a scene, with the common interface of all effects.
#pragma once

#include "effect/effect.h"
#include "rainref/puddle.h"

namespace rainref::puddle {

/// Entry of the registry.
effect::Effect entry();

class Instance final : public effect::InstanceOf<Puddle> {
 public:
  Instance(const Settings& settings, Surroundings surroundings, const parallel::Executor& executor);
  const Settings& settings() const { return settings_; }
  const Surroundings& surroundings() const { return surroundings_; }
  std::vector<PassOutput> buffers() override;
  std::vector<image_io::Layer> layers() const override;
  std::optional<effect::Display> display() const override;

 private:
  Settings settings_;
  Surroundings surroundings_;
};

}  // namespace rainref::puddle
