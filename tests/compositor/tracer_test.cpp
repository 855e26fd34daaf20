// The tracer against the oracle that asks everything.
#include <gtest/gtest.h>

#include "compositor/world.h"
#include "math/every_target.h"

namespace rainref::compositor {
namespace {

std::vector<Ray> every_kind_of_ray(const test::World& world) {
  Tracer tracer;
  world.add_to(tracer);
  std::vector<Ray> rays = test::camera_rays(128, 72);
  const auto append = [&](const std::vector<Ray>& more) { rays.insert(rays.end(), more.begin(), more.end()); };
  append(test::reflection_rays(world, rays, test::first_hits(tracer, rays)));
  append(test::grazing_rays(128, 72));
  append(test::aimed_rays(world, 6000));
  return rays;
}
bool same(const Hit& a, const Hit& b) { return a.t == b.t && a.surface == b.surface && a.part == b.part && a.u == b.u && a.v == b.v; }

TEST(Tracer, FindsWhatAskingEverySurfaceFinds) {
  const test::World world;
  const std::vector<Ray> rays = every_kind_of_ray(world);
  Tracer tracer;
  world.add_to(tracer);
  const std::vector<Hit> hits = test::first_hits(tracer, rays);
  std::vector<std::uint8_t> blocked(rays.size());
  tracer.any_hits(rays, blocked);
  int met = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit expected = first_hit_of_all(world.surfaces, rays[i]);
    ASSERT_TRUE(same(hits[i], expected)) << "ray " << i << ": " << hits[i].t << " on " << hits[i].surface << "/" << hits[i].part << ", oracle " << expected.t << " on " << expected.surface << "/" << expected.part;
    ASSERT_EQ(blocked[i] != 0, expected.is_surface()) << "ray " << i;
    met += expected.is_surface();
  }
  EXPECT_GT(met, 20'000);
}

}  // namespace
}  // namespace rainref::compositor
