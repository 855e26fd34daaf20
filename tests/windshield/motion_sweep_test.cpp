// What a blade sweeps: areas by geometry, the chord of the published quad (physics: W10), no gap at any speed.
#include <gtest/gtest.h>

#include "windshield/sweep_geometry.h"

namespace rainref::windshield {
namespace {

using N = scalar::Scalar<float>;

struct Area {
  double value, error;  // error: half a cell along the outline
};
template <class Inside>
Area count(Inside inside, double perimeter) {
  constexpr int columns = 1750, rows = 1000;
  const WipeDropsUniforms u = uniforms_of({}, corrected);
  int hits = 0;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const auto p = scalar::to_plane(u.frame, N(static_cast<float>((x + 0.5) / columns)), N(static_cast<float>((y + 0.5) / rows)));
      hits += inside(p.x, p.y);
    }
  }
  const double cell = 1.4 / columns;
  return {hits * cell * (0.8 / rows), perimeter * cell / 2};
}
TEST(MotionSweep, SweptAreasAreThoseOfGeometry) {
  const double w = 0.03;
  const WiperSettings s = inner_blade(60, w);
  const Blade& b = s.blades[0];
  const double length = b.outer_radius - b.inner_radius, middle = 0.5 * (b.outer_radius + b.inner_radius);
  for (const auto& [from, to] : {std::pair{0.2, 0.22}, std::pair{0.2, 0.3}, std::pair{0.8, 0.65}}) {
    // The last one turns back.
    const std::vector<Wiper> records =
        wipers_between(s, default_glass().plane(), from < to ? from : 1 - from + 0.5, from < to ? to : 1 - to + 0.5, corrected);
    ASSERT_EQ(records.size(), 1u);
    const Wiper& record = records[0];
    const double turn = std::abs(
        std::remainder(std::atan2(record.axis[1], record.axis[0]) - std::atan2(record.previous_axis[1], record.previous_axis[0]), 2 * pi));
    const double perimeter = 2 * length + 2 * (middle + w) * turn + 2 * pi * w;

    const Area sweep = count([&](N x, N y) { return scalar::in_sweep(record, x, y); }, perimeter);
    EXPECT_NEAR(sweep.value, length * middle * turn + 2 * w * middle * turn + 2 * w * length + pi * w * w, sweep.error);
    const WipeDropsUniforms u = uniforms_of(records, false);
    const Area quad = count([&](N x, N y) { return scalar::in_quad(u, record, x, y); }, perimeter);
    EXPECT_NEAR(quad.value, length * middle * std::sin(turn), quad.error);
    const Area capsule = count(
        [&](N x, N y) { return scalar::under_blade(record, record.axis, x - N(record.pivot[0]), y - N(record.pivot[1])); }, perimeter);
    EXPECT_NEAR(capsule.value, 2 * w * length + pi * w * w, capsule.error);
  }
}

// A move too small for the axes' floats: its sector is no wider than the blade, and does not reach through the pivot.
TEST(MotionSweep, ATinyMoveSweepsOneSideOfThePivot) {
  Wiper w{};
  w.previous_axis[0] = w.axis[0] = 1;
  w.inner_radius = 0.2f;
  w.outer_radius = 0.6f;
  w.half_width = 0.01f;
  w.direction = 1;
  EXPECT_TRUE(scalar::in_sweep(w, N(0.4f), N(0.0f)));
  EXPECT_FALSE(scalar::in_sweep(w, N(-0.4f), N(0.0f)));
}

// However fast the blade and slow the frames: each point of the whole stroke is swept by one of its steps.
TEST(MotionSweep, FastWipersLeaveNoGap) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double cycles_per_minute : {45.0, 65.0, 600.0}) {
    for (const double fps : {10.0, 30.0, 60.0, 144.0}) {
      WiperSettings s = inner_blade(cycles_per_minute, 1e-4);
      const Blade& b = s.blades[0];
      std::vector<Wiper> all;
      for (int n = 0; n < 0.5 * fps * 60 / cycles_per_minute; ++n) {
        for (const Wiper& w : wipers_between(s, default_glass().plane(), n / fps, (n + 1) / fps, corrected)) all.push_back(w);
      }
      for (int i = 0; i < 2000; ++i) {
        const double angle = b.start_angle + unit(random) * b.sweep,
                     radius = b.inner_radius + unit(random) * (b.outer_radius - b.inner_radius);
        const N x(static_cast<float>(b.pivot[0] + radius * std::cos(angle))), y(static_cast<float>(b.pivot[1] + radius * std::sin(angle)));
        EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Wiper& w) { return scalar::in_sweep(w, x, y); }))
            << cycles_per_minute << " " << fps;
      }
    }
  }
}

}  // namespace
}  // namespace rainref::windshield
