// Plates and boxes: closed forms.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "compositor/boxes.h"
#include "compositor/packets.h"
#include "compositor/plates.h"
#include "compositor/world.h"
#include "math/every_target.h"
#include "rainref/error.h"

namespace rainref::compositor {
namespace {

Hit first_of(const Surface& surface, const Ray& ray) {
  Hit first;
  for (std::uint32_t i = 0; i < surface.primitives(); ++i) surface.meet(0, i, ray, first);
  return first;
}

TEST(Plates, ParallelogramAndEllipse) {
  const Plates plates({{Plate::parallelogram, {0, 0, 0}, {2, 0, 0}, {1, 0, 1}}, {Plate::ellipse, {10, 0, 0}, {0, 0, 2}, {1, 0, 0}}});
  const auto met = [&](double x, double z) { return first_of(plates, {{x, 3, z}, {0, -2, 0}}); };
  EXPECT_EQ(met(1.5, 0.5).t, 1.5);
  EXPECT_EQ(met(1.5, 0.5).u, 0.5);
  EXPECT_EQ(met(1.5, 0.5).v, 0.5);
  EXPECT_TRUE(met(0, 0).is_surface()) << "corners belong to it";
  EXPECT_FALSE(met(0.4, 0.5).is_surface());
  EXPECT_EQ(met(10, 1.9).part, 1u);
  EXPECT_FALSE(met(10.9, 1.9).is_surface());
  const Ray down{{10, 3, 0}, {0, -2, 0}};
  EXPECT_EQ(plates.normal(down, first_of(plates, down)), Vec(0, 1, 0)) << "z cross x is up";
  EXPECT_FALSE(first_of(plates, {{-5, 0, 0}, {1, 0, 0}}).is_surface()) << "edge-on";
  EXPECT_THROW(Plates({{Plate::parallelogram, {}, {1, 0, 0}, {2, 0, 0}}}), Error);
}

TEST(Boxes, ByRaysOfAnyLength) {
  const Boxes boxes({{{-1, -1, -1}, {1, 1, 1}}, {{5, -1, -1}, {7, 1, 1}}});
  for (const double length : {0.25, 1.0, 8.0}) {  // powers of two: exact
    const Ray along_x{{-3, 0.25, 0}, {length, 0, 0}}, along_y{{6, 4, 0.5}, {0, -length, 0}}, slanted{{-4, 0, 3}, {length, 0, -length}};
    EXPECT_EQ(first_of(boxes, along_x).t, 2 / length);
    EXPECT_EQ(first_of(boxes, along_x).part, 0u);
    EXPECT_EQ(boxes.normal(along_x, first_of(boxes, along_x)), Vec(-1, 0, 0));
    EXPECT_EQ(first_of(boxes, along_y).t, 3 / length);
    EXPECT_EQ(first_of(boxes, along_y).part, 1u);
    EXPECT_EQ(boxes.normal(along_y, first_of(boxes, along_y)), Vec(0, 1, 0));
    EXPECT_EQ(boxes.normal(slanted, first_of(boxes, slanted)), Vec(-1, 0, 0)) << "the face met last is the one entered";
  }
  EXPECT_FALSE(first_of(boxes, {{6, 0, 0}, {0, 1, 0}}).is_surface()) << "from inside";
  EXPECT_FALSE(first_of(boxes, {{6, 2, 0}, {1, 0, 0}}).is_surface());
}

// Rays along faces and edges, from inside, from borders, to corners, with limits at the hit, and beside a hit that is as near.
TEST(Surfaces, BoxesAndPlatesGiveLanesThePlainEvaluationsBits) {
  const Boxes boxes({{{-1, -0.5, 0}, {2, 1.5, 0.75}}});
  const Plates plates(
      {{Plate::parallelogram, {-1, 0.25, -1}, {2, 0, 0.5}, {0.25, 0.5, 2}}, {Plate::ellipse, {0, 0.5, 0}, {1, 0, 0}, {0, 0, 2}}});
  std::vector<Ray> rays;
  for (std::uint32_t k = 0; k < 16 * 1200; ++k) {
    const auto coordinate = [&](std::uint32_t c) {
      return k % 3 == 0 ? std::floor(17 * test::random_number(k, c) - 8) / 4 : 5 * test::random_number(k, c) - 2.5;
    };
    Ray ray{{coordinate(0), coordinate(1), coordinate(2)}, {coordinate(3), coordinate(4), coordinate(5)}};
    if (ray.direction == Vec(0, 0, 0) || k % 11 == 0) ray.direction = {k % 2 ? 1.0 : 1e-310, k % 5 ? 0.0 : -0.0, k % 2 ? 0.0 : -1.0};
    if (k % 7 == 0) ray.nearest = test::random_number(k, 6);
    if (k % 7 == 1) ray.farthest = 2 * test::random_number(k, 7);
    rays.push_back(ray);
  }
  const auto met = [&](const Surface& surface, std::uint32_t primitive) {
    return test::expect_packets_to_meet_as_rays(surface, 4, primitive, primitive + 1, rays, [&](std::size_t i) {
      // The same hit of a lower or a higher surface, or something nearer, or nothing.
      Hit own;
      surface.meet(4, primitive, rays[i], own);
      return own.is_surface() && i % 4 != 0 ? Hit{i % 4 == 3 ? 0.5 * own.t : own.t, i % 4 == 1 ? 3u : 5u, 0, 0.25, 0.5} : Hit();
    });
  };
  test::for_every_target([&] {
    EXPECT_GT(met(boxes, 0), 300);
    for (const std::uint32_t plate : {0u, 1u}) EXPECT_GT(met(plates, plate), 300) << plate;
  });
}

}  // namespace
}  // namespace rainref::compositor
