// Pictures of the street: one ray per texel, nine or three if neighbours differ.
#pragma once

#include <functional>

#include "night_street/night_street.h"
#include "night_street/shade.h"
#include "rainref/executor.h"
#include "rainref/image.h"

namespace rainref::night_street {

/// Every texel is cut into 3 x 3 parts; the ray of part (i, j), 0 <= i < 3 width, goes through the part's centre.
using RayOfPart = std::function<Ray(int i, int j)>;
/// Called once for each texel with its centre ray, from any thread.
using AtCentre = std::function<void(int x, int y, const Ray& ray, const Seen& seen)>;

/// Address rule of a picture at its left and right edge.
enum class Edge : std::uint8_t { clamp, wrap };

/// An rgba32f image of linear radiance, alpha 1. If a texel differs from a neighbour in object or in brightness, it is the mean of its 9
/// parts, or of the three on a diagonal; otherwise it is its centre. Nothing is clamped.
Image antialiased(const City& city, int width, int height, Edge edge, Parts parts, const RayOfPart& ray_of, const AtCentre& at_centre,
                  const parallel::Executor& executor);

}  // namespace rainref::night_street
