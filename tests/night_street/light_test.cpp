// The street's light against physics: inverse squares and cosines, superposition, energy, mirrors.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/floating_point.h"
#include "math/simd_target.h"
#include "night_street/city.h"
#include "night_street/compact_lights.h"
#include "night_street/facade.h"
#include "night_street/light_map.h"
#include "night_street/sky.h"
#include "parallel/rows.h"

namespace rainref::night_street {
namespace {

constexpr double pi = 3.14159265358979;

/// A compact source that shines all round.
Source bare(const Vec& position, double intensity, double radius = 0.01) {
  return {position, Vec(intensity, 0.5 * intensity, 0.25 * intensity), Vec(0, 0, 0), 0, 0, radius, true};
}

// E = I cos / d^2 and radiance E / pi, at nodes of the map's grid. A source has 0.05 m^2 added to d^2, and a cosine divided by
// that distance: 1.5 * 0.05 / d^2 in all.
TEST(StreetLight, GroundGetsTheInverseSquareTimesTheCosine) {
  const FloatingPointGuard guard;
  for (const double height : {2.0, 4.0, 8.0, 16.0}) {
    const LightMap map({bare({1, height, 0}, 10)});
    for (const double x : {-7.0, -2.5, 1.0, 4.5}) {
      for (const double z : {-9.0, 0.0, 3.75}) {
        const double squared = (x - 1) * (x - 1) + height * height + z * z;
        const double expected = 10 / pi * height / (squared * std::sqrt(squared));
        EXPECT_NEAR(map.ground(x, z).x, expected, expected * 1.5 * 0.05 / squared) << height << ' ' << x << ' ' << z;
      }
    }
  }
}

TEST(StreetLight, FacadeThatFacesAwayGetsNone) {
  const FloatingPointGuard guard;
  const LightMap map({bare({plan::facade + 1, 4, 0}, 10)});  // behind the right building line
  EXPECT_GT(map.facade(0, 4, 0).x, 0);
  EXPECT_EQ(map.facade(1, 4, 0).x, 0);
  const double across = 2 * plan::facade + 1;  // straight from one line to the other
  EXPECT_NEAR(map.facade(0, 4, 0).x, 10 / pi / (across * across), 10 / pi / (across * across) * 1.5 * 0.05 / (across * across));
}

// A beam that is `gain` brighter on its axis: 1 + gain times the bare source below it, the bare source beside it.
TEST(StreetLight, ABeamIsBrighterOnItsAxisAlone) {
  const FloatingPointGuard guard;
  Source beam = bare({0, 5, 0}, 10);
  const LightMap plain({beam});
  beam.axis = {0, -1, 0};
  beam.gain = 3;
  beam.focus = 4;
  const LightMap map({beam});
  // The added 0.05 m^2 lengthen the distance, and the cosine to the axis falls short of 1 by half of it, 16 times over.
  EXPECT_NEAR(map.ground(0, 0).x / plain.ground(0, 0).x, 4, 3 * 16 * 0.5 * 0.05 / 25);
  EXPECT_NEAR(map.ground(8, 0).x / plain.ground(8, 0).x, 1, 0.01);  // cos^16 of 58 degrees is 4e-5
}

TEST(StreetLight, LightsAdd) {
  const FloatingPointGuard guard;
  const Source one = bare({-3, 6, 2}, 7), other = bare({4, 5, -3}, 2);
  const LightMap first({one}), second({other}), both({one, other});
  const CompactLights first_lights({one}), second_lights({other}), both_lights({one, other});
  const Vec view = unit(Vec(0.3, 0.8, 0.5));
  for (double z = -6; z <= 6; z += 1.3) {
    const double ground = first.ground(0.7, z).y + second.ground(0.7, z).y;
    EXPECT_NEAR(both.ground(0.7, z).y, ground, 1e-14 * ground);
    const Ray ray({0, 2, 12}, unit(Vec(0, 3, z - 12)));
    const double halo = first_lights.halo(ray, 50).y + second_lights.halo(ray, 50).y;
    EXPECT_NEAR(both_lights.halo(ray, 50).y, halo, 1e-6 * halo);  // floats, added in another order
    const Vec point(0.7, 0, z);
    const double highlight = first_lights.highlight(point, view, {0, 1, 0}, 0.2).y + second_lights.highlight(point, view, {0, 1, 0}, 0.2).y;
    EXPECT_NEAR(both_lights.highlight(point, view, {0, 1, 0}, 0.2).y, highlight, 1e-6 * highlight);
  }
}

/// What the sources within 45 m along the street give a point of the ground or of a building line, divided by pi, in the order of
/// operations that the map has.
Vec sum_at(const std::vector<Source>& sources, const Vec& point, const Vec& normal) {
  Vec sum;
  for (const Source& s : sources) {
    if (std::abs(s.position.z - point.z) >= 45) continue;
    const Vec towards = s.position - point;
    const double squared = dot(towards, towards) + 0.05, distance = std::sqrt(squared), facing = dot(towards, normal) / distance;
    if (facing <= 0) continue;
    double along = clamp01(-dot(towards, s.axis) / distance);
    for (int i = 0; i < s.focus; ++i) along *= along;
    sum = sum + (0.31830988618379067 * facing * (1 + s.gain * along) / squared) * s.intensity;
  }
  return sum;
}
TEST(StreetLight, EachTargetGivesTheBitsOfOnePointByItself) {
  const FloatingPointGuard guard;
  const City street(7, false);
  const std::string before = selected_simd_target();
  for (const std::string& target : simd_targets()) {
    select_simd_target(target);
    const LightMap map(street.sources);
    // Nodes of the grids, each point of some rows.
    for (const double z : {-300.0, -123.0, 0.0, 3.0, 252.0}) {
      for (int i = 0; i < 32; ++i) {
        const double x = -8 + i * 0.5, y = i;
        ASSERT_EQ(map.ground(x, z), sum_at(street.sources, {x, 0, z}, {0, 1, 0})) << target << ' ' << x << ' ' << z;
        ASSERT_EQ(map.facade(0, y, z), sum_at(street.sources, {-plan::facade, y, z}, {1, 0, 0})) << target << ' ' << y << ' ' << z;
        ASSERT_EQ(map.facade(1, y, z), sum_at(street.sources, {plan::facade, y, z}, {-1, 0, 0})) << target << ' ' << y << ' ' << z;
      }
    }
  }
  select_simd_target(before);
}

TEST(StreetLight, IsTheSameFromAnyThreads) {
  const FloatingPointGuard guard;
  const City street(7, false);
  const LightMap here(street.sources);
  for (const int threads : {2, 3, 8}) {
    parallel::Executor several(threads);
    several.shuffle_tiles(5);
    const LightMap map(street.sources, parallel::rows_of(several));
    for (double z = -299; z < 299; z += 0.7)
      for (double x = -7.5; x < 7.5; x += 1.1) {
        ASSERT_EQ(map.ground(x, z).x, here.ground(x, z).x) << threads << ' ' << x << ' ' << z;
        ASSERT_EQ(map.facade(x < 0, 8 + x, z).z, here.facade(x < 0, 8 + x, z).z) << threads << ' ' << x << ' ' << z;
      }
  }
}

// Sources of radiance 1 all round the sky: what the surface mirrors is at most what arrives, and seen from above, where
// Fresnel's share is 0.02, at most that. The tail that is cut leaves most of it.
TEST(StreetLight, AWetSurfaceMirrorsNoMoreThanArrives) {
  const FloatingPointGuard guard;
  constexpr double far = 1000;
  constexpr int rings = 200, around = 400;
  std::vector<Source> sky;
  for (int i = 0; i < rings; ++i) {
    const double elevation = 0.5 * pi * (i + 0.5) / rings, width = 0.5 * pi / rings * 2 * pi / around;
    for (int k = 0; k < around; ++k) {
      const double azimuth = 2 * pi * (k + 0.5) / around;
      const Vec towards(std::cos(elevation) * std::cos(azimuth), std::sin(elevation), std::cos(elevation) * std::sin(azimuth));
      sky.push_back(bare(far * towards, far * far * width * std::cos(elevation), 0.001));
    }
  }
  const CompactLights lights(sky);
  for (const double roughness : {0.1, 0.2, 0.3}) {
    const double above = lights.highlight({0, 0, 0}, {0, 1, 0}, {0, 1, 0}, roughness).x;
    EXPECT_LE(above, 0.02 * 1.02) << roughness;  // the grid of sources is exact to 1 % or so
    EXPECT_GE(above, 0.02 * 0.5) << roughness;
    for (const double elevation : {1.2, 0.6, 0.3, 0.15}) {
      const Vec view(std::cos(elevation), std::sin(elevation), 0);
      const double mirrored = lights.highlight({0, 0, 0}, view, {0, 1, 0}, roughness).x;
      EXPECT_LE(mirrored, 1) << roughness << ' ' << elevation;
      EXPECT_GE(mirrored, 0.5 * above) << roughness << ' ' << elevation;
    }
  }
}

// A lamp at height 6 and an eye at 1.5, 20 m apart, mirror each other 20 * 1.5 / 7.5 = 4 m from the eye.
TEST(StreetLight, AHighlightLiesWhereAMirrorWouldShowTheLamp) {
  const FloatingPointGuard guard;
  const Vec eye(0, 1.5, 0);
  const CompactLights lights({bare({0, 6, -20}, 10)});
  double best = 0, place = 0;
  for (double z = -0.5; z > -19.5; z -= 0.01) {
    const Vec point(0, 0, z);
    const double seen = lights.highlight(point, unit(eye - point), {0, 1, 0}, 0.035).x;
    if (seen > best) best = seen, place = z;
  }
  EXPECT_NEAR(place, -4, 0.1);  // the lobe is 0.035 wide, 0.15 m on the ground; Fresnel and the distances shift its top within that
  for (const double aside : {0.3, 1.0}) {  // and falls off to both sides alike
    const Vec left(-aside, 0, -4), right(aside, 0, -4);
    EXPECT_FLOAT_EQ(static_cast<float>(lights.highlight(left, unit(eye - left), {0, 1, 0}, 0.035).x),
                    static_cast<float>(lights.highlight(right, unit(eye - right), {0, 1, 0}, 0.035).x));
  }
}

TEST(StreetLight, AHaloSurroundsItsLampAndEndsWithTheRay) {
  const FloatingPointGuard guard;
  const CompactLights lights({bare({0, 5, -40}, 10)});
  const auto halo = [&](const Vec& towards, double farthest) { return lights.halo(Ray({0, 5, 0}, unit(towards)), farthest).x; };
  // As far beside the lamp in every direction, the same; farther, less; farther than 30 m, none.
  double last = 1e9;
  for (const double aside : {0.0, 0.5, 2.0, 8.0, 25.0}) {
    const double above = halo({0, aside, -40}, 400);
    EXPECT_NEAR(halo({aside, 0, -40}, 400), above, 1e-5 * above);
    EXPECT_NEAR(halo({-aside, 0, -40}, 400), above, 1e-5 * above);
    EXPECT_LT(above, last);
    EXPECT_GT(above, 0);
    last = above;
  }
  EXPECT_EQ(halo({80, 0, -40}, 400), 0);  // passes the lamp at 36 m
  EXPECT_EQ(halo({0, 0, 1}, 400), 0);     // looks away from it, 40 m off
  // A wall before the lamp hides the halo behind it.
  EXPECT_LT(halo({0, 0, -40}, 20), 0.1 * halo({0, 0, -40}, 400));
  EXPECT_EQ(halo({0, 0, -40}, 9), 0);
}

TEST(StreetLight, HazeHidesMoreWithDistanceAndNothingAtNone) {
  EXPECT_EQ(clear_share(0), 1);
  for (double distance = 1; distance < 1000; distance *= 1.5) {
    EXPECT_LT(clear_share(distance), clear_share(distance / 1.5));
    EXPECT_GT(clear_share(distance), 0);
  }
}

// The end of a ray in a box: on the wall that is named, inside the others, on the ray.
TEST(StreetLight, ALookIntoARoomEndsOnTheWallThatItNames) {
  const double width = 3, height = 2.5, depth = 4;
  int seen[4] = {};
  for (int i = 0; i < 24; ++i) {
    for (int k = 0; k < 24; ++k) {
      const double azimuth = pi * ((i + 0.5) / 24 - 0.5), elevation = pi * ((k + 0.5) / 24 - 0.5);
      const Vec into(std::sin(azimuth) * std::cos(elevation), std::sin(elevation), std::cos(azimuth) * std::cos(elevation));
      const double u = 0.3 + 0.1 * i, y = 0.2 + 0.09 * k;
      const RoomPoint end = look_into_room(u, y, into, width, height, depth);
      const Vec from_start = end.p - Vec(u, y, 0);
      EXPECT_NEAR(glm::length(from_start - glm::dot(from_start, into) * into), 0, 1e-12);
      EXPECT_GE(glm::dot(from_start, into), 0);
      for (const auto& [at, size] : {std::pair(end.p.x, width), std::pair(end.p.y, height), std::pair(end.p.z, depth)}) {
        EXPECT_GE(at, -1e-12);
        EXPECT_LE(at, size + 1e-12);
      }
      switch (end.surface) {
        case RoomPoint::back_wall:
          EXPECT_NEAR(end.p.z, depth, 1e-12);
          break;
        case RoomPoint::side_wall:
          EXPECT_NEAR(end.p.x, into.x > 0 ? width : 0, 1e-12);
          break;
        case RoomPoint::ceiling:
          EXPECT_NEAR(end.p.y, height, 1e-12);
          break;
        case RoomPoint::floor:
          EXPECT_NEAR(end.p.y, 0, 1e-12);
          break;
      }
      ++seen[static_cast<int>(end.surface)];
    }
  }
  for (const int count : seen) EXPECT_GT(count, 0);
}

// A view of one texel has no neighbours to be smoothed with: it is the ray through its centre, in floats, but for the last bits
// of a direction that the camera finds from two places.
TEST(StreetLight, AViewOfOneTexelIsItsRay) {
  const FloatingPointGuard guard;
  const Street street;
  const parallel::Executor executor(1);
  for (int k = 0; k < 60; ++k) {
    const scene::Vector3 direction = unit(Vec(std::sin(0.7 * k), 0.3 * std::sin(1.9 * k), std::cos(0.7 * k)));
    const scene::Vector3 eye{0.4, 1.3, -2.0 * k};
    const Street::View view = street.view({eye, eye + direction, {0, 1, 0}, 10}, 1, 1, 400, executor);
    const scene::Vector3 ray = street.look(eye, direction).radiance;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(view.colour.row<float>(0)[c], ray[c], 1e-5 * ray[c] + 1e-9) << k << " channel " << c;
  }
}

}  // namespace
}  // namespace rainref::night_street
