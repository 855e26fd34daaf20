// A camera's view into a panorama, for effects that look through glass and users who have a panorama.
#pragma once

#include "rainref/executor.h"
#include "rainref/image.h"
#include "scene/camera.h"

namespace rainref::scene {

/// The camera's view of a latitude/longitude panorama of four channels, linear, whose row 0 looks straight down (-y) and whose u = 1/2 +
/// atan2(z, x) / 2 pi. Result: rgba32f, alpha 1, row 0 = bottom. The panorama is infinitely far away, so the camera's position does not
/// matter. One trilinear lookup per pixel, at the level where a texel has the size of a pixel in the centre of the view. Throws
/// Error(usage) for an image with other channels.
Image panorama_view(const Image& panorama, const Camera& camera, int width, int height, const parallel::Executor& executor);

}  // namespace rainref::scene
