// The windshield for rays: the driver's eye, a pane of glass, the water of a frame, the street at night behind it.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "compositor/pane_scene.h"
#include "compositor/picture.h"
#include "rainref/windshield.h"
#include "scene/scenery.h"
#include "truth/difference.h"
#include "truth/picture_relief.h"
#include "truth/tracer_names.h"
#include "windshield/parameters.h"

namespace rainref::truth {

struct WindshieldGlass {
  double thickness = 5e-3;  ///< [m]
  double radius = 0;        ///< of the bend across the car [m]; 0: flat
};

class WindshieldView {
 public:
  /// street: null if `show` sets pictures. Throws Error(usage) for an invalid pane.
  WindshieldView(const windshield::Settings& settings, const WindshieldGlass& glass, const TracerOptions& tracer,
                 std::shared_ptr<const scene::Scenery> street, const parallel::Executor& executor);

  /// Sets pictures that replace the street, as the windshield has them: scene_colour() and scene_depth().
  void show(const Image& colour, const Image& depth);

  /// Surfaces and surroundings of the last rendered frame, committed. The view must outlive the scene, and the executor the view.
  std::unique_ptr<Scene> scene(const windshield::Windshield& rendered) const;
  /// The same with these height textures [mm], of the windshield and of its further panes, with the car `distance` metres after its start.
  /// The rain `falling` behind the glass must outlive the scene.
  std::unique_ptr<Scene> scene(std::span<const Image* const> heights, double distance,
                               std::span<const windshield::FallingDropView> falling = {}) const;
  /// Position of that frame's car along the street [m].
  double distance(const windshield::Windshield& rendered) const;

  /// The windshield, and the car's further panes.
  const std::vector<Pane>& panes() const { return panes_; }
  /// The light from outside in the direction of a ray, without fog: from the pictures, or from the street for a car `distance` metres after
  /// its start. direction: unit. The sky has infinite distance.
  scene::Scenery::Sight look(double distance, const Vec& origin, const Vec& direction) const;
  scene::Camera camera() const { return windshield::camera(settings_.picture); }
  const windshield::Settings& settings() const { return settings_; }
  int width() const { return settings_.picture.width; }
  int height() const { return settings_.picture.height; }
  /// The windshield's display of a radiance (rgba16f). rgba8.
  Image display(const Image& radiance, const parallel::Executor& executor) const;

  /// Compares composite on a wet windshield with rays, on the glass; `rendered` has rendered a frame, whose pictures this view shows if it
  /// has no street. A pixel is a drop pixel if composite shows at least half of it as a drop, else a film pixel.
  ///   pixels                   glass_pixels, drop_pixels; mirrored_pixels: drops' whose ray meets the water's surface beyond the critical
  ///                            angle
  ///   refraction [deg]         drops: between the place outside that composite shows and the one that the refracted ray meets, as the
  ///                            eye sees them; not where the ray is mirrored
  ///   refraction_film [deg]    the same where there is neither drop nor water: what the pane alone does
  ///   colour, colour_film      linear radiance, the channel that differs most: drops, and the rest
  ///   display                  everywhere: code values of 255, the channel that differs most
  /// Refraction by the ray through the pixel's centre, colours by options.samples rays.
  Comparison compare(const windshield::Windshield& rendered, const PictureOptions& options, const parallel::Executor& executor) const;

 private:
  windshield::Settings settings_;
  TracerOptions tracer_;
  const parallel::Executor& executor_;
  std::vector<Pane> panes_;
  windshield::Vehicle vehicle_;
  std::shared_ptr<const scene::Scenery> street_;
  std::optional<PictureRelief> pictures_;
};

}  // namespace rainref::truth
