// The windshield of a scene, with the common interface of all effects.
#pragma once

#include "drops/records.h"
#include "effect/effect.h"
#include "effect/scene_pictures.h"
#include "rainref/windshield.h"
#include "windshield/parameters.h"

namespace rainref::windshield {

/// Converts a picture of linear radiance, rgba32f, to the input of the passes: rgba16f, alpha 1, clamped to [0, largest half]; all of it at
/// the distance of the street's sky.
Surroundings surroundings_of(const Image& linear);

/// Entry of the registry.
effect::Effect entry();
/// The street along which a scene without pictures drives.
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
  /// For the windshield itself, before its interior.
  effect::DropsLayer drops_layer(const parallel::Executor& executor) const override;
  std::optional<effect::Display> display() const override;

 private:
  void show_pictures_of(int frame) override;

  Settings settings_;
  effect::ScenePictures named_;
  effect::ScenePictures::Shown shown_;
  std::vector<drops::Drop> drops_;  // of frame drops_frame_, as buffers() returned them
  int drops_frame_ = -1;
};

}  // namespace rainref::windshield
