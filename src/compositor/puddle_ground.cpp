#include "compositor/puddle_ground.h"

#include <vector>

#include "compositor/shading_kernels.h"

namespace rainref::compositor {

namespace {

/// Room for the places of one call, kept by each thread for its next one.
struct Room {
  std::vector<Hit> dry;
  std::vector<Vec> normals;
  std::vector<GroundSlope> slopes;
};

}  // namespace

void PuddleGround::finish(std::span<const Place> places, std::span<Finish> finishes) const {
  static thread_local Room room;
  room.slopes.clear();
  if (sheet_) {
    // Under water the slope does not show.
    const auto is_wet = [](const Place& place) { return place.point.y < 0; };
    room.dry.clear();
    for (const Place& place : places) {
      if (!is_wet(place)) room.dry.push_back(place.hit);
    }
    room.normals.resize(room.dry.size());
    sheet_->smooth_normals(room.dry, room.normals);
    const Vec* normal = room.normals.data();
    for (const Place& place : places) {
      room.slopes.push_back(is_wet(place) ? GroundSlope{0, 0} : GroundSlope{normal->x / normal->y, normal->z / normal->y});
      if (!is_wet(place)) ++normal;
    }
  }
  finish_ground(look_, places, room.slopes, finishes);
}

}  // namespace rainref::compositor
