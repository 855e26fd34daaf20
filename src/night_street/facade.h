// Facades: windows with rooms behind them, shop fronts, walls. All procedural, on one plane per building.
#pragma once

#include "night_street/trace.h"
#include "night_street/vec.h"

namespace rainref::night_street {

struct Lot;

/// A point of the street-side face of a building, in the frame of a viewer facing it.
struct FacadePoint {
  double u;     ///< metres from the left edge
  double y;     ///< height, metres
  Vec into;     ///< unit view direction: x right, y up, z into the building (>= 0)
  Vec light;    ///< irradiance / pi
  double soft;  ///< [0, 1] fades fine detail (far away, or a rough reflection)
};

/// Radiance toward the viewer of a building hit at `point` by a ray in direction d from `distance` metres.
Vec building_radiance(const City& city, const Hit& hit, const Vec& point, const Vec& d, double soft);
/// The storeys above the shop.
Vec storey_radiance(const City& city, const Lot& lot, const FacadePoint& at);
/// The ground floor, y in [0, plan::ground_floor].
Vec shop_radiance(const City& city, const Lot& lot, const FacadePoint& at);
/// Reflection in dark glass: weak sky and lit street.
Vec glass_reflection(const FacadePoint& at);

/// The point where a ray from (u, y) on the front of a room (width x height x depth metres) ends inside.
struct RoomPoint {
  enum Surface : std::uint8_t { back_wall, side_wall, ceiling, floor } surface;
  Vec p;  ///< metres: x from the left wall, y from the floor, z from the front
};
RoomPoint look_into_room(double u, double y, const Vec& into, double width, double height, double depth);

}  // namespace rainref::night_street
