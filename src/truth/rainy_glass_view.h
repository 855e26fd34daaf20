// The pane of rainy_glass as rays see it: the eye, glass of real thickness, water whose slopes the maps give, a street or a
// picture with depths behind it, seen by a camera that focuses on the pane.
//
// The effect knows no height of its water, and none can be had: a slope that is masked, or mixed of two phases, is the gradient of
// no surface. So the truth here is a sheet too thin to matter, with these slopes: rays are met on the outer face and bent there,
// twice by Snell's law, with the normal of the slope at that very place.
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
  /// The street, and its picture without anything before the glass.
  struct Street {
    std::shared_ptr<const scene::Scenery> scenery;
    rainy_glass::Surroundings unbarred;
  };
  /// around: what the passes take, which must outlive the view; street: nothing where the scene comes in pictures, which `show` hands over.
  /// thickness [m]. Throws Error(usage) unless the settings are a corrected pane before the grabbed scene, and for glass that reaches to
  /// the eye.
  RainyGlassView(const rainy_glass::Settings& settings, const rainy_glass::Surroundings& around, std::optional<Street> street,
                 double thickness, const TracerOptions& tracer);

  /// The pictures that `around` has now, with what stands before the glass, where `surface` of the running effect says that it is, away.
  void show(const Image& surface);

  /// Surfaces and surroundings of the frame that was rendered last, committed. The view must outlive the scene.
  std::unique_ptr<Scene> scene(const rainy_glass::RainyGlass& rendered) const;

  scene::Camera camera() const { return camera_; }
  const Pane& pane() const { return pane_; }
  const rainy_glass::Settings& settings() const { return settings_; }
  const rainy_glass::Surroundings& surroundings() const { return *around_; }
  int width() const { return settings_.width; }
  int height() const { return settings_.height; }
  /// The picture that the effect's display makes of a radiance (rgba16f). rgba8.
  Image display(const Image& radiance, const parallel::Executor& executor) const;
  /// Of the pane's (u, v), as the passes know places on the glass [m].
  struct Spot {
    double u, v;
  };
  Spot spot(double u, double v) const { return {extent_.low.u + u * extent_.size.u, extent_.low.v + v * extent_.size.v}; }

  struct Extent {
    Spot low, size;
  };

  /// What a ray that left the glass comes to: from the eye toward the place where it meets the scene, and linear radiance. Of the street:
  /// where the eye sees that place, radiance is its picture's, out of focus as that is; elsewhere the street's own, sharp.
  struct Met {
    Vec from_eye, radiance;
  };
  /// direction: unit.
  Met met(const Vec& origin, const Vec& direction) const;

  /// What pass rain_on_glass makes of wet glass against what rays make of it; `rendered` has rendered a frame. Compared where the picture
  /// looks through the glass; a pixel is wet where both the pass and the ray through its centre find water there.
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
