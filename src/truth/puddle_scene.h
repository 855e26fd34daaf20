// The puddle as surfaces and media: the truth that its passes approximate.
#pragma once

#include <memory>

#include "compositor/picture.h"
#include "rainref/puddle.h"
#include "scene/scenery.h"
#include "truth/tracer_names.h"

namespace rainref::truth {

/// Water, bed and surroundings of a corrected puddle, y = 0 the level of still water.
///
/// The water is a sheet through the heights at the cells' centres, level beyond the rectangle, its normals interpolated
/// from central differences. It lies over a bed at the depth that the passes use: what stands out of the water is wet
/// ground, with the passes' relief, gloss and wetness. Ground is lit by the surroundings' ambient radiance through the water above
/// it, as in shade. Everything else is traced: where rays really meet the water and the bed, mirrored water and shore,
/// Fresnel's exact equations (without puddle.reflectivity, which has no counterpart), and sharp reflections.
class PuddleScene {
 public:
  struct Options {
    TracerOptions tracer;
    std::shared_ptr<const scene::Scenery> street = nullptr;  ///< the surroundings, ray by ray, in place of a picture of them
    int samples = 1;                                         ///< rays of a pixel, for the mip level of the ground
  };
  /// Throws Error(usage) for as-published settings, which have no water in metres.
  PuddleScene(const puddle::Settings& settings, const puddle::Surroundings& surroundings, const Options& options,
              const parallel::Executor& executor);
  ~PuddleScene();
  PuddleScene(PuddleScene&&) noexcept;

  /// Takes over the water of this moment.
  void update(const puddle::Puddle& puddle, const parallel::Executor& executor);
  const Scene& scene() const;
  const scene::Camera& camera() const;
  /// Numbers of the water's sheet and of the bed in the scene.
  static constexpr std::uint32_t water_surface = 0, bed_surface = 1;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rainref::truth
