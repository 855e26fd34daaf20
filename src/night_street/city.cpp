#include "night_street/city.h"

#include "base/floating_point.h"
#include "math/constants.h"

namespace rainref::night_street {

City::City(std::uint64_t street_seed, bool clear_lane)
    : seed(street_seed),
      clouds(seed, Purpose::clouds),
      clouds_large(seed, Purpose::clouds_large),
      puddles(seed, Purpose::puddles),
      asphalt(seed, Purpose::asphalt),
      ripple(seed, Purpose::ripple),
      stain(seed, Purpose::stain),
      skyline(seed, Purpose::skyline) {
  build_lamps(*this);  // first: lamps() lists street lamps first
  build_signals(*this);
  build_cars(*this, clear_lane);
  build_walkers(*this);
  build_lots(*this);
  hierarchy = Hierarchy(solids);
  lights = CompactLights(sources);
}

const LightMap& City::light() const {
  std::call_once(lit_once_, [&] {
    const FloatingPointGuard guard;
    light_ = LightMap(sources);
    is_lit_ = true;
  });
  return light_;
}
void City::light_up(const Rows& rows) const {
  if (is_lit_) return;
  LightMap made(sources, rows);
  std::call_once(lit_once_, [&] {
    light_ = std::move(made);
    is_lit_ = true;
  });
}

int City::add_material(const Material& material) {
  materials.push_back(material);
  return static_cast<int>(materials.size()) - 1;
}

void City::add(Solid solid, int material) {
  solid.material = material;
  solids.push_back(solid);
}

void City::add_box(const Vec& low, const Vec& high, int material) {
  Solid solid;
  solid.shape = Solid::box;
  solid.a = low;
  solid.b = high;
  add(solid, material);
}

void City::add_pole(const Vec& foot, double radius, double height, int material) {
  Solid solid;
  solid.shape = Solid::pole;
  solid.a = foot;
  solid.b = {radius, height, 0};
  add(solid, material);
}

void City::add_convex(const std::vector<Plane>& sides, const Box& bounds, int material) {
  Solid solid;
  solid.shape = Solid::convex;
  solid.a = bounds.low;
  solid.b = bounds.high;
  solid.first_plane = static_cast<int>(planes.size());
  solid.plane_count = static_cast<int>(sides.size());
  planes.insert(planes.end(), sides.begin(), sides.end());
  add(solid, material);
}

void City::add_lamp(const Vec& centre, double radius, const Vec& radiance, const Vec& axis, double gain, int focus) {
  Solid solid;
  solid.shape = Solid::sphere;
  solid.a = centre;
  solid.b = {radius, 0, 0};
  add(solid, add_material({{}, radiance, 0, false}));
  sources.push_back({centre, (pi * radius * radius) * radiance, axis, gain, focus, radius, true});
  lamps.push_back({{centre.x, centre.y, centre.z},
                   {static_cast<float>(radiance.x), static_cast<float>(radiance.y), static_cast<float>(radiance.z)},
                   radius});
}

}  // namespace rainref::night_street
