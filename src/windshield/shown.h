// Where composite takes from what a pixel shows: for judging its refraction, not a pass.
#pragma once

#include "image/texture.h"
#include "rainref/windshield.h"
#include "windshield/parameters.h"

namespace rainref::windshield {

/// A pixel of composite.
struct Shown {
  bool is_on_glass;
  double visibility;  ///< of its drop: 0 none, 1 fully
  double x, y;        ///< the point of the scene that a drop shows here, on the image plane at distance 1
};

/// The double evaluation of composite's text, on the textures of the frame that was rendered last.
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
