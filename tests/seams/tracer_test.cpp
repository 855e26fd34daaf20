// The tracer without Embree: this program is linked with src/compositor/tracer_bvh.cpp in place of Embree's.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include <glm/geometric.hpp>

#include "compositor/world.h"
#include "rainref/error.h"

namespace rainref::compositor {
namespace {

bool same(const Hit& a, const Hit& b) {
  return (a.t == b.t || (a.t != a.t && b.t != b.t)) && a.surface == b.surface && a.part == b.part && a.u == b.u && a.v == b.v;
}

/// From everywhere to everywhere, some along the axes, some that end early or begin late.
std::vector<Ray> rays() {
  std::vector<Ray> all;
  const auto random = [](std::uint32_t k, std::uint32_t i) { return 2 * test::random_number(k, i) - 1; };
  for (std::uint32_t k = 0; k < 20'000; ++k) {
    Ray ray{{60 * random(k, 20), 20 * random(k, 21), 60 * random(k, 22)}, glm::normalize(Vec(random(k, 23), random(k, 24), random(k, 25)))};
    if (k % 7 == 0) ray.direction = Vec(k % 3 == 0, k % 3 == 1, k % 3 == 2) * (k % 2 ? 1.0 : -1.0);
    if (k % 5 == 0) ray.farthest = 30 * test::random_number(k, 26);
    if (k % 11 == 0) ray.nearest = 20 * test::random_number(k, 27);
    all.push_back(ray);
  }
  return all;
}

TEST(TracerWithoutEmbree, FindsWhatAskingEverySurfaceFinds) {
  test::World world;
  Tracer tracer;
  world.add_to(tracer);
  const std::vector<Ray> asked = rays();
  for (const double phase : {1.0, 2.5}) {  // the second time the tree is stale unless commit takes notice
    world.water->assign(test::water_heights(phase), parallel::Executor());
    tracer.commit();
    std::vector<Hit> hits(asked.size());
    tracer.first_hits(asked, hits);
    int met[3] = {};
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const Hit expected = first_hit_of_all(world.surfaces, asked[i]);
      ASSERT_TRUE(same(hits[i], expected)) << "ray " << i;
      if (expected.is_surface()) ++met[expected.surface];
    }
    EXPECT_GT(met[0], 1000);
    EXPECT_GT(met[1], 1000);
  }
}

// Met at their very borders from far away, where what is rounded is largest.
TEST(TracerWithoutEmbree, BoxesCoverWhatIsRounded) {
  const auto random = [](std::uint32_t k, std::uint32_t i) { return 2 * test::random_number(k, i) - 1; };
  std::vector<Plate> plates;
  for (std::uint32_t k = 0; k < 300; ++k) {
    Vec sides[2] = {Vec(0), Vec(0)};
    sides[0][(k + 1) % 3] = sides[1][(k + 2) % 3] = 1;
    plates.push_back({Plate::parallelogram, {1000 * random(k, 0), 1000 * random(k, 1), 1000 * random(k, 2)}, sides[0], sides[1]});
  }
  const std::vector<std::shared_ptr<const Surface>> surfaces{std::make_shared<Plates>(plates)};
  Tracer tracer;
  tracer.add(surfaces[0]);
  tracer.commit();
  std::vector<Ray> asked;
  for (std::uint32_t k = 0; k < 20'000; ++k) {
    const Plate& plate = plates[k % plates.size()];
    const double along = test::random_number(k, 13);
    const Vec target = plate.origin + (k % 2 ? along : 0.0) * plate.edge_u + (k % 2 ? 1.0 : along) * plate.edge_v;
    const Vec origin(1e5 * random(k, 10), 1e5 * random(k, 11), 1e5 * random(k, 12));
    asked.push_back({origin, target - origin});
  }
  std::vector<Hit> hits(asked.size());
  tracer.first_hits(asked, hits);
  int met = 0;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const Hit expected = first_hit_of_all(surfaces, asked[i]);
    ASSERT_TRUE(same(hits[i], expected)) << "ray " << i;
    met += expected.is_surface();
  }
  EXPECT_GT(met, 2000);
}

TEST(TracerWithoutEmbree, NothingIsHitInAnEmptyScene) {
  Tracer tracer;
  tracer.commit();
  const Ray ray{{0, 0, 0}, {0, 0, 1}};
  Hit hit;
  tracer.first_hits({&ray, 1}, {&hit, 1});
  EXPECT_FALSE(hit.is_surface());
}

TEST(TracerWithoutEmbree, RefusesWhatIsNotItsOwn) {
  EXPECT_THROW(Tracer({"isa=sse2", 16, true}), Error);
  EXPECT_THROW(Tracer({"", 3, true}), Error);
}

}  // namespace
}  // namespace rainref::compositor
