// The window of screen_drops for rays: the eye, a pane of glass across the view, the caps and the flowing water of a frame, and the scene
// far behind, seen by a camera that focuses on the pane.
#pragma once

#include <memory>

#include "compositor/cap_water.h"
#include "compositor/picture.h"
#include "image/texture.h"
#include "rainref/screen_drops.h"
#include "truth/difference.h"
#include "truth/tracer_names.h"

namespace rainref::truth {

class ScreenDropsView {
 public:
  /// colour: the scene's picture, see Inputs::colour. thickness [m]. Throws Error(usage) for glass that reaches to the eye and for settings
  /// that are not corrected.
  ScreenDropsView(const screen_drops::Settings& settings, const Image& colour, double thickness, const TracerOptions& tracer,
                  const parallel::Executor& executor);

  /// Sets another picture of the scene.
  void show(const Image& colour);

  /// Surfaces and surroundings of the last rendered frame, committed. The view must outlive the scene, and the executor the view.
  std::unique_ptr<Scene> scene(const screen_drops::ScreenDrops& rendered) const;
  /// Only the water of that frame.
  std::shared_ptr<const CapWater> water(const screen_drops::ScreenDrops& rendered) const;

  /// Eye at the origin, axes of the effect's camera; the pane's outer face is at the position of the glass in the passes.
  scene::Camera camera() const { return camera_; }
  const Pane& pane() const { return pane_; }
  const screen_drops::Settings& settings() const { return settings_; }
  int width() const { return settings_.width; }
  int height() const { return settings_.height; }
  /// The effect's display of a radiance (rgba16f). rgba8.
  Image display(const Image& radiance, const parallel::Executor& executor) const;
  /// Linear radiance of light that comes from `direction`; 0 from the room behind the pane.
  Vec radiance(const Vec& direction) const;

  /// Compares pass drops with rays; `rendered` has rendered a frame. A pixel is a drop pixel if the pass shows at least half of it as
  /// water, and wet if the ray through its centre hits water.
  ///   pixels       pixels, drop_pixels, wet_pixels, drop_not_wet, wet_not_drop; mirrored_pixels and mirrored_in_pass: of those that are
  ///                both, where the ray, or the pass's, meets the water's surface beyond the critical angle
  ///   refraction [deg]       drop and wet, neither mirrored: between the directions in which the two see the scene
  ///   colour, colour_dry     linear radiance, the channel that differs most: drop and wet; neither
  ///   display                everywhere: code values of 255, the channel that differs most
  /// Refraction by the ray through the pixel's centre, colours by options.samples rays.
  Comparison compare(const screen_drops::ScreenDrops& rendered, const PictureOptions& options, const parallel::Executor& executor) const;

 private:
  screen_drops::Settings settings_;
  TracerOptions tracer_;
  const parallel::Executor& executor_;
  double border_;  // width of the pane around the picture [m], because drops overlap its edge
  scene::Camera camera_;
  scene::Camera::Basis basis_;
  Pane pane_;
  double scale_[2];  // from the image plane to texture coordinates
  TextureData scene_;
};

}  // namespace rainref::truth
