// A camera's view into a panorama: a scene for effects that look through glass, where a user brings a panorama.
#pragma once

#include "rainref/executor.h"
#include "rainref/image.h"
#include "scene/camera.h"

namespace rainref::scene {

/// What the camera sees of a latitude/longitude panorama of four channels, linear, whose row 0 looks straight down (-y) and whose
/// u = 1/2 + atan2(z, x) / 2 pi: rgba32f, alpha 1, row 0 = bottom. All of it is infinitely far, so the camera's position does
/// not count. One trilinear lookup a pixel, at the level where a texel is a pixel in the view's middle. Throws Error(usage) for
/// an image of other channels.
Image panorama_view(const Image& panorama, const Camera& camera, int width, int height, const parallel::Executor& executor);

}  // namespace rainref::scene
