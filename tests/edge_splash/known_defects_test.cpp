// What the article's shader gets wrong, one test a row of docs/effects/edge_splash.md: as-published does it, corrected does not.
#include "edge_splash/support.h"
#include "random/counter.h"

namespace rainref::edge_splash {
namespace {

const parallel::Executor& executor() {
  static const parallel::Executor one(1);
  return one;
}
/// Depths without pattern, in [0, top).
double speckle(int x, int y, double top) {
  return top * random::uniform(random::pcg4d({static_cast<std::uint32_t>(x + 1000), static_cast<std::uint32_t>(y + 1000), 5, 6})[0]);
}
/// How much one texel counts in the published sums at (32, 32), and in the corrected ones.
struct Influence {
  double x, y;
};
Influence published_influence(int thickness, double centre, int dx, int dy) {
  const auto with = [&](double bump) {
    const Field f(64, 64, Address::border,
                  [&](int x, int y) { return (x == 32 && y == 32 ? centre : 0.5) + (x == 32 + dx && y == 32 + dy ? bump : 0); });
    return published_gradient<D>(thickness, f, 32, 32);
  };
  const auto a = with(0), b = with(0.25);
  return {(b.x.v - a.x.v) / 0.25, (b.y.v - a.y.v) / 0.25};
}
Influence corrected_influence(int reach, int dx, int dy) {
  const auto with = [&](double bump) {
    const Field f(64, 64, Address::clamp, [&](int x, int y) { return 1 / (2 + (x == 32 + dx && y == 32 + dy ? bump : 0)); });
    return corrected_gradient<D>(reach, f, 32, 32);
  };
  const auto a = with(0), b = with(0.25);
  return {(b.x.v - a.x.v) / 0.25, (b.y.v - a.y.v) / 0.25};
}
void expect_influence(Influence found, double x, double y) {
  EXPECT_NEAR(found.x, x, 1e-5);
  EXPECT_NEAR(found.y, y, 1e-5);
}
DepthOf ledge(double near, double sky) {
  return [=](int, int y) { return y < 20 ? near : sky; };
}

TEST(EdgeSplashKnownDefects, Defect01_BottomLeftTapIsTheTopLeftOne) {
  // T = 16 and d = 1/4 put the taps one texel apart, around the row below the pixel: bottom left is (-1, -2).
  expect_influence(published_influence(16, 0.25, -1, -2), 0, 0);
  expect_influence(published_influence(16, 0.25, -1, 0), -2, 0);  // p0 and p6: -1 - 1 in x, -1 + 1 in y
  expect_influence(corrected_influence(1, -1, -1), -1, -1);
  expect_influence(corrected_influence(1, -1, 1), -1, 1);
}

TEST(EdgeSplashKnownDefects, Defect02_OneTapDoesNotShrinkWithDistance) {
  expect_influence(published_influence(16, 0.25, 0, -2), 0, 0);    // where p1 would be
  expect_influence(published_influence(16, 0.25, 0, -17), 0, -2);  // where it is
  for (const int reach : {1, 4}) expect_influence(corrected_influence(reach, 0, -reach), 0, -2);
}

TEST(EdgeSplashKnownDefects, Defect03_TheKernelLiesLower) {
  // No row above the pixel is read.
  for (int dx = -2; dx <= 2; ++dx) {
    for (int dy = 1; dy <= 3; ++dy) expect_influence(published_influence(16, 0.25, dx, dy), 0, 0);
  }
  expect_influence(published_influence(16, 0.25, 1, -1), 2, 0);  // p5 in the row below
  expect_influence(corrected_influence(2, 0, 2), 0, 2);
}

TEST(EdgeSplashKnownDefects, Defect04_TruncationMakesLopsidedTaps) {
  // T d^2 < 1 nearly everywhere: the offsets are -1 and 0.
  const Field f(64, 64, Address::border, [](int x, int y) { return speckle(x, y, 0.5); });
  const auto d = [&](int x, int y) { return static_cast<double>(f.view().texels[64 * y + x]); };
  for (int y = 8; y < 56; y += 3) {
    for (int x = 8; x < 56; x += 3) {
      const auto g = published_gradient<D>(3, f, x, y);
      EXPECT_NEAR(g.x.v, -4 * d(x - 1, y - 1) + d(x, y - 2) + 3 * d(x, y - 1), 1e-12);
      EXPECT_NEAR(g.y.v, 3 * d(x, y - 1) - 2 * d(x, y - 4) - d(x, y - 2), 1e-12);
    }
  }
  // An empty sky: gx = 0, gy = 2 (D(y) - D(y - T)); with p1 repaired nothing would be left at a distance.
  const Field sky(64, 64, Address::border, [](int, int y) { return y < 30 ? 0.2 : 0.0; });
  EXPECT_EQ(published_gradient<D>(3, sky, 32, 32).y.v, -2 * static_cast<double>(0.2f));
  // A mirrored picture has the mirrored mask, corrected; not as published.
  const auto scene = [](bool mirrored) {
    return inputs_of_distance(64, 48, [=](int x, int y) { return (mirrored ? 63 - x : x) + 2 * y < 90 ? 2.0 : 9.0; });
  };
  for (const bool is_corrected : {false, true}) {
    const Settings s = is_corrected ? corrected() : published();
    EdgeSplash a(s, scene(false), executor()), b(s, scene(true), executor());
    a.next_frame();
    b.next_frame();
    int differing = 0;
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) differing += code(a.edge(), x, y) != code(b.edge(), 63 - x, y);
    }
    if (is_corrected)
      EXPECT_EQ(differing, 0);
    else
      EXPECT_GT(differing, 10);
  }
}

