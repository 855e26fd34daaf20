#pragma once

#include "compositor/float_rays.h"

namespace rainref::compositor {

/// Rewrites a slot for a ray that floats cannot represent accurately enough as it is.
void put_extraordinary_ray(const Ray& ray, const SceneExtent& extent, int slot, FloatPacket& out);

}  // namespace rainref::compositor
