// A flat sheet of water over level ground, a pane and a ball: Snell, Fresnel and Beer, from their laws.
#include <gtest/gtest.h>

#include "compositor/interface.h"
#include "compositor/shading_support.h"

namespace rainref::compositor::testing {
namespace {

constexpr double water_ior = 1.333, depth = 0.25;

Scene sheet(const Medium& inside, std::shared_ptr<const Opaque> ground, std::shared_ptr<const Environment> around) {
  Scene scene;
  scene.add(std::make_shared<Level>(0), Material::interface_of(air(), inside));
  scene.add(std::make_shared<Level>(-depth), Material::of(std::move(ground)));
  scene.set_environment(std::move(around));
  scene.commit();
  return scene;
}

// What a pixel sees of light 1 from the ground with no light from above, or the other way round, is a series: the ground
// is seen through the surface, 1 - F, because an opaque ground that mirrors nothing ends a path.
TEST(FlatWater, FresnelSharesAtEveryAngle) {
  for (const double degrees : {0.0, 30.0, 60.0, 75.0, 85.0, 89.0}) {
    const double f = fresnel(radians(degrees), water_ior);
    ShadingOptions all;
    all.least_weight = 0;
    const double reflected = see(sheet(water(water_ior), emitter({0, 0, 0}), constant({1, 1, 1})), slanting(degrees), all).radiance.x;
    const double through = see(sheet(water(water_ior), emitter({1, 1, 1}), constant({0, 0, 0})), slanting(degrees), all).radiance.x;
    // The roundings of the sine laws near 0 and 90 degrees and of the product's own form.
    EXPECT_NEAR(reflected, f, 1e-14) << degrees;
    EXPECT_NEAR(through, 1 - f, 1e-14) << degrees;
  }
}
TEST(FlatWater, FresnelAsTabulated) {
  // physics P9: exact reflectances of n = 1.333, five digits.
  const double table[][2] = {{0, .0203732}, {30, .021436}, {45, .027898}, {60, .059691},
                             {70, .133475}, {75, .212378}, {80, .347917}, {85, .583523}};
  for (const auto& [degrees, exact] : table) {
    const double reflected = see(sheet(water(water_ior), emitter({0, 0, 0}), constant({1, 1, 1})), slanting(degrees)).radiance.x;
    EXPECT_NEAR(reflected, exact, 6e-7) << degrees;  // the table's rounding
  }
}

TEST(FlatWater, SnellSendsTheRayToItsGroundPoint) {
  for (const double degrees : {0.0, 30.0, 60.0, 80.0, 89.0}) {
    const double f = fresnel(radians(degrees), water_ior);
    // Surroundings are black, so the pixel is (1 - F) times the coordinates of the ground point.
    const Seen seen = see(sheet(water(water_ior), tells_place(), constant({0, 0, 0})), slanting(degrees));
    const double bent = std::asin(std::sin(radians(degrees)) / water_ior);
    EXPECT_NEAR(seen.radiance.x, (1 - f) * depth * std::tan(bent), 1e-14) << degrees;
    EXPECT_NEAR(seen.radiance.y, -(1 - f) * depth, 1e-14);
    EXPECT_NEAR(seen.radiance.z, 0, 1e-15);
    EXPECT_NEAR(seen.film, depth / std::cos(bent), 1e-14);
  }
}

TEST(FlatWater, BeerAlongTheBentPath) {
  Medium murky = water(water_ior);
  murky.extinction = {1, 4, 9};
  murky.glow = {0.2, 0.3, 0.4};
  for (const double degrees : {0.0, 60.0, 89.0}) {
    const double f = fresnel(radians(degrees), water_ior), path = depth / std::cos(std::asin(std::sin(radians(degrees)) / water_ior));
    const Seen seen = see(sheet(murky, emitter({1, 1, 1}), constant({0, 0, 0})), slanting(degrees));
    for (int k = 0; k < 3; ++k) {
      const double t = std::exp(-murky.extinction[k] * path);
      EXPECT_NEAR(seen.radiance[k], (1 - f) * (t + (1 - t) * murky.glow[k]), 1e-14) << degrees << " " << k;
    }
  }
}

TEST(FlatWater, MirrorsAtTheAngleOfIncidence) {
  for (const double degrees : {0.0, 45.0, 89.0}) {
    const double f = fresnel(radians(degrees), water_ior);
    const Seen seen = see(sheet(water(water_ior), emitter({0, 0, 0}), tells_direction()), slanting(degrees));
    EXPECT_NEAR(seen.radiance.x, f * std::sin(radians(degrees)), 1e-15);
    EXPECT_NEAR(seen.radiance.y, f * std::cos(radians(degrees)), 1e-15);
  }
}

// At Brewster's angle the reflected and the refracted ray are at right angles, and nothing of the light in their plane is
// reflected: what remains is half the other polarization's share.
TEST(FlatWater, BrewstersAngle) {
  const double brewster = std::atan(water_ior);
  EXPECT_NEAR(brewster * 180 / pi, 53.123, 5e-4);  // physics P9
  const Split s = split({std::sin(brewster), -std::cos(brewster), 0}, {0, 1, 0}, 1, water_ior);
  EXPECT_NEAR(dot(s.reflected, s.refracted), 0, 1e-15);
  const double n2 = water_ior * water_ior, perpendicular = (n2 - 1) / (n2 + 1);  // r_s at Brewster's angle
  EXPECT_NEAR(s.reflectance, perpendicular * perpendicular / 2, 1e-15);
}

// Upward from under water everything is reflected beyond the critical angle, and what is within comes out at 90 degrees at most.
TEST(FlatWater, CriticalAngle) {
  const double critical = std::asin(1 / water_ior);
  EXPECT_NEAR(critical * 180 / pi, 48.607, 5e-4);  // physics P9
  for (const double off : {-1e-6, 1e-6}) {
    const double angle = critical + off;
    const Split s = split({std::sin(angle), std::cos(angle), 0}, {0, -1, 0}, water_ior, 1);
    EXPECT_EQ(s.reflectance == 1, off > 0);
    EXPECT_EQ(s.refracted == Vec(0, 0, 0), off > 0);
  }
}

// Light goes both ways alike: the reflectance from inside at the refracted angle is the one from outside.
TEST(FlatWater, ReflectanceIsTheSameFromBothSides) {
  for (double degrees = 0.5; degrees < 90; degrees += 0.5) {
    const Split in = split(slanting(degrees).direction, {0, 1, 0}, 1, water_ior);
    const Split out = split(-in.refracted, {0, -1, 0}, water_ior, 1);
    // Near 90 degrees the way back divides by the cosine.
    EXPECT_NEAR(out.reflectance, in.reflectance, 1e-15 / std::cos(radians(degrees)) / std::cos(radians(degrees))) << degrees;
  }
}

// A pane changes no direction: what lies endlessly far is seen where it is.
TEST(Plate, LeavesDirectionsUnchanged) {
  Scene scene;
  scene.add(std::make_shared<Level>(0), Material::interface_of(air(), glass()));
  scene.add(std::make_shared<Level>(-0.005), Material::interface_of(glass(), air()));
  scene.set_environment(tells_direction());
  scene.commit();
  for (const double degrees : {0.0, 30.0, 70.0, 88.0}) {
    const Ray ray = slanting(degrees);
    const double f = fresnel(radians(degrees), 1.52), through = (1 - f) * (1 - f);
    ShadingOptions two{2, 0};  // beyond the second face every path looks at the surroundings
    const Vec seen = see(scene, ray, two).radiance;
    // Reflected at the front: f; through both: (1-f)^2; inside after the back's mirror: cut there, seen straight on.
    const double s = std::sin(radians(degrees)), inside = (1 - f) * f;
    EXPECT_NEAR(seen.x, f * s + through * s + inside * s / 1.52, 1e-14) << degrees;
  }
}

// A closed ball, inside the same part of the same surface: the ray meets the far side, not the point where it began.
TEST(Ball, ARayCrossesAndLeaves) {
  for (const double off : {0.0, 0.3, 0.5, 0.7}) {  // further out, what the ball mirrors is the ground
    Scene scene;
    const double ior = 1.333;
    Medium dye = water(ior);
    dye.extinction = {3, 3, 3};
    scene.add(std::make_shared<Ball>(Vec{0, 0, 0}, 1), Material::interface_of(air(), dye));
    scene.add(std::make_shared<Level>(-3), Material::of(emitter({1, 1, 1})));
    scene.set_environment(constant({0, 0, 0}));
    scene.commit();
    const Seen seen = see(scene, {{off, 5, 0}, {0, -1, 0}}, {3, 0});  // depth 3 ends the paths that are reflected inside
    const double incidence = std::asin(off), chord = 2 * std::sqrt(1 - off * off / (ior * ior)), f = fresnel(incidence, ior);
    EXPECT_NEAR(seen.film, chord, 1e-14);
    EXPECT_NEAR(seen.radiance.x, (1 - f) * (1 - f) * std::exp(-3 * chord), 1e-14) << off;
  }
}

}  // namespace
}  // namespace rainref::compositor::testing
