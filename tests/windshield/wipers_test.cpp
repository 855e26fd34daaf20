// Wipers: the law of motion (physics: W11), records of a step, arrangements and what they clear.
#include <gtest/gtest.h>

#include "windshield/scalar.h"
#include "windshield/support.h"

namespace rainref::windshield {
namespace {

using testing::HasSubstr;

Blade blade(double start = 10 * degree, double sweep = 100 * degree) { return {{0.7, -0.06}, 0.16, 0.65, start, sweep, 0}; }

TEST(Wipers, TheAngleFollowsTheCosineLaw) {
  const Blade b = blade();
  const double f = 65.0 / 60;
  for (double t = 0; t < 3; t += 0.017) {
    EXPECT_NEAR(wiper_angle(b, 65, t), b.start_angle + 0.5 * b.sweep * (1 - std::cos(2 * pi * f * t)), 1e-13);
  }
  // The peak rate is pi f A, a quarter of a cycle after rest; 5.94 rad/s here.
  const double h = 1e-5, quarter = 0.25 / f;
  EXPECT_NEAR((wiper_angle(b, 65, quarter + h) - wiper_angle(b, 65, quarter - h)) / (2 * h), pi * f * b.sweep, 1e-8);
  EXPECT_NEAR(pi * f * b.sweep, 5.94, 0.005);
  // The blade passes a share s of the sweep at acos(1 - 2 s) / (2 pi f), and at 1/f minus that.
  for (const double s : {0.1, 0.5, 0.9}) {
    const double passing = std::acos(1 - 2 * s) / (2 * pi * f);
    EXPECT_NEAR(wiper_angle(b, 65, passing), b.start_angle + s * b.sweep, 1e-13);
    EXPECT_NEAR(wiper_angle(b, 65, 1 / f - passing), b.start_angle + s * b.sweep, 1e-13);
  }
}

TEST(Wipers, ASteppedRecordIsItsTwoPoses) {
  WiperSettings s;
  s.blades = {blade()};
  s.cycles_per_minute = 60;
  const Glass glass = default_glass();
  const PlaneFrame plane = glass.plane();
  const std::vector<Wiper> records = wipers_between(s, plane, 0.1, 0.1 + 1.0 / 60, true);
  ASSERT_EQ(records.size(), 1u);
  const Wiper& w = records[0];
  const double a0 = wiper_angle(s.blades[0], 60, 0.1), a1 = wiper_angle(s.blades[0], 60, 0.1 + 1.0 / 60);
  EXPECT_NEAR(w.previous_axis[0], std::cos(a0), 6e-8);
  EXPECT_NEAR(w.axis[1], std::sin(a1), 6e-8);
  EXPECT_NEAR(w.rate, (a1 - a0) * 60, 1e-6);
  EXPECT_EQ(w.direction, 1);
  // The ends in the plane, from uv.
  const Real2 outer = plane.to_plane({w.outer[0], w.outer[1]});
  EXPECT_NEAR(outer[0], 0.7 + 0.65 * std::cos(a1), 1e-6);
  EXPECT_NEAR(outer[1], -0.06 + 0.65 * std::sin(a1), 1e-6);
}

// Steps join without a gap to the bit; the angles of a whole cycle add up to twice the sweep, forth and back.
TEST(Wipers, StepsJoinAndReversalsAreSplit) {
  const Glass glass = default_glass();
  for (const double cycles_per_minute : {37.0, 45.0, 65.0, 240.0}) {
    for (const double fps : {24.0, 60.0, 7.0}) {
      WiperSettings s;
      s.blades = {blade(170 * degree, -90 * degree)};
      s.cycles_per_minute = cycles_per_minute;
      double travelled = 0, lowest = 10, highest = -10;
      Wiper before = wipers_at(s, glass.plane(), 0)[0];
      EXPECT_EQ(before.direction, 0);
      EXPECT_EQ(before.axis[0], before.previous_axis[0]);
      EXPECT_EQ(before.rate, 0);
      for (int n = 0; n < 120; ++n) {
        for (const Wiper& w : wipers_between(s, glass.plane(), n / fps, (n + 1) / fps, true)) {
          EXPECT_EQ(w.previous_axis[0], before.axis[0]);
          EXPECT_EQ(w.previous_axis[1], before.axis[1]);
          const double a0 = std::atan2(w.previous_axis[1], w.previous_axis[0]), a1 = std::atan2(w.axis[1], w.axis[0]);
          EXPECT_EQ(w.direction, a1 > a0 ? 1 : -1);
          travelled += std::abs(a1 - a0);
          lowest = std::min(lowest, a1);
          highest = std::max(highest, a1);
          before = w;
        }
      }
      // 120 / fps seconds; what is left over of the last stroke is below half a cycle.
      const double strokes = std::floor(2 * cycles_per_minute / 60 * 120 / fps);
      EXPECT_GE(travelled, strokes * 90 * degree - 1e-4) << cycles_per_minute << " " << fps;
      EXPECT_LE(travelled, (strokes + 1) * 90 * degree + 1e-4);
      EXPECT_NEAR(lowest, 80 * degree, 1e-6);
      EXPECT_NEAR(highest, 170 * degree, 1e-6);
    }
  }
}

// Symmetric around a reversal: one published record stands still, the corrected ones sweep there and back.
TEST(Wipers, AStepOverAReversalSweepsWhatItPassed) {
  WiperSettings s;
  s.blades = {blade()};
  s.cycles_per_minute = 60;
  const PlaneFrame plane = default_glass().plane();
  const std::vector<Wiper> published = wipers_between(s, plane, 0.4375, 0.5625, false),
                           corrected = wipers_between(s, plane, 0.4375, 0.5625, true);
  ASSERT_EQ(published.size(), 1u);
  EXPECT_NEAR(published[0].rate, 0, 1e-6);
  ASSERT_EQ(corrected.size(), 2u);
  EXPECT_NEAR(corrected[0].axis[0], std::cos(110 * degree), 1e-7);
  EXPECT_EQ(corrected[0].direction, 1);
  EXPECT_EQ(corrected[1].direction, -1);
  EXPECT_NEAR(corrected[0].rate, -corrected[1].rate, 1e-5);
}

TEST(Wipers, ParkedBladesRest) {
  WiperSettings s = default_wipers(default_glass());
  s.cycles_per_minute = 0;
  for (const bool corrected : {false, true}) {
    const std::vector<Wiper> records = wipers_between(s, default_glass().plane(), 5, 5.1, corrected);
    ASSERT_EQ(records.size(), 2u);
    for (const Wiper& w : records) {
      EXPECT_EQ(w.direction, 0);
      EXPECT_EQ(w.rate, 0);
    }
  }
  s.blades.clear();
  EXPECT_TRUE(wipers_between(s, default_glass().plane(), 0, 1, true).empty());
}

TEST(Wipers, BadBladesAreNamed) {
  const Glass glass = default_glass();
  const auto message = [&](const Blade& b, double half_width = 0.008) {
    WiperSettings s;
    s.blades = {blade(), b};
    s.half_width = half_width;
    return usage_error([&] { check(s, glass); });
  };
  Blade b = blade();
  EXPECT_EQ(message(b), "");
  EXPECT_EQ(message(blade(0, 170 * degree)), "");
  EXPECT_EQ(message(blade(0, 0)), "wipers.sweep_1: expected a turn of at most 170 deg to either side, not 0, found 0 deg");
  EXPECT_THAT(message(blade(0, -171 * degree)),
              HasSubstr("wipers.sweep_1: expected a turn of at most 170 deg to either side, not 0, found -171 deg"));
  b.outer_radius = 2;
  EXPECT_EQ(message(b), "wipers.outer_radius_1: expected a blade of at most 1.612 m, the diagonal of the glass, found 1.84 m");
  b.outer_radius = 0.1;
  EXPECT_EQ(message(b), "wipers.outer_radius_1: expected more than wipers.inner_radius_1 = 0.16 m, found 0.1 m");
  EXPECT_THAT(message(blade(), 0.1),
              HasSubstr("wipers.inner_radius_0: expected at least 0.21 m, two half widths and the largest drop, found 0.16 m"));
}

// Vision areas after EU 1008/2010, annex III, for a driver on the left, where planes through two eye points V1 and V2
// (76 mm below V1) cut the glass:
//   A: 13 degrees to the left, 20 to the right, 3 up from V1, 1 down from V2.
//   B: 17 degrees to the left, its mirror image in the car's middle plane, 7 up from V1, 5 down from V2.
// Where the eyes are is this test's choice: 0.7 m ahead of the rear axle, 0.36 m left of the middle, V1 1.22 m above
// the road. There both areas lie on the flat default glass as a whole.
struct Quad {
  Real2 corner[4];
  bool holds(double u, double v) const {
    for (int i = 0; i < 4; ++i) {
      const Real2 &a = corner[i], &b = corner[(i + 1) % 4];
      if ((b[0] - a[0]) * (v - a[1]) - (b[1] - a[1]) * (u - a[0]) < 0) return false;
    }
    return true;
  }
};
Real2 seen_at(const Glass& g, const Real3& eye, double left, double up) {
  const Real3 ray{1, std::tan(left * degree), std::tan(up * degree)};
  const Real3 to_glass{g.origin[0] - eye[0], g.origin[1] - eye[1], g.origin[2] - eye[2]};
  const double distance = dot(to_glass, g.normal) / dot(ray, g.normal);
  Real3 p{};
  for (int k = 0; k < 3; ++k) p[k] = eye[k] + distance * ray[k] - g.origin[k];
  const double along_u = dot(p, g.e_u), along_v = dot(p, g.e_v);
  return {g.inverse_metric[0] * along_u + g.inverse_metric[1] * along_v, g.inverse_metric[1] * along_u + g.inverse_metric[2] * along_v};
}
double share_cleared(const Quad& area, const Glass& glass, const WiperSettings& s) {
  WipeDropsUniforms u = wipe_drops_uniforms(glass, true, 0, {}, 0, 1, 1);
  // The whole stroke, blades of no width.
  std::vector<Wiper> stroke = wipers_between(s, glass.plane(), 0, 30 / s.cycles_per_minute, true);
  for (Wiper& w : stroke) w.half_width = 0;
  using N = scalar::Scalar<float>;
  int inside = 0, cleared = 0;
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 400; ++x) {
      const double gu = (x + 0.5) / 400, gv = (y + 0.5) / 400;
      if (!area.holds(gu, gv)) continue;
      ++inside;
      const auto p = scalar::to_plane(u.frame, N(static_cast<float>(gu)), N(static_cast<float>(gv)));
      cleared += std::any_of(stroke.begin(), stroke.end(), [&](const Wiper& w) { return scalar::in_sweep(w, p.x, p.y); });
    }
  }
  EXPECT_GT(inside, 10000);
  return static_cast<double>(cleared) / inside;
}

