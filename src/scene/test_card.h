// A place made by a few lines of exact arithmetic. It replaces the street for recorded bits that must not change with the street.
#pragma once

#include "scene/scenery.h"

namespace rainref::scene {

/// A road and two walls of coloured tiles, some of them bright, under a sky that grows darker upward. One ray per texel, through its
/// centre.
class TestCard final : public Scenery {
 public:
  /// Ignores the options.
  static std::shared_ptr<const Scenery> make(const SceneryOptions& options = {});

  std::string identity() const override { return "test card"; }
  const std::vector<Lamp>& lamps() const override { return lamps_; }
  Sight look(const Vector3& origin, const Vector3& direction) const override;
  Image panorama(int width, int height, const Vector3& eye, const parallel::Executor& executor) const override;
  View view(const Camera& camera, int width, int height, double far, const parallel::Executor& executor,
            Parts parts = Parts::nine) const override;

 private:
  std::vector<Lamp> lamps_{{{-4.5, 5, -12}, {9, 7, 4}, 0.25}, {{4.5, 5, -30}, {9, 7, 4}, 0.25}, {{1.8, 0.6, -18}, {6, 0.3, 0.2}, 0.1}};
};

}  // namespace rainref::scene
