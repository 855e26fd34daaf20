// The path of light that is refracted but never reflected at interfaces: the direction that a drop shows.
#pragma once

#include "compositor/scene.h"

namespace rainref::compositor {

struct StraightPath {
  enum class End : std::uint8_t {
    out,       ///< left the scene
    mirrored,  ///< hit an interface beyond the critical angle
    stopped,   ///< hit an opaque surface, or more than `most` interfaces
  } end = End::stopped;
  Vec origin{0, 0, 0}, direction{0, 0, 0};  ///< of the last ray; the direction is unit
  int interfaces = 0;                       ///< number passed
};

/// Follows the ray as `shade` follows its refracted rays.
StraightPath straight_path(const Scene& scene, const Ray& ray, int most = 16);

}  // namespace rainref::compositor
