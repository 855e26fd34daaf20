// The mist of condensed water on the glass: how it grows and what clears it.
#include <gtest/gtest.h>

#include <cmath>

#include "windshield/surface/surface.h"
#include "windshield/surface_support.h"

namespace rainref::windshield {
namespace {

/// The textures of condense, by themselves.
struct Mist {
  SurfaceSettings surface;
  CondensationSettings settings;
  Image height, wiped, clear_time, condensation;

  Mist(int width, int rows, double fps, double tau) : surface(settings_on(true, width, rows)) {
    surface.fps = fps;
    settings.on = true;
    settings.tau = tau;
    settings.most = 1;
    height = filled(width, rows, 0);
    wiped = make_wiped(surface);
    clear_time = make_clear_time(settings, surface);
    condensation = Image(Format::r16f, width, rows);
  }
  void all_clear() {
    for (int y = 0; y < clear_time.height(); ++y) std::fill_n(clear_time.row<float>(y), clear_time.width(), 0.0f);
  }
  pass::HostIo<CondensePass> io() {
    pass::HostIo<CondensePass> io;
    io.height = height;
    io.wiped = wiped;
    io.clear_time = clear_time;
    io.condensation = condensation;
    io.new_clear_time = clear_time;
    return io;
  }
  void frame(int number, const parallel::Executor& executor = two_threads()) {
    pass::Run<CondensePass>(condense_uniforms(settings, surface, number), true, surface.rounding, io()).tiles(executor, 4);
  }
  void take_wiped(const Image& from) {
    for (int y = 0; y < from.height(); ++y) std::copy_n(from.row<float>(y), from.width(), wiped.row<float>(y));
  }
  double time(int x, int y) const { return clear_time.row<float>(y)[x]; }
};

TEST(Condensation, GrowsToItsEquilibriumWithTheTimeConstantAtEveryFrameRate) {
  for (const double tau : {0.5, 20.0, 600.0}) {
    for (const int fps : {24, 30, 60, 144, 240}) {
      Mist mist(1, 1, fps, tau);
      mist.all_clear();
      for (int n = 1; n <= 4 * fps; ++n) {
        mist.frame(n - 1);
        // The time is whole on a grid of at most tau / 2^19; one minus an exponential, stored as a half.
        const double exact = 1 - std::exp(-n / (fps * tau));
        ASSERT_NEAR(at(mist.condensation, 0, 0), exact, 0x1p-11 * exact + 0x1p-19 + 0x1p-23) << tau << ' ' << fps << ' ' << n;
      }
    }
  }
}
// A half that is itself kept would stand still where a frame adds less than half its last place (W13): here from 1 - 1/4 on.
TEST(Condensation, DoesNotStandStillNearItsEquilibrium) {
  Mist mist(1, 1, 240, 20);
  mist.all_clear();
  for (int n = 0; n < 240 * 160; ++n) mist.frame(n);
  EXPECT_EQ(at(mist.condensation, 0, 0), 1 - 0x1p-11) << "the half next to 1 - exp(-8)";
}
TEST(Condensation, GlassThatNothingClearsIsMistyFromTheStart) {
  Mist mist(3, 2, 60, 20);
  mist.settings.most = 0.75;
  mist.frame(0);
  for (int x = 0; x < 3; ++x) EXPECT_EQ(at(mist.condensation, x, 1), 0.75) << "exp(-32) is no half's last place";
}

// A drop of radius R whose height is that of a cap passes: where it stood as high as `water` there is none left, at this and that side
// of its path none of its mist is gone.
TEST(Condensation, ADropClearsItsPathToItsOwnWidth) {
  const double radius = 10.3, top = 0.4;
  Mist mist(120, 41, 60, 20);
  mist.settings.water = 0.02;
  const int frames = 80;
  for (int n = 0; n < frames; ++n) {
    for (int y = 0; y < 41; ++y) {
      for (int x = 0; x < 120; ++x) {
        const double q2 = (std::pow(x - 20.0 - n, 2) + std::pow(y - 20.0, 2)) / (radius * radius);
        mist.height.row<Half>(y)[x] = to_half(static_cast<float>(top * std::max(1 - q2, 0.0)));
      }
    }
    mist.frame(n);
  }
  // In the middle of the path, long after it came and long after it left.
  int cleared = 0;
  for (int y = 0; y < 41; ++y) {
    const double beside = std::abs(y - 20), half_chord = std::sqrt(std::max(radius * radius * (1 - 0.02 / top) - beside * beside, 0.0));
    const bool is_cleared = half_chord > 0.5, is_touched = beside < radius;
    cleared += mist.time(50, y) < 10;
    if (is_cleared) {
      // Its rear edge, at least as high as `water`, left 50 - 20 + half_chord frames after the start.
      EXPECT_NEAR(mist.time(50, y) * 60, frames - 31 - half_chord, 1.5) << y << ": a frame, and the height below `water` that follows";
    } else if (!is_touched) {
      EXPECT_EQ(mist.time(50, y), wiped_limit(20)) << y;
    }
  }
  EXPECT_NEAR(cleared, 2 * radius, 1.5) << "its width in texels";
}

// What a blade wiped is as old as the wipe; what it did not reach has all its mist.
TEST(Condensation, ABladeClearsItsArc) {
  SurfaceSettings quick = settings_on(true, 280, 160);
  quick.mask_tau = 0.5;
  Glass glass(quick, 0);
  Mist mist(280, 160, 60, 20);
  mist.surface.mask_tau = 0.5;
  const Blade blade;
  const double from = 0.6, to = 2.4;
  const int frames = 30;
  for (int n = 0; n < frames; ++n) {
    const double begin = from + (to - from) * n / frames, end = from + (to - from) * (n + 1) / frames;
    glass.wipe({wiper(glass.settings, blade, begin, end)}, n);
    mist.take_wiped(glass.wiped);
    mist.frame(n);
  }
  int inside = 0, outside = 0;
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 280; ++x) {
      const double px = (x + 0.5) * 1.4 / 280 - blade.pivot_x, py = (y + 0.5) * 0.8 / 160 - blade.pivot_y;
      const double r = std::hypot(px, py), angle = std::atan2(py, px), edge = 2 * 1.4 / 280;  // two texels for the soft edge
      if (r > blade.inner && r < blade.outer && angle > from && angle < to) {
        // The blade was there at this frame's end at the latest, and its width before or after.
        const double ago = frames - (angle - from) / (to - from) * frames, wide = (blade.half_width + edge) / r / (to - from) * frames;
        ASSERT_NEAR(mist.time(x, y) * 60, ago, 1 + wide) << x << ' ' << y;
        ++inside;
      } else if (r < blade.inner - blade.half_width - edge || r > blade.outer + blade.half_width + edge || angle < 0 ||
                 angle < from - (blade.half_width + edge) / r || angle > to + (blade.half_width + edge) / r) {
        ASSERT_EQ(mist.time(x, y), wiped_limit(20)) << x << ' ' << y;
        ++outside;
      }
    }
  }
  EXPECT_GT(inside, 5000);
  EXPECT_GT(outside, 10000);
  // The time since the wipe ends at 32 time constants of the mask, here at 16 s; the mist's own goes on.
  for (int n = frames; n < 60 * 20; ++n) {
    glass.wipe({}, n);
    mist.take_wiped(glass.wiped);
    mist.frame(n);
  }
  EXPECT_EQ(mist.wiped.row<float>(100)[140], 16);
  EXPECT_NEAR(mist.time(140, 100), 20 - 0.25, 0.1);
}

}  // namespace
}  // namespace rainref::windshield
