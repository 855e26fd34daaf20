// A mine track over an abyss in fog: rails, ledges, wires and posts, ray-traced, with colour and depth. It shows the effect without any
// asset.
//
// World: right-handed, y up, metres; the track runs from the eye's feet along -z. Only + - * / sqrt, comparisons and the library's own
// exponential, in double: the same bits on every machine.
#pragma once

#include "rainref/executor.h"
#include "rainref/image.h"
#include "scene/camera.h"

namespace rainref::edge_splash {

struct ShapesView {
  Image colour;  ///< rgba32f, linear radiance, alpha 1, antialiased; row 0 = bottom
  Image depth;   ///< r32f, metres along the view axis at the texel's centre; `far` if nothing is hit
};
ShapesView render_shapes(const scene::Camera& camera, int width, int height, double far, const parallel::Executor& executor);

}  // namespace rainref::edge_splash
