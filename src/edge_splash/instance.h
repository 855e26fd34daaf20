// The edge splashes of a scene, with the common interface of all effects.
#pragma once

#include "edge_splash/scene_pictures.h"
#include "effect/effect.h"
#include "rainref/edge_splash.h"

namespace rainref::edge_splash {

/// Entry of the registry.
effect::Effect entry();

class Instance final : public effect::InstanceOf<EdgeSplash> {
 public:
  /// `pictures`: of frame 0, or generated.
  Instance(const Settings& settings, const Inputs& pictures, ScenePictures named, const parallel::Executor& executor);
  std::vector<PassOutput> buffers() override;
  std::vector<image_io::Layer> layers() const override;
  std::optional<effect::Display> display() const override;

 private:
  void show_pictures_of(int frame) override;
  /// The colour as numbers: codes become code / 255, as display loads them.
  const Image& radiance() const;

  double exposure_;
  ScenePictures named_;
  ScenePictures::Shown shown_;
  mutable Image radiance_;  ///< rgba32f, of a colour of codes
};

}  // namespace rainref::edge_splash
