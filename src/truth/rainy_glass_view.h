// The pane of rainy_glass for rays: the eye, glass of real thickness, water whose slopes the maps give, a street or a picture with depths
// behind it, seen by a camera that focuses on the pane.
//
// The effect has no height of its water, and none can be derived: a slope that is masked, or mixed from two phases, is not the gradient of
// a surface. So the truth is an infinitely thin sheet with these slopes. Rays hit the outer face and are refracted there twice by Snell's
// law, with the normal of the slope at that point.
#pragma once

#include <memory>
#include <optional>

#include "compositor/pane_scene.h"
#include "compositor/picture.h"
#include "image/texture.h"
#include "rainref/rainy_glass.h"
#include "rainy_glass/shown.h"
#include "scene/scenery.h"
#include "truth/difference.h"
#include "truth/picture_relief.h"
#include "truth/tracer_names.h"

namespace rainref::truth {

class RainyGlassView {
 public:
  /// The street, and its picture without objects before the glass.
  struct Street {
    std::shared_ptr<const scene::Scenery> scenery;
    rainy_glass::Surroundings unbarred;
  };
  /// around: inputs of the passes, which must outlive the view; street: none if the scene comes in pictures, which `show` sets. thickness
  /// [m]. Throws Error(usage) unless the settings are a corrected pane before the grabbed scene, and for glass that reaches to the eye.
  RainyGlassView(const rainy_glass::Settings& settings, const rainy_glass::Surroundings& around, std::optional<Street> street,
                 double thickness, const TracerOptions& tracer);

  /// Sets the current pictures of `around`, and removes objects that are before the glass according to `surface` of the running effect.
  void show(const Image& surface);

  /// Surfaces and surroundings of the last rendered frame, committed. The view must outlive the scene.
  std::unique_ptr<Scene> scene(const rainy_glass::RainyGlass& rendered) const;

  scene::Camera camera() const { return camera_; }
  const Pane& pane() const { return pane_; }
  const rainy_glass::Settings& settings() const { return settings_; }
  const rainy_glass::Surroundings& surroundings() const { return *around_; }
  int width() const { return settings_.width; }
  int height() const { return settings_.height; }
  /// The effect's display of a radiance (rgba16f). rgba8.
  Image display(const Image& radiance, const parallel::Executor& executor) const;
  /// Position on the glass [m] for the pane's (u, v), in the coordinates of the passes.
  struct Spot {
    double u, v;
  };
  Spot spot(double u, double v) const { return {extent_.low.u + u * extent_.size.u, extent_.low.v + v * extent_.size.v}; }

  struct Extent {
    Spot low, size;
  };

  /// Result of a ray that left the glass: the direction from the eye to the point where it hits the scene, and linear radiance. For a
  /// street: if the eye sees that point, radiance is that of its picture, which is out of focus; elsewhere it is the street's own, sharp.
  struct Met {
    Vec from_eye, radiance;
  };
  /// direction: unit.
  Met met(const Vec& origin, const Vec& direction) const;

  /// Compares pass rain_on_glass on wet glass with rays; `rendered` has rendered a frame. Only pixels behind the glass are compared; a
  /// pixel is wet if both the pass and the ray through its centre find water there.
  ///   pixels       pixels; glass_pixels; wet_pixels, wet_in_pass_only, wet_in_truth_only; mirrored_pixels: wet ones whose ray meets the
  ///                water's surface beyond the critical angle
  ///   refraction [deg]        wet, not mirrored: between the place in the street that the pass shows and the one that the refracted
  ///                           ray meets, as the eye sees them
  ///   bend [deg]              there: how much further from the view ray the pass's place lies than the ray's
  ///   colour, colour_dry      linear radiance, the channel that differs most: wet; neither wet
  ///   display                 on the glass: code values of 255, the channel that differs most
  /// Refraction by the ray through the pixel's centre, colours by options.samples rays.
  Comparison compare(const rainy_glass::RainyGlass& rendered, const PictureOptions& options, const parallel::Executor& executor) const;

 private:
  rainy_glass::Settings settings_;
  const rainy_glass::Surroundings* around_;
  TracerOptions tracer_;
  scene::Camera camera_;
  scene::Camera::Basis basis_;
  double half_width_, half_height_;
  Extent extent_;  // of the pane on the glass
  Pane pane_;
  std::optional<Street> street_;
  TextureData colour_;
  std::optional<PictureRelief> pictures_;
};

}  // namespace rainref::truth
