// The known_defects of the article that concern the surface in space: as-published reproduces each, corrected does not.
// Numbers are those of docs/effects/puddle.md.
#include <gmock/gmock.h>

#include "puddle/scene_support.h"

namespace rainref::puddle::test {
namespace {

std::vector<float> constant(int cells, double value) {
  return std::vector<float>(static_cast<std::size_t>(cells), static_cast<float>(value));
}

// A height that rises along +x, `rise` a texel, zero in the middle.
std::vector<float> ramp(int width, int height, double rise) {
  std::vector<float> heights;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) heights.push_back(static_cast<float>(rise * (x - 0.5 * (width - 1))));
  }
  return heights;
}
Puddle rendered(const Settings& s, const std::vector<float>& newest, const std::vector<float>& previous, float radiance = 1,
                float albedo = 0) {
  Puddle p(s, uniform_surroundings(radiance, albedo), executor());
  p.set_water(newest, previous);
  p.render();
  return p;
}
// One pixel that looks straight down on level water.
double down_colour(const Settings& s, float radiance, float albedo) {
  Puddle p(looking_down(s, 18), uniform_surroundings(radiance, albedo), executor());
  p.render();
  return colour_of(p, 0, 0, 0);
}
// The height is taken from the green channel, the previous level, and still encoded: level water lies at 5 - 1/2.
TEST(PuddleKnownDefects, Defect07_HeightIsPreviousAndEncoded) {
  const Settings s = looking_down(as_published(4, 4), 18);
  const auto height = [&](double newest, double previous) {
    return hit_of(rendered(s, constant(16, newest), constant(16, previous)), 1, 1)[1];
  };
  EXPECT_NEAR(height(0, 0), 4.5, 1e-3 + 1e-6);  // the march's epsilon
  EXPECT_NEAR(height(0.6, 0), 4.5, 1e-3 + 1e-6) << "the newest level is not seen";
  EXPECT_NEAR(height(0, 0.6), 4.5 - 0.3, 1e-3 + 1e-6) << "s = 1/2 + u/2";
  // Corrected: the newest level, in metres about y = 0.
  const Settings c = looking_down(corrected(4, 4), 0.5);
  const auto metres = [&](double newest, double previous) {
    return hit_of(rendered(c, constant(1200, newest), constant(1200, previous)), 1, 1)[1];
  };
  EXPECT_NEAR(metres(0, 0), 0, 1.1e-5);
  EXPECT_NEAR(metres(0.006, 0), 0.006, 1.1e-5);
  EXPECT_NEAR(metres(0, 0.006), 0, 1.1e-5);
}

// A higher value moves the surface down, but the normals are those of a surface that moves up.
TEST(PuddleKnownDefects, Defect08_ShadingIsInvertedAgainstGeometry) {
  const auto slopes = [](const Puddle& p, int row) {
    const auto a = hit_of(p, 6, row), b = hit_of(p, 9, row);
    return std::pair{(b[1] - a[1]) / (b[0] - a[0]), -a[4] / a[5]};  // of the hits, of the normal
  };
  const Settings s = looking_down(as_published(16, 16), 18);
  const std::vector<float> rising = ramp(16, 16, 0.05);
  const auto [geometry, shading] = slopes(rendered(s, rising, rising), 8);
  EXPECT_LT(geometry, -1e-3);
  EXPECT_GT(shading, 1e-3);
  const Settings c = looking_down(corrected(16, 16), 0.5);
  const std::vector<float> metres = ramp(40, 30, 0.001);
  const auto [true_slope, normal_slope] = slopes(rendered(c, metres, metres), 8);
  EXPECT_NEAR(true_slope, 0.05, 4e-4);  // two hits to 1e-5 over three pixels of 2 cm
  EXPECT_NEAR(normal_slope, 0.05, 0.05 * 2 * half_error);
}

