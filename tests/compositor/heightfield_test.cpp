// The heightfield: closed forms and no cracks; heightfield_floats_test.cpp has its lanes.
#include "compositor/heightfield.h"

#include <gtest/gtest.h>

#include "compositor/world.h"
#include "math/every_target.h"
#include "rainref/error.h"

namespace rainref::compositor {
namespace {

const parallel::Executor& executor() {
  static const parallel::Executor one(2);
  return one;
}
std::shared_ptr<Heightfield> sheet(const HeightfieldFrame& frame, int columns, int rows, int tile, const auto& height) {
  auto field = std::make_shared<Heightfield>(frame, columns, rows, tile);
  std::vector<float> heights;
  for (int y = 0; y <= rows; ++y) {
    for (int x = 0; x <= columns; ++x) heights.push_back(static_cast<float>(height(x, y)));
  }
  field->assign(heights, executor());
  return field;
}
Hit first_of(const Heightfield& field, const Ray& ray) {
  Hit first;
  for (std::uint32_t i = 0; i < field.primitives(); ++i) field.meet(0, i, ray, first);
  return first;
}

TEST(Heightfield, APlaneIsMetWhereThePlaneIs) {
  // A plane through a sheared frame, tilted: h = 0.25 + x / 8 - y / 16, exact in floats.
  const HeightfieldFrame frame{{1, 2, 3}, {4, 0, 1}, {-1, 3, 0.5}, {0.25, -0.5, 2}};
  const auto field = sheet(frame, 16, 8, 5, [](int x, int y) { return 0.25 + x / 8.0 - y / 16.0; });
  const auto on_plane = [&](double x, double y) {
    return frame.origin + x / 16 * frame.edge_u + y / 8 * frame.edge_v + (0.25 + x / 8 - y / 16) * frame.axis;
  };
  const Vec a = on_plane(0, 0), n = glm::normalize(cross(on_plane(16, 0) - a, on_plane(0, 8) - a));
  for (std::uint32_t k = 0; k < 2000; ++k) {
    const double x = 16 * test::random_number(k, 0), y = 8 * test::random_number(k, 1);
    const Vec target = on_plane(x, y),
              from = target + 10.0 * glm::normalize(Vec(test::random_number(k, 2) - 0.5, test::random_number(k, 3) - 0.5,
                                                        test::random_number(k, 4) - 0.5));
    if (std::abs(dot(glm::normalize(target - from), n)) < 1e-3) continue;
    const Ray ray{from, (target - from) / 10.0};
    const Hit hit = first_of(*field, ray);
    ASSERT_TRUE(hit.is_surface()) << k;
    // A few roundings of coordinates near 10, over the angle.
    EXPECT_NEAR(hit.t, 10, 1e-11) << k;
    EXPECT_NEAR(field->place(hit).x, x, 1e-10);
    EXPECT_NEAR(field->place(hit).y, y, 1e-10);
    EXPECT_NEAR(std::abs(dot(field->normal(ray, hit), n)), 1, 1e-12);
    EXPECT_NEAR(dot(field->normal(ray, hit), field->smooth_normal(hit)), 1, 1e-12);
  }
  EXPECT_GT(dot(field->normal_of_slopes(0, 0), frame.axis), 0);
}

TEST(Heightfield, MissesBesideAndBehind) {
  const auto field = sheet({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, 4, 4, 4, [](int, int) { return 0; });
  EXPECT_TRUE(first_of(*field, {{0.5, 1, 0.5}, {0, -1, 0}}).is_surface());
  EXPECT_FALSE(first_of(*field, {{0.5, 1, 0.5}, {0, 1, 0}}).is_surface());
  EXPECT_FALSE(first_of(*field, {{1.5, 1, 0.5}, {0, -1, 0}}).is_surface());
  EXPECT_FALSE(first_of(*field, {{0.5, 1, 0.5}, {1, 0, 0}}).is_surface());
  EXPECT_TRUE(first_of(*field, {{0.5, -1, 0.5}, {0, 1, 0}}).is_surface()) << "from below";
  EXPECT_FALSE(first_of(*field, {{0.5, 1, 0.5}, {0, -1, 0}, 0, 0.5}).is_surface()) << "ends before";
  EXPECT_FALSE(first_of(*field, {{0.5, 1, 0.5}, {0, -1, 0}, 1.5}).is_surface()) << "begins behind";
}

TEST(Heightfield, ARoofIsMetAtItsFirstSide) {
  // Ridges along y, 1 high, 2 apart.
  const auto field = sheet({{0, 0, 0}, {8, 0, 0}, {0, 0, 8}, {0, 1, 0}}, 8, 8, 3, [](int x, int) { return x % 2; });
  const Ray ray{{-0.5, 0.5, 3.3}, {1, 0, 0}};
  const Hit hit = first_of(*field, ray);
  EXPECT_EQ(hit.t, 1);  // height 1/2 is at x = 1/2
  const Ray inside{{0.75, 0.5, 3.3}, {1, 0, 0}};
  EXPECT_EQ(first_of(*field, inside).t, 0.75) << "out of the other side";
}

// What no ray may do: pass the sheet where cells, triangles or tiles join. Aimed a little below a vertex, an edge or a
// diagonal from above, it must have met the sheet before it gets there.
TEST(Heightfield, AimedRaysNeverPass) {
  for (const int tile : {512, 64}) {
    const test::World world(tile);
    Tracer tracer;
    tracer.add(world.water);
    tracer.commit();
    std::vector<Ray> rays;
    for (std::uint32_t k = 0; k < 300'000; ++k) {
      const int i = 70 + static_cast<int>(test::random_number(k, 1) * 370), j = 70 + static_cast<int>(test::random_number(k, 2) * 370);
      const double f = k % 16 < 4 ? 0.5 : test::random_number(k, 3);
      const Vec a = test::vertex(world, i, j), x = test::vertex(world, i + 1, j), y = test::vertex(world, i, j + 1);
      const Vec aim = k % 4 == 0 ? a : k % 4 == 1 ? a + f * (x - a) : k % 4 == 2 ? a + f * (y - a) : x + f * (y - x);
      Vec direction{8 * test::random_number(k, 4) - 4, -1, 8 * test::random_number(k, 5) - 4};
      if (k % 5 == 0) direction = {k % 2 ? 3 : 0, -1, k % 3 ? -3 : 0};  // along lines and diagonals
      // 10^-9 is far above the rounding of these coordinates, and far below what a crack would be wide.
      rays.push_back({aim - Vec(0, 1e-9, 0) - 3.0 * direction, 3.0 * direction});
    }
    int passed = 0;
    for (const Hit& hit : test::first_hits(tracer, rays)) passed += !(hit.t <= 1);
    EXPECT_EQ(passed, 0) << "tiles of " << tile;
  }
}

TEST(Heightfield, NormalsOfSeveralHitsAreThoseOfEach) {
  const HeightfieldFrame sheared{{1, 2, 3}, {4, 0, 1}, {-1, 3, 0.5}, {0.25, -0.5, 2}};
  const auto field = sheet(sheared, 9, 7, 4,
                           [](int x, int y) { return test::random_number(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)); });
  // Every cell, those at the border too, at its corners and within.
  std::vector<Hit> all;
  for (std::uint32_t part = 0; part < 2 * 9 * 7; ++part) {
    for (std::uint32_t k = 0; k < 5; ++k)
      all.push_back({1, 0, part, k < 4 ? k % 2 : test::random_number(part, 1), k < 4 ? k / 2 : test::random_number(part, 2)});
  }
  test::for_every_target([&] {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{7}, all.size()}) {
      std::vector<Hit> hits(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
      if (count > 0) hits.resize(whole_lanes(count), hits.back());
      const std::vector<std::uint32_t> which(count);
      Columns<6> normals;
      normals.make_room(count);
      field->smooth_normals(count, hits.data(), normals.vectors(0));
      field->normals({}, which, hits.data(), normals.vectors(3));
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(normals.vectors(0)[i], field->smooth_normal(hits[i])) << i;
        ASSERT_EQ(normals.vectors(3)[i], field->normal({}, hits[i])) << i;
      }
    }
  });
}

TEST(Heightfield, SaysWhatItRefuses) {
  const HeightfieldFrame flat{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}};
  EXPECT_THROW(Heightfield(flat, 4, 4), Error);
  const HeightfieldFrame good{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  EXPECT_THROW(Heightfield(good, 0, 4), Error);
  EXPECT_THROW(Heightfield(good, 1 << 15, 1 << 15), Error);
  EXPECT_THROW(Heightfield(good, 4, 4, 0), Error);
  Heightfield field(good, 4, 4);
  EXPECT_THROW(field.assign(std::vector<float>(16), executor()), Error);
}

}  // namespace
}  // namespace rainref::compositor
