#include "truth/puddle_ground.h"

#include <algorithm>

#include "compositor/columns.h"

namespace rainref::truth {

void PuddleGround::finish(const Places& places, const Finishes& finishes) const {
  static thread_local Columns<3> room;
  // Under water the slope is not visible.
  const double* height = places.point.component[1];
  const bool has_slopes = sheet_ && std::any_of(height, height + places.size(), [](double y) { return y >= 0; });
  room.make_room(places.size());
  if (has_slopes) sheet_->smooth_normals(places.size(), places.hits, room.vectors(0));
  const VecArrays slopes = room.vectors(0);
  finish_ground(look_, places, has_slopes ? &slopes : nullptr, finishes);
}

}  // namespace rainref::truth
