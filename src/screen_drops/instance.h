// Drops on a window as a scene says it: opened, run and written like every effect.
#pragma once

#include "effect/effect.h"
#include "rainref/screen_drops.h"

namespace rainref::screen_drops {

/// What the registry holds.
effect::Effect entry();

class Instance final : public effect::InstanceOf<ScreenDrops> {
 public:
  Instance(const Settings& settings, Inputs pictures, const FlowSettings* flow, const parallel::Executor& executor);
  const Settings& settings() const { return settings_; }
  /// The scene's picture.
  const Image& scene_colour() const { return pictures_.colour; }
  std::vector<PassOutput> buffers() override;
  std::vector<image_io::Layer> layers() const override;

 private:
  Settings settings_;
  Inputs pictures_;
};

}  // namespace rainref::screen_drops
