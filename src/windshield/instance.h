// The windshield as a scene says it: opened, run and written like every effect.
#pragma once

#include "drops/records.h"
#include "effect/effect.h"
#include "effect/scene_pictures.h"
#include "rainref/windshield.h"
#include "windshield/parameters.h"

namespace rainref::windshield {

/// What the passes take of a picture of linear radiance, rgba32f: as rgba16f, alpha 1, below 0 as 0 and beyond the largest half as that;
/// all of it as far away as the street's sky.
Surroundings surroundings_of(const Image& linear);

/// What the registry holds.
effect::Effect entry();
/// The street that such a scene drives along where it names no pictures.
std::shared_ptr<const scene::Scenery> street_of(const Settings& settings, const effect::Inputs& inputs);

class Instance final : public effect::InstanceOf<Windshield> {
 public:
  /// `surroundings`: the pictures of frame 0, or a street.
  Instance(const scene::Config& config, Surroundings surroundings, effect::ScenePictures named, const parallel::Executor& executor);
  const Settings& settings() const { return settings_; }
  bool has_street() const { return !named_.are_named(); }
  void skip(Recorder* recorder) override { changed().skip(recorder); }
  void list_state(state::Items& items) override {
    InstanceOf::list_state(items);
    items.then([this] { drops_frame_ = -1; });
  }
  std::vector<PassOutput> buffers() override;
  std::vector<image_io::Layer> layers() const override;
  bool has_drops_layer() const override { return true; }
  /// Of the windshield itself, before its interior.
  effect::DropsLayer drops_layer(const parallel::Executor& executor) const override;
  std::optional<effect::Display> display() const override;

 private:
  void show_pictures_of(int frame) override;

  Settings settings_;
  effect::ScenePictures named_;
  effect::ScenePictures::Shown shown_;
  std::vector<drops::Drop> drops_;  // of frame drops_frame_, as buffers() gave them
  int drops_frame_ = -1;
};

}  // namespace rainref::windshield
