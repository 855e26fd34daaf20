// The water and the refraction of the corrected pass rain_on_glass, for comparison with traced light. Not a pass.
#pragma once

#include <array>

#include "image/texture.h"
#include "rainref/rainy_glass.h"
#include "rainy_glass/uniforms.h"
#include "scene/camera.h"

namespace rainref::rainy_glass {

/// The part of the scene behind the glass that a pixel of rain_on_glass shows.
struct Shown {
  bool is_behind;  ///< the pixel looks through the glass at something behind it
  bool is_wet;     ///< and the water there bends the ray
  double x, y;     ///< the shown point, on the image plane at distance 1
};

/// Evaluates the pass's text in double, on the buffers of the last rendered frame.
class ShownGlass {
 public:
  /// `surroundings` are those that `rendered` was made with; both must outlive this.
  ShownGlass(const Settings& settings, const Surroundings& surroundings, const RainyGlass& rendered);
  Shown at(int column, int row) const;
  /// Half size of the picture on the image plane at distance 1.
  std::array<double, 2> half_size() const { return {uniforms_.half_width, uniforms_.half_height}; }
  /// Slope of the water, up along u and v, at a position [m] on glass with this normal, in the coordinates of the pass.
  struct Slope {
    double u, v;
    bool is_wet;
  };
  Slope slope(double u, double v, const scene::Vector3& normal) const;

 private:
  const Surroundings& surroundings_;
  const RainyGlass& rendered_;
  RainOnGlassUniforms uniforms_;
  TextureData raindrops_, rivulets_, near_;
  int width_, height_;
};

}  // namespace rainref::rainy_glass
