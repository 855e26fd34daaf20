// Our hits beside those of Embree's own robust triangles, for the same float rays: every difference has a reason.
#include "compositor/native.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <glm/vector_relational.hpp>

namespace rainref::compositor {
namespace {

struct Differences {
  int rays = 0, from_inside = 0, other_part = 0, their_cracks = 0, silhouettes = 0, unexplained = 0;
  double largest_dt = 0;
};

/// Whether a hit lies within `reach` cells of the border of its triangle.
bool on_border(const Hit& hit, double reach) {
  const double u = hit.u, v = hit.v, diagonal = std::abs(u + v - 1);
  return std::min({u, 1 - u, v, 1 - v, diagonal}) < reach;
}

/// Whether a shift of the ray by what floats cannot tell makes our answer theirs: a silhouette.
bool within_a_shift(const Tracer& tracer, const Ray& ray, const test::NativeHit& theirs) {
  for (const double size : {1e-5, 1e-4, 1e-3}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        Ray moved = ray;
        moved.origin[axis] += sign * size;
        const Hit hit = test::first_hits(tracer, {moved})[0];
        if (hit.is_surface() != theirs.is_surface()) continue;
        if (!hit.is_surface() || std::abs(hit.t - static_cast<double>(theirs.t)) < 0.05 * std::max(1.0, hit.t)) return true;
      }
    }
  }
  return false;
}

/// Quads are seen from inside a box, ours are not.
bool starts_inside(const test::World& world, const Ray& ray) {
  return std::any_of(world.boxes.begin(), world.boxes.end(), [&](const Box& box) {
    return glm::all(glm::greaterThanEqual(ray.origin, box.low)) && glm::all(glm::lessThanEqual(ray.origin, box.high));
  });
}

/// Whether their ray, shifted by what floats cannot tell, meets the water where ours did: it had slipped between triangles.
bool slipped_through(const test::NativeWorld& native, const Ray& ray, const Hit& ours) {
  std::vector<Ray> moved;
  for (int k = 0; k < 16; ++k) {
    moved.push_back(ray);
    const int axis = k / 2 % 3;
    moved.back().origin[axis] += (k % 2 ? 1 : -1) * (k < 6 ? 1e-5 : 1e-4);
  }
  test::NativeHit hits[16];
  native.trace(test::native_packets(moved), false, hits);
  return std::any_of(hits, hits + 16, [&](const test::NativeHit& hit) {
    return hit.is_surface() && std::abs(ours.t - static_cast<double>(hit.t)) < 1e-3 * ours.t;
  });
}

Differences compare(const test::World& world, const std::vector<Ray>& rays, bool coherent) {
  Tracer tracer;
  world.add_to(tracer);
  const test::NativeWorld native(world, "");
  const auto packets = test::native_packets(rays);
  std::vector<test::NativeHit> theirs(packets.size() * 16);
  native.trace(packets, coherent, theirs.data());
  const std::vector<Hit> ours = test::first_hits(tracer, rays);
  Differences d;
  d.rays = static_cast<int>(theirs.size());
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    if (!ours[i].is_surface() && !theirs[i].is_surface()) continue;
    // Their quads are geometry 1, ours are the surfaces 1 and 2.
    const bool same_thing = ours[i].is_surface() && theirs[i].is_surface() && (ours[i].surface == 0) == (theirs[i].geometry == 0);
    const double dt = same_thing ? std::abs(ours[i].t - static_cast<double>(theirs[i].t)) : 1e9;
    // A hit of a float triangle is off by some ulp of the coordinates, over the sine of the angle that the ray makes with it.
    const double slant =
        same_thing ? std::abs(dot(glm::normalize(rays[i].direction), tracer.surface(ours[i].surface).normal(rays[i], ours[i]))) : 0;
    if (same_thing && dt * glm::length(rays[i].direction) * slant < 1e-4) {
      d.largest_dt = std::max(d.largest_dt, dt);
      if (ours[i].surface != 0 || ours[i].part == theirs[i].primitive) continue;
      ++d.other_part;
      // Along the ray the two hits are dt apart, so another triangle must be that near; and floats tell an edge's sides to
      // some ulp of the distance, which slants across the water.
      const double length = glm::length(rays[i].direction), blurred = 0x1p-22 * ours[i].t * length / std::max(slant, 1e-3);
      if (!on_border(ours[i], 1e-4 + (dt * length + blurred) / test::water_cell)) ++d.unexplained;
    } else if (starts_inside(world, rays[i])) {
      ++d.from_inside;
    } else if (ours[i].is_surface() && ours[i].surface == 0 && on_border(ours[i], 1e-3) &&
               !(static_cast<double>(theirs[i].t) < ours[i].t) && slipped_through(native, rays[i], ours[i])) {
      ++d.their_cracks;
    } else if (within_a_shift(tracer, rays[i], theirs[i])) {
      ++d.silhouettes;
    } else {
      ++d.unexplained;
      if (d.unexplained < 5) {
        ADD_FAILURE() << fmt::format("ray {}: ours {} on {}/{}, theirs {} on {}/{}", i, ours[i].t, static_cast<int>(ours[i].surface),
                                     static_cast<int>(ours[i].part), theirs[i].t, static_cast<int>(theirs[i].geometry),
                                     static_cast<int>(theirs[i].primitive));
      }
    }
  }
  return d;
}

void report(const char* name, const Differences& d) {
  fmt::print(
      "{}: {} rays, {} from inside a box, {} on another triangle of the same edge, {} through their cracks, {} silhouettes, {} "
      "unexplained, |dt| <= {:.2g}\n",
      name, d.rays, d.from_inside, d.other_part, d.their_cracks, d.silhouettes, d.unexplained, d.largest_dt);
}

TEST(Native, EveryDifferenceFromEmbreesTrianglesHasAReason) {
  const test::World world;
  Tracer tracer;
  world.add_to(tracer);
  const std::vector<Ray> camera = test::camera_rays(640, 360);
  const Differences seen = compare(world, camera, true);
  report("camera", seen);
  EXPECT_EQ(seen.unexplained, 0);
  EXPECT_LT(seen.silhouettes, 12);
  const Differences grazing = compare(world, test::grazing_rays(640, 360), true);
  report("grazing", grazing);
  EXPECT_EQ(grazing.unexplained, 0);
  EXPECT_LT(grazing.silhouettes, 12);
  const Differences reflected = compare(world, test::reflection_rays(world, camera, test::first_hits(tracer, camera)), false);
  report("reflection", reflected);
  EXPECT_EQ(reflected.unexplained, 0);
  EXPECT_LT(reflected.silhouettes, 12);
}

TEST(Native, AimedRaysDifferInTheTriangleAndAtSilhouettes) {
  const test::World world;
  std::vector<Ray> rays = test::aimed_rays(world, 60'000);
  rays.resize(rays.size() / 16 * 16);
  const Differences aimed = compare(world, rays, false);
  report("aimed", aimed);
  EXPECT_EQ(aimed.unexplained, 0);
  EXPECT_GT(aimed.other_part, 1000) << "the rays are not aimed well";
}

}  // namespace
}  // namespace rainref::compositor
