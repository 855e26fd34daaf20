// The window drops of a scene, with the common interface of all effects.
#pragma once

#include "effect/effect.h"
#include "effect/scene_pictures.h"
#include "rainref/screen_drops.h"

namespace rainref::screen_drops {

/// Entry of the registry.
effect::Effect entry();

class Instance final : public effect::InstanceOf<ScreenDrops> {
 public:
  /// `named`: source of later pictures; that of frame 0 is in `pictures`.
  Instance(const Settings& settings, Inputs pictures, effect::ScenePictures named, const FlowSettings* flow,
           const parallel::Executor& executor);
  const Settings& settings() const { return settings_; }
  /// The scene's picture; for a sequence, that of the last rendered frame.
  const Image& scene_colour() const { return pictures_.colour; }
  void list_state(state::Items& items) override;
  std::vector<PassOutput> buffers() override;
  std::vector<image_io::Layer> layers() const override;
  bool has_drops_layer() const override { return settings_.variant == Variant::corrected; }
  effect::DropsLayer drops_layer(const parallel::Executor& executor) const override;
  std::optional<std::vector<effect::DropDisc>> drop_discs() const override;
  std::optional<effect::Display> display() const override;
  bool has_sequence() const { return named_.change(); }

 private:
  void show_pictures_of(int frame) override;

  effect::ScenePictures named_;
  int shown_ = 0;  ///< frame whose picture is behind the glass
  int held_ = 0;   ///< frame whose picture is in memory; differs after a load
  Settings settings_;
  Inputs pictures_;
};

}  // namespace rainref::screen_drops
