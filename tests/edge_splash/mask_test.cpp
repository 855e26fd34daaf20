// Masks over known pictures: rows, halves, counts and scrolls.
#include "edge_splash/support.h"
#include "image/flipped.h"

namespace rainref::edge_splash {
namespace {

const parallel::Executor& executor() {
  static const parallel::Executor one(1);
  return one;
}

// A flat-topped object of depth D1 under an empty sky: T rows above its edge, none inside.
TEST(EdgeSplashMask, PublishedRowsAboveAnEdge) {
  EdgeSplash e(published(), inputs_of(48, 40, [](int, int y) { return y < 20 ? 0.2 : 0.0; }), executor());
  e.next_frame();
  for (int y = 3; y < 37; ++y) {
    for (int x = 3; x < 45; ++x) EXPECT_EQ(painted(e, x, y), y >= 20 && y <= 22) << x << "," << y;
  }
}

// The threshold .166 of a sum 2 D1 with near plane .3 m ends at 2 * .3 / .166 = 3.614 m; true sums of distance reach on.
TEST(EdgeSplashMask, HowFarAwayAnEdgeShows) {
  for (const double z : {3.0, 3.613, 3.616, 7.0, 50.0}) {
    const auto scene = [&] { return inputs_of_distance(48, 40, [&](int, int y) { return y < 20 ? z : 1e6; }); };
    Settings s = published();
    s.depth.far_plane = 1e6;
    EdgeSplash as_published(s, scene(), executor());
    as_published.next_frame();
    EXPECT_EQ(painted(as_published, 24, 21), z < 3.614) << z;
    Settings c = corrected();
    c.depth = s.depth;
    EdgeSplash corrected_one(c, scene(), executor());
    corrected_one.next_frame();
    EXPECT_TRUE(painted(corrected_one, 24, 20)) << z;
  }
}

// Over all directions of a gradient the closed half-plane is one half of them and its two ends' one.
TEST(EdgeSplashMask, PublishedAngleIsAHalfPlane) {
  int passed = 0;
  const int directions = 360;
  for (int k = 0; k < directions; ++k) {
    const double a = k % 90 == 0 ? std::round(std::cos(k * pi / 180)) : std::cos(k * pi / 180),
                 b = k % 180 == 0 ? 0 : std::sin(k * pi / 180);
    PublishedSplashUniforms u{};
    u.width = u.height = 16;
    u.thickness = 3;
    u.noise_width = u.noise_height = 2;
    const Field ramp(16, 16, Address::border, [&](int x, int y) { return 1 + 0x1p-6 * (a * (x - 8) + b * (y - 8)); });
    const Field noise(2, 2, Address::border, [](int, int) { return 1.0; });
    scalar::Channels<F, 4> scene;
    const auto s = scalar::splash_as_published<F>(u, ramp.view(), noise.view(), scene, 8, 8);
    EXPECT_EQ(s.angle.v == 1, b < 0 || (b == 0 && a > 0)) << k;
    passed += s.angle.v == 1;
  }
  EXPECT_EQ(passed, directions / 2);
}

// Every edge of a disc before a wall that faces up, and none that faces down.
TEST(EdgeSplashMask, CorrectedAngleOfALoop) {
  Settings s = corrected();
  s.widest_angle_deg = 90;
  s.band = 0.02;
  s.vertical_fov_deg = 40;
  EdgeSplash e(s,
               inputs_of_distance(121, 121, [](int x, int y) { return (x - 60) * (x - 60) + (y - 60) * (y - 60) < 40 * 40 ? 2.0 : 6.0; }),
               executor());
  e.next_frame();
  int upper = 0, lower = 0;
  for (int y = 0; y < 121; ++y) {
    for (int x = 0; x < 121; ++x) {
      if (code(e.edge(), x, y) < 255) continue;
      (y > 60 ? upper : lower) += 1;
      // The stairs of a raster have level gradients along the sides: 90 degrees, which is not above the horizon.
      if (y > 85 || y < 60) {
        EXPECT_EQ(code(e.angle(), x, y), y > 60 ? 255 : 0) << x << "," << y;
      }
    }
  }
  EXPECT_GT(upper, 100);
  EXPECT_NEAR(static_cast<double>(upper) / (upper + lower), 0.5, 0.03);  // the row of the centre counts below
}

// Where the map's size divides the picture's, the mask's count is the map's histogram, exactly.
TEST(EdgeSplashMask, PublishedNoiseCountIsTheHistogram) {
  for (const double scale : {0.0, 0.25, 0.5, 0.9}) {
    Settings s = published();
    s.thickness = 0;  // no border is passed over
    s.rain_drop_scale = scale;
    s.drop_speed = 60;
    Inputs in = inputs_of(128, 64, [](int, int) { return 0.5; });
    in.noise = uniform_noise(32);
    EdgeSplash e(s, in, executor());
    for (int frame = 0; frame < 3; ++frame) {
      e.next_frame();
      int count = 0, expected = 0;
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 128; ++x) count += code(e.noise(), x, y) == 255;
      }
      for (int c = 0; c < 256; ++c) expected += static_cast<float>(c) / 255.0f >= static_cast<float>(scale) ? 4 * 8 : 0;
      EXPECT_EQ(count, expected) << scale << " frame " << frame;
    }
  }
}