// The gain 2.5 is the slope of the surface only where the wave has 420 texels over the box of 84.
TEST(PuddleKnownDefects, Defect09_NormalGainFitsOneResolution) {
  const auto gain = [](int width) {
    SurfaceHitUniforms u = surface_hit_uniforms(as_published(width, 1));
    u.camera = single_ray({0, 18, 0}, {0, -1, 0});
    std::vector<float> stored;
    for (int x = 0; x < width; ++x) stored.push_back(static_cast<float>(0.5 + 0.25 * (2.0 * (x + 0.5) / width - 1)));
    const auto hit = scalar::surface_hit_as_published<Double>(u, wave_texture(stored, width, 1, Address::clamp).view(), 0, 0);
    const double slope = 0.25 / 42;  // stored units a unit of length
    return -hit.normal.x.v / hit.normal.y.v / slope;
  };
  // Float texels near 1/2 differ by 1/width with an error of 6e-8.
  for (const int width : {105, 420, 840, 1280}) EXPECT_NEAR(gain(width), 420.0 / width, 1e-3) << width;
  // Corrected: the slope in metres a metre, at every cell size.
  for (const double cell : {0.005, 0.02, 0.08}) {
    Settings s = corrected(1, 1);
    s.cell_size = cell;
    SurfaceHitUniforms u = surface_hit_uniforms(s);
    u.surface_top = 0.2f;
    u.surface_slope = 2;
    const TextureData bounds = no_local_bounds();
    u.camera = single_ray({0, 1, 0}, {0, -1, 0});
    const TextureData wave = wave_texture(ramp(40, 30, 0.05 * cell), 40, 30, Address::border);
    const auto hit = scalar::surface_hit_corrected<Double>(u, wave.view(), bounds.view(), 0, 0);
    EXPECT_NEAR(-hit.normal.x.v / hit.normal.y.v, 0.05, 1e-7) << cell;
  }
}

// A picture of 16:9 is laid over a square of 84: rings that are round in texels are ellipses in the world.
TEST(PuddleKnownDefects, Defect10_RingsAreEllipsesUnlessThePictureIsSquare) {
  const auto ring = [](Water w, const Drop& drop, float rest) {
    // Where the first displaced texel lies along x and along y, after 12 steps.
    w.step({drop});
    for (int i = 0; i < 12; ++i) w.step();
    const std::vector<float> now = w.now();
    std::array<int, 2> reach{};
    const int cx = w.width / 2, cy = w.height / 2;
    for (int k = 1; k < w.height / 2; ++k) {
      if (std::abs(now[w.at(cx + k, cy)] - rest) > 1e-6) reach[0] = k;
      if (std::abs(now[w.at(cx, cy + k)] - rest) > 1e-6) reach[1] = k;
    }
    return reach;
  };
  const Settings s = as_published(96, 54);
  const auto published = ring(Water(s), {48.5f, 27.5f, 1, 4}, 0.5f);
  ASSERT_GT(published[0], 12);
  EXPECT_EQ(published[0], published[1]) << "round in texels";
  const SurfaceHitUniforms u = surface_hit_uniforms(s);
  const double cell_x = 2 * u.half_size[0] * u.texel[0], cell_z = 2 * u.half_size[2] * u.texel[1];
  EXPECT_NEAR(cell_z / cell_x, 16.0 / 9, 1e-6) << "ratio of the ring's axes";
  // Corrected: cells are squares whatever the grid and the picture.
  Settings c = corrected(96, 54);
  c.grid = {64, 48};
  const auto fixed = ring(Water(c), {32.5f, 24.5f, -0.003f, 4}, 0);
  ASSERT_GT(fixed[0], 4);
  EXPECT_EQ(fixed[0], fixed[1]);
  const SurfaceHitUniforms v = surface_hit_uniforms(c);
  EXPECT_NEAR(2 * v.half_size[0] * v.texel[0], c.cell_size, 1e-9);
  EXPECT_NEAR(2 * v.half_size[2] * v.texel[1], c.cell_size, 1e-9);
}

// The ground lies at y = -uPuddleDepth and the water at 4.5: it is 4.5 deeper than the parameter says.
TEST(PuddleKnownDefects, Defect11_WaterIsDeeperThanItsDepth) {
  Settings s = as_published(1, 1);
  s.puddle_depth = 5;
  s.reflectivity = 0;
  const auto kept = [&](Settings t, double turbidity) {
    t.water_turbidity = turbidity;
    return down_colour(t, 0, 1);
  };
  const double depth = -std::log(kept(s, 0.2) / kept(s, 0)) / 0.2;
  EXPECT_NEAR(depth, 5 + 4.5, 2 * half_error / 0.2 + 1e-3);
  // Corrected: the parameter is the depth, and light passes it twice (oddity 16).
  Settings c = corrected(1, 1);
  c.puddle_depth = 0.05;
  c.reflectivity = 0;
  const auto seen = [&](double turbidity) {
    Settings t = c;
    t.water_turbidity = turbidity;
    return down_colour(t, 1, 1);
  };
  EXPECT_NEAR(-std::log(seen(10) / seen(0)) / 10 / 2, 0.05, half_error / 10);
}

