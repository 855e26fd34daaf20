// Splashes at edges as a scene says it: opened, run and written like every effect.
#pragma once

#include "edge_splash/scene_pictures.h"
#include "effect/effect.h"
#include "rainref/edge_splash.h"

namespace rainref::edge_splash {

/// What the registry holds.
effect::Effect entry();

class Instance final : public effect::InstanceOf<EdgeSplash> {
 public:
  /// `pictures`: of frame 0, or made.
  Instance(const Settings& settings, const Inputs& pictures, ScenePictures named, const parallel::Executor& executor);
  std::vector<PassOutput> buffers() override;
  std::vector<image_io::Layer> layers() const override;
  std::optional<effect::Display> display() const override;

 private:
  void show_pictures_of(int frame) override;

  double exposure_;
  ScenePictures named_;
  ScenePictures::Shown shown_;
};

}  // namespace rainref::edge_splash
