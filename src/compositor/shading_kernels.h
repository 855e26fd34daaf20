// What shading asks of many places at once, evaluated in lanes of doubles: the bits of the same formulas one by one.
#pragma once

#include <span>

#include "compositor/environments.h"
#include "compositor/puddle_ground.h"

namespace rainref::compositor {

/// exp(x) of each, in place.
void exponentials(std::span<double> x);

/// PictureEnvironment::radiance.
void look_up(const Texture& texture, bool is_cube, const Rotation& rotation, std::span<const Sight> sights, std::span<Vec> radiance);

/// The slopes of the ground under a place: of its unit normal n, n.x / n.y and n.z / n.y.
struct GroundSlope {
  double x, z;
};
/// PuddleGround::finish. slopes[i] is that of places[i]; where the ground is level, slopes is empty.
void finish_ground(const GroundLook& look, std::span<const Place> places, std::span<const GroundSlope> slopes, std::span<Finish> finishes);

}  // namespace rainref::compositor