// The corrected mask of a map of uniform numbers, hardly softened and sampled at its texels: 1 - scale of it within three
// standard deviations of a binomial. Sampling twice as fine mixes neighbours, so the texels themselves are met here.
TEST(EdgeSplashMask, CorrectedNoiseCoverage) {
  const int side = 128;
  const TextureData map(uniform_noise(side), Address::repeat, Address::repeat);
  SplashUniforms u{};
  u.reach_min = u.reach_max = 1;
  u.depth_scale = 1;
  u.step_low = u.bend_low = u.cosine_low = 1;
  u.step_high = u.bend_high = u.cosine_high = 2;
  u.up[1] = 1;
  u.noise_scale[0] = u.noise_scale[1] = 1.0f / side;
  u.noise_low = 0.7f;
  u.noise_high = 0.70001f;
  const Field flat(4, 4, Address::clamp, [](int, int) { return 0.5; });
  scalar::Channels<F, 4> scene;
  double sum = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) sum += scalar::splash_corrected<F>(u, flat.view(), map.view(), F(1.0f), scene, x, y).noise.v;
  }
  EXPECT_NEAR(sum / side / side, 77.0 / 256, 1e-9) << "codes 179 to 255 lie above .7: 77 of 256, each equally often";
}

// Paint = edge and angle and noise: each changed pixel of the blended picture, counted.
TEST(EdgeSplashMask, ColourChangesWhereAllMasksAgree) {
  Settings s = published();
  s.rain_drop_scale = 0.5;
  s.drop_alpha = 1;
  Inputs in = inputs_of(64, 64, [](int, int y) { return y < 20 ? 0.2 : 0.0; });
  in.noise = uniform_noise(32);
  EdgeSplash e(s, in, executor());
  e.next_frame();
  int changed = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool all = painted(e, x, y) && code(e.noise(), x, y) == 255;
      EXPECT_EQ(to_float(e.colour().row<Half>(y)[4 * x]), all ? 1.0f : 0.25f);
      changed += all;
    }
  }
  // Three rows of 58 pixels and a fair coin: sd 6.6.
  EXPECT_NEAR(changed, 3 * 58 / 2, 4 * 6.6);
}

// v t texels each way; the same picture again after the map's side.
TEST(EdgeSplashMask, PublishedScrollIsDiagonalAndPeriodic) {
  Settings s = published();
  s.thickness = 0;
  s.rain_drop_scale = 0.5;
  s.drop_speed = 60;  // a texel in a frame
  Inputs in = inputs_of(64, 64, [](int, int) { return 0.5; });
  in.noise = uniform_noise(32);
  EdgeSplash e(s, in, executor());
  e.next_frame();
  const Image first = copy_of(e.noise());
  for (int n = 1; n <= 32; ++n) {
    e.next_frame();
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) ASSERT_EQ(code(e.noise(), x, y), code(first, x + n, y + n)) << n;
    }
  }
  EXPECT_TRUE(same(e.noise(), first));
}

TEST(EdgeSplashMask, CorrectedNoiseMovesWithItsVelocity) {
  Settings s = corrected();
  s.rain_drop_scale = 0.5;
  s.noise_size = 0.5;
  s.drop_velocity = {0, -60.0 / 64};  // a pixel down in a frame, of 64
  EdgeSplash e(s, inputs_of_distance(64, 64, [](int, int) { return 5.0; }), executor());
  e.next_frame();
  const Image first = copy_of(e.noise());
  EXPECT_GT(mean(first), 0.1);
  for (int n = 1; n <= 5; ++n) {
    e.next_frame();
    for (int y = 0; y < 58; ++y) {
      for (int x = 0; x < 64; ++x) {
        ASSERT_NEAR(code(e.noise(), x, y), code(first, x, y + n), 2) << n;  // offsets round: 2^-24 of a tile, slope below 2^17 codes
      }
    }
  }
}

TEST(EdgeSplashMask, ThresholdZeroPaintsEverything) {
  Settings s = published();
  s.edge_threshold = 0;
  EdgeSplash e(s, inputs_of(32, 32, [](int, int) { return 0.375; }), executor());
  e.next_frame();
  // step(0, 0) = 1, and atan2(0, 0) = 0 passes the half-plane.
  for (int y = 6; y < 29; ++y) {
    for (int x = 3; x < 29; ++x) EXPECT_TRUE(painted(e, x, y)) << x << "," << y;
  }
}