TEST(Wipers, TheArrangementsClearTheVisionAreas) {
  const Glass glass = default_glass();
  const Real3 v1{0.7, 0.36, 1.22}, v2{0.7, 0.36, 1.22 - 0.076};
  const Quad a{{seen_at(glass, v2, 13, -1), seen_at(glass, v2, -20, -1), seen_at(glass, v1, -20, 3), seen_at(glass, v1, 13, 3)}};
  Quad b{{seen_at(glass, v2, 17, -5), {}, {}, seen_at(glass, v1, 17, 7)}};
  b.corner[1] = {1 - b.corner[0][0], b.corner[0][1]};
  b.corner[2] = {1 - b.corner[3][0], b.corner[3][1]};
  for (const Quad& q : {a, b}) {
    for (const Real2& c : q.corner) EXPECT_TRUE(0 < c[0] && c[0] < 1 && 0 < c[1] && c[1] < 1);
  }
  for (const char* arrangement : {"tandem", "opposed"}) {
    const WiperSettings s = default_wipers(glass, arrangement);
    EXPECT_NO_THROW(check(s, glass));
    EXPECT_GE(share_cleared(a, glass, s), 0.98) << arrangement;
    EXPECT_GE(share_cleared(b, glass, s), 0.80) << arrangement;
  }
  // The test can fail: one blade alone does not do.
  WiperSettings one = default_wipers(glass);
  one.blades.pop_back();
  EXPECT_LT(share_cleared(b, glass, one), 0.80);
}

TEST(Wipers, ArrangementsFollowTheGlass) {
  const Glass glass = make_glass(corners_at(30 * degree, 0.7, 0.6));
  const std::vector<Blade> blades = arranged_blades("tandem", 2, glass);
  const std::vector<Blade> usual = arranged_blades("tandem", 2, default_glass());
  EXPECT_NEAR(blades[1].pivot[0], usual[1].pivot[0] / 2, 1e-12);
  EXPECT_NEAR(blades[1].pivot[1], usual[1].pivot[1] * 0.75, 1e-12);
  EXPECT_NEAR(blades[1].outer_radius, usual[1].outer_radius / 2, 1e-12);
  EXPECT_NEAR(usual[1].outer_radius, 0.68, 1e-12);
}

}  // namespace
}  // namespace rainref::windshield
