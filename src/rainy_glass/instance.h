// The rainy glass of a scene, with the common interface of all effects.
#pragma once

#include <optional>

#include "effect/effect.h"
#include "effect/scene_pictures.h"
#include "rainref/rainy_glass.h"

namespace rainref::rainy_glass {

/// Entry of the registry.
effect::Effect entry();

class Instance final : public effect::InstanceOf<RainyGlass> {
 public:
  /// `named`: source of later pictures; those of frame 0 are in `surroundings`.
  Instance(const Settings& settings, Surroundings surroundings, effect::ScenePictures named, const parallel::Executor& executor);
  const Settings& settings() const { return settings_; }
  /// For sequences, the pictures of the last rendered frame.
  const Surroundings& surroundings() const { return surroundings_; }
  std::vector<PassOutput> buffers() override;
  std::vector<image_io::Layer> layers() const override;
  bool has_drops_layer() const override { return settings_.variant == Variant::corrected; }
  effect::DropsLayer drops_layer(const parallel::Executor& executor) const override;
  std::optional<effect::Display> display() const override;
  /// The maps, which have their own size.
  std::vector<effect::Map> maps() const override { return {{"raindrops", &running().raindrops()}, {"rivulets", &running().rivulets()}}; }

 private:
  void show_pictures_of(int frame) override;

  effect::ScenePictures named_;
  effect::ScenePictures::Shown shown_;
  Settings settings_;
  Surroundings surroundings_;
};

}  // namespace rainref::rainy_glass
