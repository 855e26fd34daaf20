// Rainy glass as a scene says it: opened, run and written like every effect.
#pragma once

#include <optional>

#include "effect/effect.h"
#include "effect/scene_pictures.h"
#include "rainref/rainy_glass.h"

namespace rainref::rainy_glass {

/// What the registry holds.
effect::Effect entry();

class Instance final : public effect::InstanceOf<RainyGlass> {
 public:
  /// `named`: its pictures of frame 0 are in `surroundings`.
  Instance(const Settings& settings, Surroundings surroundings, effect::ScenePictures named, const parallel::Executor& executor);
  const Settings& settings() const { return settings_; }
  /// Of sequences those of the frame rendered last.
  const Surroundings& surroundings() const { return surroundings_; }
  std::vector<PassOutput> buffers() override;
  std::vector<image_io::Layer> layers() const override;
  bool has_drops_layer() const override { return settings_.variant == Variant::corrected; }
  effect::DropsLayer drops_layer(const parallel::Executor& executor) const override;
  std::optional<effect::Display> display() const override;
  /// The maps have a size of their own.
  std::vector<effect::Map> maps() const override { return {{"raindrops", &running().raindrops()}, {"rivulets", &running().rivulets()}}; }

 private:
  void show_pictures_of(int frame) override;

  effect::ScenePictures named_;
  effect::ScenePictures::Shown shown_;
  Settings settings_;
  Surroundings surroundings_;
};

}  // namespace rainref::rainy_glass
