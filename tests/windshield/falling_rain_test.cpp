// The rain behind the glass: how much there is, how it moves, what lights it, and what the pass draws of it.
#include <gtest/gtest.h>

#include <map>

#include "image/images.h"
#include "math/half.h"
#include "pass/run.h"
#include "rain/rain.h"
#include "windshield/golden_scenes.h"
#include "windshield/picture/falling_rain.h"
#include "windshield/picture/falling_rain.pass.h"
#include "windshield/support.h"

namespace rainref::windshield {
namespace {

using glm::dvec3;

/// Looks ahead from the origin, everything beyond 2 cm outside.
RainView ahead(int size = 4000) { return {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 40}, size, size}; }
const Glass& at_the_eye() {
  static const Glass glass = make_glass({{{0, 1, -1}, {0, -1, -1}, {0, 1, 1}}});
  return glass;
}
std::vector<FallingDrop> drops_at(const FallingRainSettings& s, const Air& air, std::span<const RainLamp> lamps = {}, int size = 4000) {
  return falling_drops(s, 7, air, ahead(size), std::span(&at_the_eye(), 1), lamps);
}
/// Without a way in the exposure nothing is too faint to be drawn.
FallingRainSettings still() {
  FallingRainSettings s;
  s.exposure = 0;
  s.far = 6;
  return s;
}

// The drops in view are those of Marshall and Palmer in the cone that is seen, whatever the rate, and of every size above the smallest.
TEST(FallingRain, ThereAreAsManyAsInTheAir) {
  const double half = std::tan(20 * degree), cone = 4 * half * half * (6 * 6 * 6 - 0.3 * 0.3 * 0.3) / 3;
  for (const double rate : {2.0, 20.0, 100.0}) {
    const double lambda = 4.1 * std::pow(rate, -0.21);
    // No drop is above 6 mm.
    const double expected = cone * 8000 / lambda * (std::exp(-lambda) - std::exp(-6 * lambda));
    const auto found = drops_at(still(), {.rate = rate});
    // Chance; and drops at the picture's rim, of which it holds those within a texel and their radius, 2 of 4000 on each side.
    EXPECT_NEAR(static_cast<double>(found.size()), expected, 4 * std::sqrt(expected) + 0.004 * expected) << rate;
    std::size_t large = 0;
    for (const FallingDrop& d : found) large += d.radius > 1e-3;
    const double share = (std::exp(-2 * lambda) - std::exp(-6 * lambda)) / (std::exp(-lambda) - std::exp(-6 * lambda));
    // Within a class of half a millimetre sizes are even.
    EXPECT_NEAR(static_cast<double>(large) / static_cast<double>(found.size()), share, 4 / std::sqrt(expected) + 1e-3) << rate;
  }
  EXPECT_TRUE(drops_at(still(), {.rate = 0}).empty());
}

// Where a drop is when the shutter closes, it is when it opens next: what falls past the car keeps its identity from frame to frame.
TEST(FallingRain, DropsMoveOn) {
  FallingRainSettings s = still();
  s.exposure = 1.0 / 32;
  Air air{.time = 3, .moved = {-30, 2, 0}, .wind = {-12, 1, 0.5}, .rate = 30};
  std::multimap<double, dvec3> closed;  // of 24 bits of radius: a few share one
  for (const FallingDrop& d : drops_at(s, air)) {
    closed.emplace(d.radius, d.to);
    const dvec3 way = (d.to - d.from) / s.exposure;
    EXPECT_NEAR(way.x, -12, 1e-9);
    EXPECT_NEAR(way.y, 1, 1e-9);
    // One of ten classes' velocities.
    EXPECT_GT(0.5 - way.z, rain::terminal_velocity(1.0));
    EXPECT_LT(0.5 - way.z, 9.3);
  }
  air.time += s.exposure;
  for (std::size_t k = 0; k < 3; ++k) air.moved[k] += s.exposure * air.wind[k];
  int met = 0, strange = 0;
  for (const FallingDrop& d : drops_at(s, air)) {
    const auto [first, last] = closed.equal_range(d.radius);
    if (first == last) continue;  // it came into view
    const bool is_there = std::any_of(first, last, [&](const auto& before) { return glm::length(before.second - d.from) < 1e-9; });
    ++(is_there ? met : strange);
  }
  EXPECT_LT(strange, met / 500);  // came into view where another of its radius was
  EXPECT_GT(met, 500);
}

// A streak is as long as the drop's way across the view, and the share of the time in which a point of it is covered is the drop's width
// over that of drop and way.
TEST(FallingRain, StreaksAreAsLongAsTheExposure) {
  FallingRainSettings s = still();
  int seen = 0;
  for (const double exposure : {0.002, 0.02}) {
    s.exposure = exposure;
    for (const FallingDrop& d : drops_at(s, {.rate = 30})) {
      const double fall = d.from.z - d.to.z, texels = 2000 / std::tan(20 * degree) / d.from.x;  // it falls at one depth
      ++seen;
      EXPECT_NEAR(d.streak.opened[1] - d.streak.closed[1], fall * texels, 2e-3 * fall * texels);
      EXPECT_NEAR(d.streak.opened[0], d.streak.closed[0], 1e-2);
      EXPECT_NEAR(d.streak.radius, std::max(d.radius * texels, 0.5), 1e-3 * texels * d.radius + 1e-6);
      EXPECT_NEAR(d.time_share, 2 * d.radius / (2 * d.radius + fall), 2e-5);  // places are floats
      EXPECT_NEAR(d.streak.opacity, d.time_share * std::min(2 * d.radius * texels, 1.0), 1e-6);
      EXPECT_LE(d.streak.opacity, 1);
      EXPECT_NEAR(fall / exposure, rain::terminal_velocity(2e3 * d.radius), 1.1);  // that of the class's middle
    }
  }
  EXPECT_GT(seen, 1000);
}

// Ambient light, and a lamp's radiance by its solid angle and the phase: 343 times as bright before a lamp as with the lamp behind the eye.
TEST(FallingRain, LampsLightIt) {
  const FallingRainSettings s = still();
  const Air air{.rate = 20, .ambient = {0.1, 0.2, 0.3}};
  for (const FallingDrop& d : drops_at(s, air)) EXPECT_EQ(d.radiance, dvec3(0.1, 0.2, 0.3));
  const double radius = 0.2;
  const auto lit = [&](const dvec3& at) {
    const RainLamp lamp{at, radius, {50, 40, 30}};
    double ratio = 0;
    for (const FallingDrop& d : drops_at(s, {.rate = 20}, std::span(&lamp, 1))) {
      const dvec3 way = d.from - at, to_eye = -d.from / glm::length(d.from);
      const double far_sq = glm::dot(way, way), cosine = glm::dot(way, to_eye) / std::sqrt(far_sq), g = 0.75;
      const double expected = 50 * pi * radius * radius / far_sq * (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
      EXPECT_NEAR(d.radiance.x, expected, 1e-9 * expected);
      EXPECT_NEAR(d.radiance.y, 0.8 * d.radiance.x, 1e-9 * expected);
      ratio = std::max(ratio, d.radiance.x * far_sq);
    }
    return ratio;
  };
  EXPECT_NEAR(lit({1000, 0, 0}) / lit({-1000, 0, 0}), 343, 343 * 0.35);  // within 28 degrees of straight; at most 343
  FallingRainSettings bright = s;
  bright.gain = 3;
  EXPECT_NEAR(drops_at(bright, air)[0].radiance.y, 0.6, 1e-12);
}

// None within the car: behind every pane, before none.
TEST(FallingRain, FallsOutside) {
  const Glass wall = make_glass({{{3, 9, -9}, {3, -9, -9}, {3, 9, 9}}});
  const auto found = falling_drops(still(), 7, {.rate = 50}, ahead(), std::span(&wall, 1), {});
  EXPECT_GT(found.size(), 1000u);
  for (const FallingDrop& d : found) EXPECT_GT(d.from.x, 3);
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_GE(found[i - 1].streak.depth, found[i].streak.depth);  // far ones first
}

// More than any picture needs would take minutes a frame.
TEST(FallingRain, TooManyAreRefused) {
  const parallel::Executor executor(1);
  EXPECT_THAT(usage_error([&] {
                Windshield(
                    config_of("corrected", "[rain]\nrate = 200\n[camera]\nvertical_fov_deg = 90\n[falling_rain]\non = true\nfar = 40\n"),
                    small_surroundings(), executor);
              }),
              testing::HasSubstr("falling_rain.far: expected at most 300000 drops in view, found"));
}

// ---- the pass ------------------------------------------------------------------------------------------------------------------

/// The pass on level light `before`, everything in the street `depth` metres away.
Image drawn(const std::vector<Streak>& streaks, double depth, float before = 0.25f, int tile = 16) {
  Image image = make_image(Format::rgba16f, 64, 48, [=](int, int, int) { return to_half(before); });
  const Image far = make_image(Format::r32f, 64, 48, [=](int, int, int) { return static_cast<float>(depth); });
  pass::HostIo<FallingRainPass> io;
  io.blurred = image;
  io.scene_depth = far;
  io.streaks = streaks;
  io.rainy = image;
  pass::Run<FallingRainPass>({static_cast<std::int32_t>(streaks.size()), 10, 0, 0}, true, Rounding::rne, io)
      .tiles(parallel::Executor(1), tile, tile);
  return image;
}
/// Light that the picture has more of than the level before, in texels of radiance 1.
double added(const Image& image, float before = 0.25f) {
  double sum = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) sum += to_float(image.row<Half>(y)[4 * x]) - before;
  return sum;
}
// A streak adds its radiance less what it hides, times its opacity and its area: width 2 r, its ends round; nothing where it is hidden.
TEST(FallingRain, ThePassDrawsItsArea) {
  for (const double radius : {0.5, 2.0}) {
    const Streak s{{20.3f, 40.1f}, {31.6f, 9.7f}, static_cast<float>(radius), 5, 0.5f, 0, {1.25f, 1, 1}, 0};
    const double length = std::hypot(31.6 - 20.3, 40.1 - 9.7), area = 2 * radius * length + pi * radius * radius;
    // Edges are a texel wide: round ends gain a little; halves round.
    EXPECT_NEAR(added(drawn({s}, 100)), 0.5 * area, 0.02 * area + 0.3) << radius;
    EXPECT_EQ(added(drawn({s}, 4)), 0);
    EXPECT_NEAR(added(drawn({s}, 5.05)), 0.25 * area, 0.02 * area + 0.3);  // halfway through 10 cm
  }
  EXPECT_EQ(added(drawn({}, 100)), 0);
}
// Tiles take the streaks that are near: of whatever size they are, of whole vectors, the bits are those of all.
TEST(FallingRain, TilesChooseWithoutChangingABit) {
  std::mt19937 words(5);
  const auto unit = [&] { return static_cast<float>(words() * 0x1p-32); };
  std::vector<Streak> many;
  for (int i = 0; i < 200; ++i) {
    const float x = 80 * unit() - 8, y = 60 * unit() - 6;
    many.push_back(
        {{x, y}, {x + 6 * unit() - 3, y - 20 * unit()}, 0.5f + 2 * unit(), 8 * unit(), unit(), 0, {unit(), unit(), 2 * unit()}, 0});
  }
  const Image whole = drawn(many, 6, 0.25f, 64);
  for (const int tile : {16, 32, 48}) EXPECT_TRUE(same(drawn(many, 6, 0.25f, tile), whole)) << tile;
  EXPECT_GT(added(whole), 10);
}

/// The pictures' hashes of two frames.
std::vector<std::string> pictures(const std::string& variant, const std::string& more) {
  const parallel::Executor executor(2);
  Windshield run(config_of(variant, "[run]\nsize = [40, 24]\n[vehicle]\nspeed = 10\n[windshield]\nheight_size = [20, 12]\n" + more),
                 small_surroundings(), executor);
  std::vector<std::string> hashes;
  for (int n = 0; n < 2; ++n) {
    run.next_frame();
    hashes.push_back(capture::hash_of(run.colour()).text());
  }
  return hashes;
}
// It can be switched on and off; off is the default, and its other keys change nothing then.
TEST(FallingRain, IsSwitchedByItsKey) {
  for (const std::string variant : {"as-published", "corrected"}) {
    const std::string bright = "[falling_rain]\ngain = 20\nexposure = 0.02\n";
    EXPECT_EQ(pictures(variant, bright), pictures(variant, "")) << variant;
    EXPECT_NE(pictures(variant, bright + "on = true\n"), pictures(variant, "")) << variant;
  }
  EXPECT_EQ(pictures("corrected", "[rain]\nkey_frames = '0 0; 5 0'\n[falling_rain]\non = true\n"),
            pictures("corrected", "[rain]\nrate = 0\n"));
}

}  // namespace
}  // namespace rainref::windshield
