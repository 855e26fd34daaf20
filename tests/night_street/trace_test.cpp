// The ray caster against slower ways to the same answer.
#include "night_street/trace.h"

#include <gtest/gtest.h>

#include "night_street/city.h"
#include "night_street/shade.h"

namespace rainref::night_street {
namespace {

const City& city() {
  static const City one(1, false);
  return one;
}

/// A ray from somewhere in the street in some direction.
Ray some_ray(std::uint64_t i) {
  const auto draw = [i](Purpose purpose) { return random01(99, i, purpose); };
  const Vec origin{14 * draw(Purpose::jitter) - 7, 0.2 + 6 * draw(Purpose::stain), 300 * draw(Purpose::ring) - 150};
  const Vec direction{2 * draw(Purpose::clouds) - 1, 0.6 * draw(Purpose::ripple) - 0.4, 2 * draw(Purpose::puddles) - 1};
  return Ray(origin, unit(direction));
}

TEST(NightStreetTrace, HierarchyFindsWhatASearchOfAllSolidsFinds) {
  int met = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Ray ray = some_ray(i);
    double nearest = 1e9;
    for (const Solid& solid : city().solids) {
      SolidHit hit;
      if (intersect(solid, city().planes, ray, 1e-9, nearest, hit)) nearest = hit.t;
    }
    double by_hierarchy = 1e9;
    city().hierarchy.walk(ray, by_hierarchy, [&](int index, double& limit) {
      SolidHit hit;
      if (intersect(city().solids[static_cast<std::size_t>(index)], city().planes, ray, 1e-9, limit, hit)) limit = hit.t;
    });
    ASSERT_EQ(by_hierarchy, nearest) << "ray " << i;
    met += nearest < 1e9;
  }
  EXPECT_GT(met, 1000);
}

TEST(NightStreetTrace, BuildingWalkFindsWhatASearchOfAllLotsFinds) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Ray ray = some_ray(i);
    const Hit hit = trace(city(), ray);
    for (int side = 0; side < 2; ++side) {
      for (const Lot& lot : city().lots[static_cast<std::size_t>(side)]) {
        const Box box{{side == 0 ? -plan::back : lot.front, 0, lot.z0}, {side == 0 ? -lot.front : plan::back, lot.height, lot.z1}};
        double t = 0;
        if (!crosses(box, ray, 1e9, t) || t <= 0) continue;
        ASSERT_TRUE(hit.is_surface() && hit.t <= t) << "ray " << i << " passes a building of side " << side;
      }
    }
  }
}

TEST(NightStreetTrace, HitsLieOnTheirSolidsAndFaceTheRay) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Ray ray = some_ray(i);
    const Hit hit = trace(city(), ray);
    if (!hit.is_surface()) continue;
    ASSERT_GT(hit.t, 0);
    ASSERT_LT(dot(hit.normal, ray.direction), 1e-9) << "ray " << i;
    ASSERT_NEAR(dot(hit.normal, hit.normal), 1, 1e-12);
    if (hit.kind != Hit::solid) continue;
    const Solid& solid = city().solids[static_cast<std::size_t>(hit.index)];
    if (solid.shape == Solid::sphere) {
      ASSERT_NEAR(length(ray.at(hit.t) - solid.a), solid.b.x, 1e-9);
    }
  }
}

TEST(NightStreetTrace, RayThatStartsAnywhereHasASoundRadiance) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    Ray ray = some_ray(i);
    if (i % 4 == 0) ray = Ray(20.0 * ray.origin, ray.direction);             // far outside, or in a house
    if (i % 4 == 1) ray = Ray(ray.origin, {0, 0, i % 8 == 1 ? 1.0 : -1.0});  // along an axis
    if (i % 4 == 2) ray = Ray(ray.origin, {0, i % 8 == 2 ? 1.0 : -1.0, 0});
    const Vec radiance = look(city(), ray).radiance;
    ASSERT_TRUE(radiance.x >= 0 && radiance.y >= 0 && radiance.z >= 0 && radiance.x < 1e4 && radiance.y < 1e4 && radiance.z < 1e4)
        << "ray " << i << ": " << radiance.x << ' ' << radiance.y << ' ' << radiance.z;
  }
}

TEST(NightStreetTrace, EveryLotFitsItsPlan) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const City other(seed, false);
    for (const std::vector<Lot>& row : other.lots) {
      for (std::size_t i = 0; i < row.size(); ++i) {
        ASSERT_LT(row[i].height, plan::tallest) << "seed " << seed;
        ASSERT_GE(row[i].front, plan::facade);
        ASSERT_GE(row[i].bays, 1);
        if (i > 0) {
          ASSERT_EQ(row[i].z0, row[i - 1].z1);
        }
      }
    }
  }
}

}  // namespace
}  // namespace rainref::night_street
