#include "compositor/puddle_ground.h"

#include "compositor/shading_kernels.h"

namespace rainref::compositor {

void PuddleGround::finish(std::span<const Place> places, std::span<Finish> finishes) const {
  static thread_local std::vector<GroundSlope> slopes;
  slopes.clear();
  if (sheet_) {
    for (const Place& place : places) {
      // Under water the slope does not show.
      const Vec level = place.point.y < 0 ? Vec(0, 1, 0) : sheet_->smooth_normal(place.hit);
      slopes.push_back({level.x / level.y, level.z / level.y});
    }
  }
  finish_ground(look_, places, slopes, finishes);
}

}  // namespace rainref::compositor
