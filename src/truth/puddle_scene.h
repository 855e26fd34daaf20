// The puddle as surfaces and media: the truth that its passes approximate.
#pragma once

#include <memory>

#include "compositor/picture.h"
#include "rainref/puddle.h"
#include "scene/scenery.h"
#include "truth/difference.h"
#include "truth/tracer_names.h"

namespace rainref::truth {

/// Water, bed and surroundings of a corrected puddle; y = 0 is the level of still water.
///
/// The water is a sheet through the heights at the cells' centres, level beyond the rectangle, its normals interpolated from central
/// differences. It lies over a bed at the depth that the passes use. Ground above the water is wet, with the passes' relief, gloss and
/// wetness. Ground is lit by the surroundings' ambient radiance through the water above it, as in shade. Everything else is traced: exact
/// hits of the water and the bed, reflections of water and shore, Fresnel's exact equations (without puddle.reflectivity, which has no
/// counterpart), and sharp reflections.
class PuddleScene {
 public:
  struct Options {
    TracerOptions tracer;
    std::shared_ptr<const scene::Scenery> street = nullptr;  ///< traced ray by ray instead of a picture of the surroundings
    int samples = 1;                                         ///< rays per pixel, for the mip level of the ground
  };
  /// Throws Error(usage) for as-published settings, which have no water in metres.
  PuddleScene(const puddle::Settings& settings, const puddle::Surroundings& surroundings, const Options& options,
              const parallel::Executor& executor);
  ~PuddleScene();
  PuddleScene(PuddleScene&&) noexcept;

  /// Copies the current water.
  void update(const puddle::Puddle& puddle, const parallel::Executor& executor);
  const Scene& scene() const;
  const scene::Camera& camera() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Errors of the march and of shade in one picture, at pixel centres. `puddle` has rendered the water that `traced` was updated with;
/// colours are compared with one ray per pixel.
///   pixels                     pixels, water_in_both; water_in_passes_only and water_in_truth_only: along the shore
///   hit_distance [m]           along the view ray, where both see water
///   normal_angle [deg], ground_offset [m]: there; how far the refracted rays' ends on the bed lie apart
///   colour, display            there: the channel that differs most, linear radiance, and code values of 255 of what is shown
///   ground_display             the same where the truth sees ground
///   schlick                    Schlick's reflectance minus Fresnel's at the true normal, where the truth sees water
Comparison compare(const puddle::Puddle& puddle, const puddle::Settings& settings, const PuddleScene& traced, const ShadingOptions& options,
                   const parallel::Executor& executor);

/// The puddle's display of a radiance (rgba16f): vignette, exposure, sRGB. rgba8.
Image display(const puddle::Settings& settings, const Image& radiance, const parallel::Executor& executor);

}  // namespace rainref::truth
