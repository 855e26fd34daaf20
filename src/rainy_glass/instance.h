// Rainy glass as a scene says it: opened, run and written like every effect.
#pragma once

#include "effect/effect.h"
#include "rainref/rainy_glass.h"

namespace rainref::rainy_glass {

/// What the registry holds.
effect::Effect entry();

class Instance final : public effect::InstanceOf<RainyGlass> {
 public:
  Instance(const Settings& settings, Surroundings surroundings, const parallel::Executor& executor);
  const Settings& settings() const { return settings_; }
  const Surroundings& surroundings() const { return surroundings_; }
  std::vector<PassOutput> buffers() override;
  std::vector<image_io::Layer> layers() const override;
  /// The maps have a size of their own.
  std::vector<effect::Map> maps() const override { return {{"raindrops", &running().raindrops()}, {"rivulets", &running().rivulets()}}; }

 private:
  Settings settings_;
  Surroundings surroundings_;
};

}  // namespace rainref::rainy_glass
