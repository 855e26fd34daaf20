// Where the puddle's ground ends and the surroundings' own begins, and from where the street is seen.

#include <gtest/gtest.h>

#include "image/images.h"
#include "puddle/instance.h"
#include "puddle/scene_support.h"
#include "scene/test_card.h"

namespace rainref::puddle::test {
namespace {

constexpr float half_x = 2, half_z = 1;

// What shade makes of dry black ground at (x, 0, z) under a sky of radiance 3 that it does not mirror.
double at(double reach, double x, double z) {
  Settings s = corrected(1, 1);
  s.reflectivity = 0;
  s.ground_reach = reach;
  ShadeUniforms u = shade_uniforms(s);
  u.camera = single_ray({0, 10, 0}, falling(0.5));
  u.inverse_size[0] = 0.5f / half_x;
  u.inverse_size[1] = 0.5f / half_z;
  const TextureData sky({3, 3, 3, 1}, 4, 1, 1, Address::repeat, Address::clamp);
  const TextureData black({0, 0, 0, 1}, 4, 1, 1, Address::repeat, Address::repeat);
  const TextureData relief({0, 0}, 2, 1, 1, Address::repeat, Address::repeat), bed({-1}, 1, 1, 1, Address::clamp, Address::clamp);
  const Double zero(0.0f), one(1.0f);
  const scalar::Surface<Double> surface{Vec3<Double>(Double(x), zero, Double(z)), Vec3<Double>(zero, one, zero), one};
  return scalar::shade_corrected(u, sky.view(), black.view(), relief.view(), bed.view(), surface, 0, 0).x.v;
}

TEST(PuddleSurroundings, GroundTurnsIntoTheSurroundingsOutsideTheRectangle) {
  constexpr double reach = 0.25;  // a power of two: the shares below are exact
  for (const double x : {-2.0, 0.0, 1.5, 2.0})
    for (const double z : {-1.0, 0.25, 1.0}) EXPECT_EQ(at(reach, x, z), 0) << x << " " << z << ", over the rectangle";
  // Extents are 4 m and 2 m: half of the reach is 0.5 m in x and 0.25 m in z. smoothstep(1/2) = 1/2, smoothstep(1/4) = 5/32.
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(at(reach, sign * 2.5, 0), 1.5);
    EXPECT_EQ(at(reach, 0, sign * 1.25), 1.5);
    EXPECT_EQ(at(reach, sign * 2.25, 1), 3 * 5.0 / 32);
    EXPECT_EQ(at(reach, sign * 3, 0), 3);
  }
  EXPECT_EQ(at(reach, 50, -200), 3);
  // Off a corner by 3/4 and 4/4 of a fifth of the reach: the distance is 1/4 of it by Pythagoras. One rounding or two of a root.
  EXPECT_NEAR(at(reach, 2 + 0.15 * 4 * reach, 1 + 0.2 * 2 * reach), 3 * 5.0 / 32, 1e-14);
}

TEST(PuddleSurroundings, WithoutReachTheGroundGoesOn) {
  EXPECT_EQ(at(0, 3, 0), 0);
  EXPECT_EQ(at(0, 1000, 1000), 0);
}

std::unique_ptr<effect::Instance> opened(const std::string& variant, std::vector<std::string> overrides) {
  overrides.emplace_back("environment.width=64");
  overrides.emplace_back("run.size=[8,6]");
  effect::Inputs inputs;
  inputs.street = scene::TestCard::make;
  return entry().open(config_of(variant, overrides), executor(), inputs);
}
bool is_seen_from(const std::unique_ptr<effect::Instance>& puddle, const scene::Vector3& eye) {
  return same(static_cast<const Instance&>(*puddle).surroundings().environment, scene::TestCard().panorama(64, 32, eye, executor()));
}

TEST(PuddleSurroundings, StreetIsSeenFromTheCamera) {
  EXPECT_TRUE(is_seen_from(opened("corrected", {"camera.position=[0.5,0.25,2]"}), {0.5, 0.25, 2}));
  EXPECT_TRUE(is_seen_from(opened("corrected", {"camera.position=[0.5,0.01,2]"}), {0.5, 0.05, 2})) << "not from below the road";
  EXPECT_TRUE(is_seen_from(opened("corrected", {"camera.position=[30,2,0]"}), {0, 0.05, 0})) << "not from within a house";
  EXPECT_TRUE(is_seen_from(opened("as-published", {"camera.position=[0.5,0.25,2]"}), {0, 0.05, 0}));
}

int columns_of(const std::vector<std::string>& overrides) {
  std::vector<std::string> all = overrides;
  all.emplace_back("puddle.grid=[16,16]");
  effect::Inputs inputs;
  inputs.street = scene::TestCard::make;
  const auto puddle = entry().open(config_of("corrected", all), executor(), inputs);
  return static_cast<const Instance&>(*puddle).surroundings().environment.width();
}
// A pixel at the middle of 180 rows that see 36 degrees is 2 tan(18 deg) / 180 = 1/277 rad: 1740 of them make a turn.
TEST(PuddleSurroundings, StreetIsAsFineAsThePicture) {
  EXPECT_EQ(columns_of({"run.size=[8,180]"}), 1024);
  EXPECT_EQ(columns_of({"run.size=[8,360]", "run.supersample=2"}), 1024) << "of passes: 180 rows of the picture";
  EXPECT_EQ(columns_of({"run.size=[8,6]"}), 1024) << "at least";
  EXPECT_EQ(columns_of({"run.size=[8,180]", "camera.vertical_fov_deg=18"}), 2048);
  EXPECT_EQ(columns_of({"run.size=[8,180]", "environment.width=128"}), 128) << "as named";
}

TEST(PuddleSurroundings, WetGroundMirrorsAPatchOfOneAngle) {
  EXPECT_EQ(gloss_level(2048, false), 3);
  EXPECT_EQ(gloss_level(4096, false), 4);
  EXPECT_EQ(gloss_level(1024, true), 4) << "a face is a quarter of the turn";
  EXPECT_EQ(gloss_level(1024, false), 2);
  EXPECT_EQ(gloss_level(16, false), 2) << "coarser than what water mirrors";
}

// The camera turns with the surroundings: what shade looks up for a direction d is the street in rotate(d), seen from rotate(position).
TEST(PuddleSurroundings, StreetIsSeenFromTheTurnedCamera) {
  const double angle = 0.5, c = std::cos(angle), s = std::sin(angle), x = 0.5, z = 2;
  const auto seen = opened("corrected", {"camera.position=[0.5,0.25,2]", "puddle.env_rotation=0.5"});
  EXPECT_TRUE(is_seen_from(seen, {c * x + s * z, 0.25, c * z - s * x}));
}

}  // namespace
}  // namespace rainref::puddle::test
