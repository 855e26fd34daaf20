// The scene point that composite shows at a pixel, to check its refraction. Not a pass.
#pragma once

#include "image/texture.h"
#include "rainref/windshield.h"
#include "windshield/parameters.h"

namespace rainref::windshield {

/// A pixel of composite.
struct Shown {
  bool is_on_glass;
  double visibility;  ///< of its drop: 0 none, 1 fully
  double x, y;        ///< scene point that a drop shows here, on the image plane at distance 1
};

/// Evaluates composite's text in double, on the textures of the last rendered frame.
class ShownScene {
 public:
  ShownScene(const Settings& settings, const Windshield& rendered);
  Shown at(int column, int row) const;

 private:
  CompositeUniforms uniforms_;
  bool corrected_;
  TextureData depth_, height_, normal_, mask_;
};

}  // namespace rainref::windshield