// On a miss the march leaves p at the ray's origin and still takes a normal, of the water under the camera.
TEST(PuddleKnownDefects, Defect12_MissLeavesTheHitAtTheCamera) {
  const auto looking_up = [](Settings s) {
    s.camera_position = {1, 18, 2};
    s.camera_target = {2, 19, 2};
    return s;
  };
  const std::vector<float> rising = ramp(8, 8, 0.05);
  const Puddle p = rendered(looking_up(as_published(8, 8)), rising, rising, 0.5f);
  const auto h = hit_of(p, 4, 4);
  EXPECT_THAT((std::array<double, 3>{h[0], h[1], h[2]}), testing::ElementsAre(1, 18, 2));
  EXPECT_EQ(h[3], 255);
  EXPECT_LT(h[4], -0.01) << "a normal of water that the ray never met";
  EXPECT_EQ(h[7], 0);
  EXPECT_NEAR(colour_of(p, 4, 4, 0), 0.5, half_error) << "a choice: the article does not say, here the sky is shown";
  // Corrected: the flag says so, the normal is up and the sky is shown.
  const std::vector<float> metres = ramp(40, 30, 0.001);
  const Puddle c = rendered(looking_up(corrected(8, 8)), metres, metres, 0.5f);
  const auto g = hit_of(c, 4, 4);
  EXPECT_THAT((std::array<double, 3>{g[4], g[5], g[6]}), testing::ElementsAre(0, 1, 0));
  EXPECT_EQ(g[7], 0);
  EXPECT_NEAR(colour_of(c, 4, 4, 0), 0.5, half_error);
}

// "Won't overshoot because d tells us the closest surface": d is the vertical distance to a displaced box.
TEST(PuddleKnownDefects, Defect13_PublishedMarchOvershootsCrests) {
  constexpr int width = 840;  // texels of a tenth
  int crossed = 0, rays = 0;
  for (double start = -30; start < -29; start += 0.1) {
    const auto direction = falling(0.02);
    // As published: s = 1 is low (y = 4), one texel of s = 0 is a crest of height 5.
    std::vector<float> stored = constant(width, 1), heights = constant(2 * width, 0);
    stored[width / 2] = 0;
    heights[width / 2] = heights[width + width / 2] = 1;
    SurfaceHitUniforms u = surface_hit_uniforms(as_published(width, 1));
    u.camera = single_ray({start, 5.1, 0}, direction);
    u.max_steps = 1000;  // the plane behind the crest takes more than 256
    const TextureData wave = wave_texture(stored, width, 1, Address::clamp);
    const auto hit = scalar::surface_hit_as_published<Double>(u, wave.view(), 0, 0);
    const auto inside = [&](double t) {
      const Double x(start + t * direction[0]), y(5.1 + t * direction[1]);
      return scalar::scene_distance(u, wave.view(), Vec3<Double>(x, y, Double(0.0f))).v == 0;
    };
    const double first = first_where(0, 60, 0.002, inside);
    ASSERT_LT(first, 31) << "the ray does meet the crest";
    ++rays;
    crossed += hit.position.x.v > start + first * direction[0] + 0.1;

    // Corrected: the same crest in metres.
    Settings s = corrected(1, 1);
    s.grid = {width, 2};
    s.cell_size = 0.1;
    s.max_steps = 4096;
    SurfaceHitUniforms v = surface_hit_uniforms(s);
    v.surface_top = 1.01f;
    v.surface_slope = 15;
    const TextureData bounds = no_local_bounds();
    v.camera = single_ray({start, 1.1, 0}, direction);
    const TextureData water = wave_texture(heights, width, 2, Address::clamp);
    const auto fixed = scalar::surface_hit_corrected<Double>(v, water.view(), bounds.view(), 0, 0);
    const auto below = [&](double t) {
      return 1.1 + t * direction[1] <
             scalar::water_height<Double>(v, water.view(), Double((start + t * direction[0]) / (0.1 * width) + 0.5), Double(0.5f)).v;
    };
    const double crossing = first_where(0, 60, 0.002, below);
    // Newton's step starts at most 1e-4 above a slope of 10, of which central differences at the crest see 2 or more.
    EXPECT_NEAR(fixed.position.x.v, start + crossing * direction[0], 5e-5) << start;
  }
  EXPECT_GT(crossed, rays / 2) << "of " << rays;
}

}  // namespace
}  // namespace rainref::puddle::test
