// Cars that stand on wheels, people who walk on legs.
#include <algorithm>

#include <gtest/gtest.h>

#include "night_street/cars.h"
#include "night_street/city.h"
#include "night_street/trace.h"

namespace rainref::night_street {
namespace {

/// A car at the origin that faces +z, and nothing else.
struct LoneCar {
  City city{1, true};
  std::size_t first = city.solids.size();
  CarMaterials materials{city};
  int paint = static_cast<int>(city.materials.size());

  LoneCar() { add_car(city, materials, 0, 0, 1, {0.3, 0, 0}, false); }
  /// The first solid of it that the ray meets, or null.
  const Solid* met(const Ray& ray, SolidHit& hit) const {
    const Solid* nearest = nullptr;
    double farthest = 1e9;
    for (std::size_t i = first; i < city.solids.size(); ++i)
      if (intersect(city.solids[i], city.planes, ray, 1e-9, farthest, hit)) {
        farthest = hit.t;
        nearest = &city.solids[i];
      }
    return nearest;
  }
};

TEST(StreetFigures, WheelsStandOnTheRoadAndShowOnTheFlanks) {
  const LoneCar car;
  double lowest = 1;
  for (std::size_t i = car.first; i < car.city.solids.size(); ++i) lowest = std::min(lowest, car.city.solids[i].bounds().low.y);
  EXPECT_NEAR(lowest, 0, 1e-12);
  SolidHit hit;
  for (const double side : {-1.0, 1.0})
    for (const double axle : {1.33, -1.32}) {
      const auto seen = [&](double up, double along) {
        const Solid* s = car.met(Ray({5 * side, up, axle + along}, {-side, 0, 0}), hit);
        return s ? s->material : -1;
      };
      EXPECT_EQ(seen(0.315, 0), car.materials.rim) << "hub";
      EXPECT_EQ(seen(0.03, 0), car.materials.tyre);
      EXPECT_EQ(seen(0.315 + 0.27, 0), car.materials.tyre) << "in front of the flank";
      EXPECT_EQ(seen(0.69, 0), car.materials.arch);
      EXPECT_EQ(seen(0.80, 0), car.paint);
      EXPECT_EQ(seen(0.315, 0.6), car.paint);
      EXPECT_EQ(seen(0.10, 0.8), -1) << "one sees through below it";
    }
}
TEST(StreetFigures, WindowsLieBetweenRoofPillarsAndBelt) {
  const LoneCar car;
  const auto window = [&](const Vec& from, const Vec& towards) {
    SolidHit hit;
    const Ray ray(from, unit(towards));
    const Solid* s = car.met(ray, hit);
    EXPECT_NE(s, nullptr);
    const Vec p = ray.at(hit.t), middle = 0.5 * (s->a + s->b);
    return car.city.materials[static_cast<std::size_t>(s->material)].glass && in_window(p.x - middle.x, p.y, p.z - middle.z, hit.normal);
  };
  EXPECT_TRUE(window({0, 1.15, 5}, {0, 0, -1})) << "windscreen";
  EXPECT_TRUE(window({0, 1.15, -5}, {0, 0, 1})) << "rear window";
  EXPECT_TRUE(window({5, 1.15, 0.1}, {-1, 0, 0})) << "door";
  EXPECT_FALSE(window({5, 1.15, -0.39}, {-1, 0, 0})) << "pillar";
  EXPECT_FALSE(window({0, 5, -0.4}, {0, -1, 0})) << "roof";
  EXPECT_FALSE(window({0, 0.7, 5}, {0, 0, -1})) << "nose";
  EXPECT_FALSE(window({0.66, 1.15, 5}, {0, 0, -1})) << "beside the windscreen";
}

TEST(StreetFigures, PeopleHaveTwoLegsWithAirBetween) {
  const City city(1, true);
  int looked_at = 0;
  for (int i = 0; i < 26; ++i) {
    const auto id = static_cast<std::uint64_t>(3000 + i);
    const double side = i % 2 == 0 ? -1 : 1;
    const double x = side * (5.6 + 1.4 * city.random(id, Purpose::walker_place));
    const double z = -150 + 12 * i + 9 * city.random(id, Purpose::walker_stride);
    if (magnitude(z) < 3) continue;
    const double heading = city.random(id, Purpose::walker_heading) < 0.5 ? -1 : 1,
                 size = 0.93 + 0.12 * city.random(id, Purpose::walker_size);
    // Across the pavement, half a metre before this person.
    const auto is_hit = [&](double up, double forward) {
      const Hit hit = trace(city, Ray({x - 0.5 * side, plan::kerb_height + size * up, z + heading * size * forward}, {side, 0, 0}));
      return hit.kind == Hit::solid && hit.t < 1;
    };
    EXPECT_TRUE(is_hit(1.2, 0)) << "body of " << i;
    EXPECT_TRUE(is_hit(1.62, 0)) << "head";
    EXPECT_TRUE(is_hit(0.2, 0.235)) << "leg before";
    EXPECT_TRUE(is_hit(0.2, -0.19)) << "leg behind";
    EXPECT_FALSE(is_hit(0.2, 0.04)) << "between";
    EXPECT_FALSE(is_hit(1.62, 0.2)) << "before the face";
    ++looked_at;
  }
  EXPECT_GT(looked_at, 20);
}

}  // namespace
}  // namespace rainref::night_street
