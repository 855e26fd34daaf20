// The tracer: against the oracle that asks everything, and whether anything but the rays and the surfaces decides.
#include "base/error_of.h"
#include "compositor/embree_isas.h"
#include "compositor/tracer.h"

#include <gtest/gtest.h>

#include <set>

#include <fmt/format.h>

#include "base/hash.h"
#include "base/hostile_state.h"
#include "compositor/world.h"
#include "math/every_target.h"

namespace rainref::compositor {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

/// A whole world's rays, made once.
const std::vector<Ray>& every_kind_of_ray() {
  static const std::vector<Ray> all = [] {
    const test::World world;
    Tracer tracer;
    world.add_to(tracer);
    std::vector<Ray> rays = test::camera_rays(128, 72);
    const auto append = [&](const std::vector<Ray>& more) { rays.insert(rays.end(), more.begin(), more.end()); };
    append(test::reflection_rays(world, rays, test::first_hits(tracer, rays)));
    append(test::grazing_rays(128, 72));
    append(test::aimed_rays(world, 6001));
    // Limits, other lengths of the direction, far origins.
    for (std::size_t i = 0; i < 4000; ++i) {
      Ray ray = rays[i * 7];
      switch (i % 4) {
        case 0:
          ray.nearest = 20;
          break;
        case 1:
          ray.farthest = 25;
          break;
        case 2:
          ray.direction *= i % 8 < 4 ? 1e-6 : 1e6;
          break;
        default:
          ray.origin -= 1e5 * ray.direction;
      }
      rays.push_back(ray);
    }
    return rays;
  }();
  return all;
}
bool same(const Hit& a, const Hit& b) { return a.t == b.t && a.surface == b.surface && a.part == b.part && a.u == b.u && a.v == b.v; }
std::string text(const Hit& hit) { return fmt::format("{} on {}/{} at ({}, {})", hit.t, hit.surface, hit.part, hit.u, hit.v); }

void add(Hasher& hasher, std::span<const Hit> hits) {
  for (const Hit& hit : hits) {
    hasher.add(std::as_bytes(std::span(&hit.t, 1)));
    hasher.add(std::as_bytes(std::span(&hit.surface, 2)));
    hasher.add(std::as_bytes(std::span(&hit.u, 2)));
  }
}
/// Of first hits, in tasks of 500 rays.
std::string hash_of(const Tracer& tracer, const std::vector<Ray>& rays, int threads) {
  const parallel::Executor executor(threads);
  std::vector<Hit> hits(rays.size());
  executor.for_range(static_cast<std::int64_t>(rays.size()), 500, [&](std::int64_t begin, std::int64_t end) {
    const auto first = static_cast<std::size_t>(begin), count = static_cast<std::size_t>(end - begin);
    tracer.first_hits(std::span(rays).subspan(first, count), std::span(hits).subspan(first, count));
  });
  Hasher hasher;
  add(hasher, hits);
  return hasher.finish().text();
}

using test::embree_config;
using test::embree_isas;

TEST(Tracer, FindsWhatAskingEverySurfaceFinds) {
  const test::World world;
  const std::vector<Ray>& rays = every_kind_of_ray();
  Tracer tracer;
  world.add_to(tracer);
  const std::vector<Hit> hits = test::first_hits(tracer, rays);
  int met[3] = {};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit expected = first_hit_of_all(world.surfaces, rays[i]);
    ASSERT_TRUE(same(hits[i], expected)) << "ray " << i << ": " << text(hits[i]) << ", oracle " << text(expected);
    if (expected.is_surface()) ++met[expected.surface];
  }
  // Water, boxes and the pane all take part.
  EXPECT_GT(met[0], 15'000);
  EXPECT_GT(met[1], 2'000);
  EXPECT_GT(met[2], 20);
}

// Small plates as far out as the scene's L lets them be, met at their very borders by rays that start as far away as a ray may
// that floats take as it is, and a little further. What floats stray by there, the margin of the boxes must cover.
TEST(Tracer, BoxesCoverWhatFloatRaysStray) {
  constexpr double largest = 1024;
  std::vector<Plate> plates;
  const auto random = [](std::uint32_t k, std::uint32_t i) { return 2 * test::random_number(k, i) - 1; };
  for (std::uint32_t k = 0; k < 300; ++k) {
    Vec corner(0.999 * largest * random(k, 0), 0.999 * largest * random(k, 1), 0.999 * largest * random(k, 2)), sides[2] = {Vec(0), Vec(0)};
    const int across = static_cast<int>(k % 3);
    corner[across] = k % 2 ? 0.999 * largest : -0.999 * largest;
    sides[0][(across + 1) % 3] = sides[1][(across + 2) % 3] = 1e-3 * largest;
    plates.push_back({Plate::parallelogram, corner, sides[0], sides[1]});
  }
  const std::vector<std::shared_ptr<const Surface>> surfaces{std::make_shared<Plates>(plates)};
  std::vector<Ray> rays;
  for (std::uint32_t k = 0; k < 60'000; ++k) {
    const Plate& plate = plates[k % plates.size()];
    // Less than the plates' rounding within one of its four sides.
    const double along = test::random_number(k, 13), inside = k % 2 ? 1e-9 : 1 - 1e-9;
    const Vec target = plate.origin + (k % 4 < 2 ? along : inside) * plate.edge_u + (k % 4 < 2 ? inside : along) * plate.edge_v;
    // On the octahedron that bounds the origins, or nearly in the plate's plane: there, what it strays takes it past the plate.
    Vec origin(random(k, 10), random(k, 11), random(k, 12));
    origin *= (k % 5 == 0 ? 2.001 : 1.999) * largest / (std::abs(origin.x) + std::abs(origin.y) + std::abs(origin.z));
    if (k % 3 == 0) {
      const int across = static_cast<int>(k % plates.size() % 3);
      origin *= 0.4;
      origin[across] = plate.origin[across] + 1e-3 * random(k, 14);
    }
    rays.push_back({origin, glm::normalize(target - origin)});
  }
  for (const std::string& isa : embree_isas()) {
    for (const bool robust : {true, false}) {
      Tracer tracer({embree_config(isa), 16, robust});
      for (const auto& surface : surfaces) tracer.add(surface);
      tracer.commit();
      const std::vector<Hit> hits = test::first_hits(tracer, rays);
      int met = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit expected = first_hit_of_all(surfaces, rays[i]);
        ASSERT_TRUE(same(hits[i], expected)) << "ray " << i << ": " << text(hits[i]) << ", oracle " << text(expected) << isa
                                             << (robust ? ", robust" : "");
        met += expected.is_surface();
      }
      EXPECT_GT(met, 55'000);
    }
  }
}

TEST(Tracer, OneHashForEveryIsaWidthTraversalTileAndNumberOfThreads) {
  const std::vector<Ray>& rays = every_kind_of_ray();
  std::set<std::string> hashes;
  int runs = 0;
  for (const int tile : {512, 128, 64, 37}) {
    const test::World world(tile);
    for (const std::string& isa : embree_isas()) {
      for (const bool robust : {true, false}) {
        for (const int width : {1, 4, 8, 16}) {
          Tracer tracer({embree_config(isa), width, robust});
          world.add_to(tracer);
          hashes.insert(hash_of(tracer, rays, 1 + runs % 8));
          ASSERT_EQ(hashes.size(), 1u) << isa << ", width " << width << ", tiles of " << tile << (robust ? ", robust" : "");
          ++runs;
        }
      }
    }
  }
  RecordProperty("runs", runs);
}

TEST(Tracer, OneHashForEverySimdTarget) {
  const test::World world;
  std::set<std::string> hashes;
  test::for_every_target([&] {
    for (const std::string& isa : {embree_isas().front(), embree_isas().back()}) {
      Tracer tracer({embree_config(isa)});
      world.add_to(tracer);
      hashes.insert(hash_of(tracer, every_kind_of_ray(), 2));
      ASSERT_EQ(hashes.size(), 1u);
    }
  });
}

TEST(Tracer, PinsTheFloatingPointState) {
  const test::World world;
  Tracer expected;
  world.add_to(expected);
  const std::string hash = hash_of(expected, every_kind_of_ray(), 1);
  const test::KeepFloatingPoint keep;
  for (const test::HostileState& state : test::hostile_states()) {
    set_floating_point_control(state.control);
    Tracer tracer;
    world.add_to(tracer);
    std::vector<Hit> hits(every_kind_of_ray().size());
    tracer.first_hits(every_kind_of_ray(), hits);
    EXPECT_EQ(floating_point_control(), state.control) << state.name;
    set_floating_point_control(pinned_floating_point_control);
    EXPECT_EQ(hash_of(tracer, every_kind_of_ray(), 1), hash) << state.name;
    Hasher now, then;
    add(now, hits);
    add(then, test::first_hits(expected, every_kind_of_ray()));
    EXPECT_EQ(now.finish(), then.finish()) << state.name;
  }
}

TEST(Tracer, AnAlteredSurfaceIsSeenAfterCommit) {
  test::World world;
  Tracer tracer;
  world.add_to(tracer);
  const parallel::Executor executor(2);
  for (const double phase : {2.0, 5.0}) {
    // Waves that grow beyond every box of before.
    std::vector<float> heights = test::water_heights(phase);
    for (float& h : heights) h *= static_cast<float>(phase);
    world.water->assign(heights, executor);
    tracer.commit();
    Tracer fresh;
    world.add_to(fresh);
    EXPECT_EQ(hash_of(tracer, every_kind_of_ray(), 2), hash_of(fresh, every_kind_of_ray(), 2)) << phase;
  }
}

TEST(Tracer, WritesOnlyTheHitsThatItIsAskedFor) {
  const test::World world;
  const std::vector<Ray> rays(every_kind_of_ray().end() - 40, every_kind_of_ray().end());
  for (const std::string& isa : embree_isas()) {
    for (const int width : {1, 4, 8, 16}) {
      Tracer tracer({embree_config(isa), width});
      world.add_to(tracer);
      for (std::size_t count = 0; count <= 33; ++count) {
        std::vector<Hit> hits(40);
        tracer.first_hits(std::span(rays).first(count), std::span(hits).first(count));
        for (std::size_t i = count; i < hits.size(); ++i) ASSERT_TRUE(same(hits[i], Hit{})) << isa << " " << width << " " << count;
      }
    }
  }
}

TEST(Tracer, RaysInArraysMeetWhatRaysInARowMeet) {
  const test::World world;
  Tracer tracer;
  world.add_to(tracer);
  for (const std::size_t count : {std::size_t{1}, std::size_t{15}, std::size_t{16}, std::size_t{33}, every_kind_of_ray().size()}) {
    const std::vector<Ray> rays(every_kind_of_ray().end() - static_cast<std::ptrdiff_t>(count), every_kind_of_ray().end());
    std::vector<double> component[8];
    for (const Ray& ray : rays) {
      for (int k = 0; k < 3; ++k) {
        component[k].push_back(ray.origin[k]);
        component[3 + k].push_back(ray.direction[k]);
      }
      component[6].push_back(ray.nearest);
      component[7].push_back(ray.farthest);
    }
    const std::vector<Hit> expected = test::first_hits(tracer, rays);
    std::vector<Hit> hits(count);
    tracer.first_hits({{component[0].data(), component[1].data(), component[2].data()},
                       {component[3].data(), component[4].data(), component[5].data()},
                       component[6].data(),
                       component[7].data()},
                      hits);
    for (std::size_t i = 0; i < count; ++i) ASSERT_TRUE(same(hits[i], expected[i])) << i << " of " << count;
  }
}

TEST(Tracer, EqualDistancesGoToTheLowerNumber) {
  const auto square = [](const Vec& origin) { return Plate{Plate::parallelogram, origin, {1, 0, 0}, {0, 0, 1}}; };
  // Two surfaces with two plates each, all in one plane.
  std::vector<std::shared_ptr<const Surface>> surfaces;
  for (int k = 0; k < 2; ++k) surfaces.push_back(std::make_shared<Plates>(std::vector<Plate>{square({0, 0, 0}), square({-0.5, 0, 0})}));
  Tracer tracer;
  for (const auto& surface : surfaces) tracer.add(surface);
  tracer.commit();
  const std::vector<Hit> hits =
      test::first_hits(tracer, {{{0.25, 1, 0.5}, {0, -1, 0}}, {{-0.25, 1, 0.5}, {0, -1, 0}}, {{2, 1, 0.5}, {0, -1, 0}}});
  EXPECT_EQ(hits[0].surface, 0u);
  EXPECT_EQ(hits[0].part, 0u);
  EXPECT_EQ(hits[0].t, 1);
  EXPECT_EQ(hits[1].surface, 0u);
  EXPECT_EQ(hits[1].part, 1u);
  EXPECT_FALSE(hits[2].is_surface());
}

TEST(Tracer, LimitsBelongToTheRay) {
  Tracer tracer;
  tracer.add(std::make_shared<Plates>(std::vector<Plate>{{Plate::parallelogram, {-1, 0, -1}, {2, 0, 0}, {0, 0, 2}}}));
  tracer.commit();
  const Vec from{0, 1, 0}, down{0, -1, 0};
  const double above = std::nextafter(1.0, 2.0), below = std::nextafter(1.0, 0.0);
  const std::vector<Hit> hits =
      test::first_hits(tracer, {{from, down, 1, inf}, {from, down, above, inf}, {from, down, 0, 1}, {from, down, 0, below}});
  EXPECT_TRUE(hits[0].is_surface());
  EXPECT_FALSE(hits[1].is_surface());
  EXPECT_TRUE(hits[2].is_surface());
  EXPECT_FALSE(hits[3].is_surface());
}

TEST(Tracer, RaysOfAnyLengthFromAnywhereFindASmallThing) {
  // A plate of a millimetre, a kilometre from the origin of the axes.
  const Vec centre{1000, -300, 200};
  std::vector<std::shared_ptr<const Surface>> surfaces{
      std::make_shared<Plates>(std::vector<Plate>{{Plate::ellipse, centre, {5e-4, 0, 0}, {0, 0, 5e-4}}})};
  Tracer tracer;
  tracer.add(surfaces[0]);
  tracer.commit();
  std::vector<Ray> rays;
  for (const double distance : {1e-3, 1.0, 1e3, 1e6, 1e9}) {
    for (const double length : {1e-12, 1e-3, 1.0, 1e5, 1e15}) {
      const Vec direction = glm::normalize(Vec(0.3, -1, 0.2));
      rays.push_back({centre - distance * direction, length * direction});
      rays.push_back({centre - distance * direction, -length * direction});
    }
  }
  const std::vector<Hit> hits = test::first_hits(tracer, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(hits[i].is_surface(), i % 2 == 0) << i;
}

TEST(Tracer, ANothingAndRaysThatGoNowhere) {
  Tracer empty;
  empty.commit();
  EXPECT_FALSE(test::first_hits(empty, {{{0, 1, 0}, {0, -1, 0}}})[0].is_surface());
  const test::World world;
  Tracer tracer;
  world.add_to(tracer);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Hit& hit :
       test::first_hits(tracer, {{{0, 1, 0}, {0, 0, 0}}, {{0, nan, 0}, {0, -1, 0}}, {{0, 1, 0}, {nan, -1, 0}}, {{0, 1, 0}, {0, inf, 0}}}))
    EXPECT_FALSE(hit.is_surface());
}

TEST(Tracer, RefusesWhatEmbreeOrItselfDoesNotTake) {
  const auto message = [](const TracerOptions& options) { return error_of([&] { Tracer tracer(options); }); };
  EXPECT_EQ(message({"threads=1,isa=avx22"}),
            "2 compositor.embree_config = \"threads=1,isa=avx22\": no instruction set is called \"avx22\"; did you mean 'avx2'?");
  EXPECT_NE(message({"threads=many"}).find("does not take it"), std::string::npos);
  EXPECT_NE(message({"", 5}).find("width 5"), std::string::npos);
  EXPECT_EQ(message({"threads=1"}), "none");
}

}  // namespace
}  // namespace rainref::compositor