TEST(EdgeSplashKnownDefects, Defect05_DeviceDepthTurnsTheEffectOver) {
  // The same ledge by the other convention: its lower edge is painted, not its upper one.
  const auto slab = [] { return inputs_of_distance(64, 64, [](int, int y) { return y >= 20 && y < 40 ? 0.6 : 900.0; }); };
  for (const bool is_corrected : {false, true}) {
    Settings s = is_corrected ? corrected() : published();
    for (const bool reversed : {true, false}) {
      s.depth.reversed = reversed;
      EdgeSplash e(s, slab(), executor());
      e.next_frame();
      int upper = 0, lower = 0;
      for (int y = 10; y < 50; ++y) (y >= 30 ? upper : lower) += painted(e, 32, y);
      if (is_corrected || reversed) {
        EXPECT_GT(upper, 0);
        EXPECT_EQ(lower, 0);
      } else {
        EXPECT_EQ(upper, 0);
        EXPECT_GT(lower, 0);
      }
    }
  }
}

TEST(EdgeSplashKnownDefects, Defect06_ReadsOutsideMakeEdgesAtTheBorder) {
  // A wall of constant depth has no edge. T = 3 guards three rows; the taps reach 3 + 3 d^2.
  const auto wall = [] { return inputs_of(48, 40, [](int, int) { return 0.75; }); };
  EdgeSplash a(published(), wall(), executor()), c(corrected(), wall(), executor());
  a.next_frame();
  c.next_frame();
  int border = 0, inside = 0;
  for (int y = 3; y < 37; ++y) (y < 6 ? border : inside) += code(a.edge(), 24, y) == 255;
  EXPECT_EQ(border, 2);  // rows 3 and 4: T d^2 = 1.69 moves p1 to row y - 5
  EXPECT_EQ(inside, 0);
  EXPECT_EQ(mean(c.edge()), 0);
}

TEST(EdgeSplashKnownDefects, Defect07_ThePrintedKernelIsUpsideDown) {
  // The text's vertical kernel has (1 2 1) in the row y - 1, its expanded sum and the code -1 there: the code's sign is positive
  // where depth grows with y. By the printed kernel the other half-plane would pass.
  const Field ramp(32, 32, Address::border, [](int, int y) { return 0.25 + 0x1p-8 * y; });
  const auto code_sign = published_gradient<D>(16, ramp, 16, 18);
  EXPECT_GT(code_sign.y.v, 0);
  // Corrected distances: farther above, gy > 0, faces up.
  const Field inverse(32, 32, Address::clamp, [](int, int y) { return 1 / (2 + 0.1 * y); });
  EXPECT_GT(corrected_gradient<D>(1, inverse, 16, 16).y.v, 0);
  EdgeSplash c(corrected(), inputs_of_distance(32, 40, ledge(2, 9)), executor());
  c.next_frame();
  EXPECT_TRUE(painted(c, 16, 20));
}