// ---- what corrected does not depend on -------------------------------------------------------------------------------
// An object 1 m away, its band 2 of 72 rows to each side: as much of the picture at every resolution.
TEST(EdgeSplashMask, CorrectedBandCoversAsMuchOfThePictureAtEveryResolution) {
  Settings s = corrected();
  s.vertical_fov_deg = 2 * std::atan(0.5) * 180 / pi;  // the image plane at 1 m is 1 m high
  s.largest_band = 0.05;
  s.smallest_band = 1e-5;
  s.band = 2.0 / 72;
  for (const int scale : {1, 2, 4}) {
    const int height = 72 * scale;
    EdgeSplash e(s, inputs_of_distance(40 * scale, height, [&](int, int y) { return y < height / 2 ? 1.0 : 9.0; }), executor());
    e.next_frame();
    int rows = 0;
    for (int y = 0; y < height; ++y) rows += painted(e, 20 * scale, y);
    EXPECT_EQ(rows, 4 * scale) << "the reach on both sides of the edge";
  }
}

TEST(EdgeSplashMask, CorrectedDoesNotDependOnTheDepthConvention) {
  const auto scene = [] {
    return inputs_of_distance(96, 54, [](int x, int y) { return y < 20 + x / 8 ? 2.0 + 0.01 * x : (x / 12) % 2 == 0 ? 12.0 : 30.0; });
  };
  Settings s = corrected();
  s.softness = 0.3;
  EdgeSplash reversed(s, scene(), executor());
  s.depth.reversed = false;
  EdgeSplash forward(s, scene(), executor());
  s.depth = {0.1, 200, true};
  EdgeSplash other(s, scene(), executor());
  for (EdgeSplash* e : {&reversed, &forward, &other}) e->next_frame();
  EXPECT_GT(mean(reversed.edge()), 0.02);
  for (int y = 0; y < 54; ++y) {
    for (int x = 0; x < 96; ++x) {
      // Unreversed depths of 30 m keep 2^-24 / .3 m of 1 / z: a millimetre or two, far from any threshold here.
      EXPECT_NEAR(code(reversed.edge(), x, y), code(forward.edge(), x, y), 2);
      EXPECT_NEAR(code(reversed.edge(), x, y), code(other.edge(), x, y), 2);
      EXPECT_NEAR(code(reversed.angle(), x, y), code(forward.angle(), x, y), 2);
    }
  }
}

TEST(EdgeSplashMask, CorrectedScrollDoesNotDependOnTheFrameRate) {
  Settings s = corrected();
  s.drop_velocity = {0.37, -1.41};
  s.fps = 30;
  const SplashUniforms a = splash_uniforms(s, 31, 128, 128);
  for (const int factor : {2, 4, 8}) {
    s.fps = 30 * factor;
    const SplashUniforms b = splash_uniforms(s, 31 * factor, 128, 128);
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(a.noise_offset[k], b.noise_offset[k], 2e-7);
  }
}

// Up is the world's, not the picture's: a camera that lies on its side paints the side that is up.
TEST(EdgeSplashMask, CorrectedUpIsTheWorlds) {
  Settings s = corrected();
  const auto box = [](int x, int y) { return x > 20 && x < 44 && y > 12 && y < 36 ? 2.0 : 8.0; };
  EdgeSplash upright(s, inputs_of_distance(64, 48, box), executor());
  s.camera_up = {1, 0, 0};  // the picture's right is now the world's -y
  EdgeSplash lying(s, inputs_of_distance(64, 48, box), executor());
  upright.next_frame();
  lying.next_frame();
  EXPECT_TRUE(painted(upright, 32, 35) && !painted(upright, 32, 13) && !painted(upright, 21, 24) && !painted(upright, 43, 24));
  EXPECT_TRUE(painted(lying, 21, 24) && !painted(lying, 43, 24) && !painted(lying, 32, 35) && !painted(lying, 32, 13));
}

// Under a camera that looks down verticals converge, and up is where they point at each pixel.
TEST(EdgeSplashMask, CorrectedUpFollowsThePerspective) {
  Settings s = corrected();
  s.camera_target = {0, -1, -1};
  s.width = s.height = 101;
  const SplashUniforms u = splash_uniforms(s, 0, 2, 2);
  EXPECT_NEAR(u.up[1], std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(u.up[2], -std::sqrt(0.5), 1e-6);
  // At X to the right, up leans outward: (u.x - X u.z, u.y - Y u.z).
  const double x = u.half_size[0];
  EXPECT_GT(u.up[0] - x * u.up[2], 0.3);
}

TEST(EdgeSplashMask, CorrectedLayerKeepsDropsAway) {
  Settings s = corrected();
  Inputs in = inputs_of_distance(48, 40, [](int, int y) { return y < 20 ? 2.0 : 9.0; });
  in.layer = plane_of(48, 40, [](int x, int) { return x < 24 ? 1.0 : 0.0; });
  EdgeSplash e(s, in, executor());
  e.next_frame();
  EXPECT_TRUE(painted(e, 10, 20) && painted(e, 40, 20));
  EXPECT_NE(to_float(e.colour().row<Half>(20)[4 * 10]), 0.25f);
  EXPECT_EQ(to_float(e.colour().row<Half>(20)[4 * 40]), 0.25f);
}

}  // namespace
}  // namespace rainref::edge_splash
