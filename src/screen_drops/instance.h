// The window drops of a scene, with the common interface of all effects.
#pragma once

#include <optional>

#include "effect/effect.h"
#include "effect/picture_sequence.h"
#include "rainref/screen_drops.h"

namespace rainref::screen_drops {

/// Entry of the registry.
effect::Effect entry();

class Instance final : public effect::InstanceOf<ScreenDrops> {
 public:
  /// `sequence`: source of later pictures, or nothing; that of frame 0 is in `pictures`.
  Instance(const Settings& settings, Inputs pictures, std::optional<effect::PictureSource> sequence, const FlowSettings* flow,
           const parallel::Executor& executor);
  const Settings& settings() const { return settings_; }
  /// The scene's picture; for a sequence, that of the last rendered frame.
  const Image& scene_colour() const { return pictures_.colour; }
  void list_state(state::Items& items) override;
  std::vector<PassOutput> buffers() override;
  std::vector<image_io::Layer> layers() const override;
  bool has_drops_layer() const override { return settings_.variant == Variant::corrected; }
  effect::DropsLayer drops_layer(const parallel::Executor& executor) const override;
  std::optional<effect::Display> display() const override;
  bool has_sequence() const { return sequence_.has_value(); }

 private:
  void show_pictures_of(int frame) override;

  std::optional<effect::PictureSource> sequence_;
  int shown_ = 0;  ///< frame whose picture is behind the glass
  int held_ = 0;   ///< frame whose picture is in memory; differs after a load
  Settings settings_;
  Inputs pictures_;
};

}  // namespace rainref::screen_drops