TEST(EdgeSplashKnownDefects, Defect08_VerticalEdgesOfOneSidePass) {
  // gy = +0 and gx > 0 is angle 0, inside the closed half-plane; gx < 0 is pi, outside. T = 12 and d = 1/2: taps 3 apart.
  const auto step = [](int sign) {
    const Field f(64, 64, Address::border, [=](int x, int) { return sign * (x - 32) > 0 ? 0.75 : 0.5; });
    PublishedSplashUniforms u{};
    u.width = u.height = 64;
    u.thickness = 12;
    u.noise_width = u.noise_height = 2;
    u.edge_threshold = 0.166f;
    scalar::Channels<F, 4> scene;
    const Field noise(2, 2, Address::border, [](int, int) { return 1.0; });
    return scalar::splash_as_published<F>(u, f.view(), noise.view(), scene, 32, 32);
  };
  EXPECT_EQ(step(1).edge.v, 1);
  EXPECT_EQ(step(1).angle.v, 1);
  EXPECT_EQ(step(-1).edge.v, 1);
  EXPECT_EQ(step(-1).angle.v, 0);
  // Multiplying by the angle twice changes nothing: it is 0 or 1.
  Settings s = corrected();
  for (const int side : {-1, 1}) {
    EdgeSplash e(s, inputs_of_distance(64, 48, [=](int x, int) { return side * (x - 32) > 0 ? 2.0 : 9.0; }), executor());
    e.next_frame();
    EXPECT_EQ(code(e.edge(), 32, 24), 255);
    EXPECT_EQ(code(e.angle(), 32, 24), 0);
  }
}

TEST(EdgeSplashKnownDefects, Defect09_ANegativeSpeedReadsOutsideTheNoise) {
  // float % keeps the sign: the index is negative, the read 0, and the rain stops where x + v t < 0.
  Settings s = published();
  s.rain_drop_scale = 0.5;
  s.drop_speed = -60;
  s.thickness = 0;
  Inputs in = inputs_of(64, 64, [](int, int) { return 0.5; });
  in.noise = plane_of(16, 16, [](int, int) { return 1.0; });
  EdgeSplash e(s, in, executor());
  for (int frame = 0; frame <= 20; ++frame) e.next_frame();
  for (int y = 0; y < 64; ++y) {
    // A remainder of -0 is texel 0.
    const auto inside = [](int i) { return i >= 20 || (i - 20) % 16 == 0; };
    for (int x = 0; x < 64; ++x) EXPECT_EQ(code(e.noise(), x, y) == 255, inside(x) && inside(y)) << x << "," << y;
  }
  // x and y scroll alike as published; corrected takes any velocity.
  Settings c = corrected();
  c.rain_drop_scale = 0.5;
  c.drop_velocity = {-1, 2};
  Inputs corrected_in = inputs_of_distance(64, 64, [](int, int) { return 5.0; });
  corrected_in.noise = plane_of(16, 16, [](int, int) { return 1.0; });
  EdgeSplash f(c, corrected_in, executor());
  for (int frame = 0; frame <= 20; ++frame) f.next_frame();
  EXPECT_EQ(mean(f.noise()), 1);
}

TEST(EdgeSplashKnownDefects, Defect10_TheTargetClampsLight) {
  // ARGB32 holds no more than 1. (A target handle never initialised, a null check made twice while the noise is unchecked, a
  // submit inside the pass and a buffer named after another effect have no bits.)
  for (const bool is_corrected : {false, true}) {
    EdgeSplash e(is_corrected ? corrected() : published(),
                 inputs_of(
                     32, 32, [](int, int) { return 0.5; }, 3.0f),
                 executor());
    e.next_frame();
    EXPECT_EQ(to_float(e.colour().row<Half>(16)[4 * 16]), is_corrected ? 3.0f : 1.0f);
  }
}

TEST(EdgeSplashKnownDefects, Defect11_TheScrollLosesItsPrecision) {
  // x + t v in a float: at 2^25 an odd x is no longer there, so that texels come in pairs.
  Settings s = published();
  s.thickness = 0;
  s.rain_drop_scale = 0.5;
  s.fps = 1;
  s.drop_speed = 0x1p25;
  Inputs in = inputs_of(64, 64, [](int, int) { return 0.5; });
  in.noise = uniform_noise(32);
  EdgeSplash e(s, in, executor());
  e.next_frame();
  int before = 0, after = 0;
  for (int x = 0; x < 64; x += 4) before += code(e.noise(), x + 1, 5) != code(e.noise(), x, 5);
  e.next_frame();  // t v = 2^25, a whole number of tiles
  for (int x = 0; x < 64; x += 4) after += code(e.noise(), x + 1, 5) != code(e.noise(), x, 5);
  EXPECT_GT(before, 3);
  EXPECT_EQ(after, 0);
  // Corrected: after a year of frames the offset is the exact one, to 2^-52 of the tiles gone. v = 3 / 7 tiles a second.
  const int frames = 60 * 60 * 24 * 365;
  const double exact = static_cast<double>((3LL * frames) % (7 * 60)) / (7 * 60);
  EXPECT_NEAR(scrolled(3.0 / 7, frames, 60), exact, 4 * 3.0 / 7 * frames / 60 * 0x1p-52);
}

}  // namespace
}  // namespace rainref::edge_splash
