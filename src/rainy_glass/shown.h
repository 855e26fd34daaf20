// What the corrected pass rain_on_glass takes the water to be and to do: for judging it against traced light, not a pass.
#pragma once

#include <array>

#include "image/texture.h"
#include "rainref/rainy_glass.h"
#include "rainy_glass/uniforms.h"
#include "scene/camera.h"

namespace rainref::rainy_glass {

/// What a pixel of rain_on_glass shows of what lies behind the glass.
struct Shown {
  bool is_behind;  ///< the pixel looks through the glass at something behind it
  bool is_wet;     ///< and the water there bends the ray
  double x, y;     ///< the point that it shows, on the image plane at distance 1
};

/// The double evaluation of the pass's text, on the buffers of the frame that was rendered last.
class ShownGlass {
 public:
  /// `surroundings` are those that `rendered` was made with; they and it must outlive this.
  ShownGlass(const Settings& settings, const Surroundings& surroundings, const RainyGlass& rendered);
  Shown at(int column, int row) const;
  /// Of the image plane at distance 1.
  std::array<double, 2> half_size() const { return {uniforms_.half_width, uniforms_.half_height}; }
  /// Slope of the water, up along u and v, at a place of glass of this normal, as the pass knows places [m].
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
