// What the blades clear, and how the mask fades (physics: W10, W13).
#include <gtest/gtest.h>

#include "rainref/error.h"
#include "windshield/surface_support.h"

namespace rainref::windshield {
namespace {

// Peak of 65 cycles a minute over 100 degrees [rad/s].
constexpr double peak_rate = pi * 65 / 60 * 100 * pi / 180;

double sector_area(const Blade& b, double turn) {
  const double length = b.outer - b.inner, middle = (b.outer + b.inner) / 2, w = b.half_width;
  return length * middle * turn + 2 * w * middle * turn + 2 * w * length + pi * w * w;
}
double capsule_area(const Blade& b) { return 2 * b.half_width * (b.outer - b.inner) + pi * b.half_width * b.half_width; }

TEST(SurfaceWipe, AreaOfTheSweptSector) {
  for (const double phi : {pi / 2, 75 * pi / 180}) {
    for (const double degrees : {0.0, 0.5, 5.67, 30.0, 110.0}) {
      for (const bool back : {false, true}) {
        Blade b;
        b.outer = 0.6;
        const double turn = degrees * pi / 180, first = 0.6 + (degrees < 100 ? 0.4 : 0), last = first + turn;
        Glass glass(settings_on(true, 2048, 1170, phi), 1);
        glass.wipe({wiper(glass.settings, b, back ? last : first, back ? first : last)});
        // The edge is a ramp of a texel, symmetric about the blade's, so only its curvature and the stored halves count:
        // 1e-3 of the edge's own area, and 2^-12 of what is left at the rim.
        const double edge = 2 * (b.outer - b.inner + b.outer * turn) * 0.7e-3;
        EXPECT_NEAR(glass.cleared(1), sector_area(b, turn), 0.01 * edge + 1e-6) << degrees << " of " << phi << (back ? " back" : "");
      }
    }
  }
}

TEST(SurfaceWipe, AreaOfTheAsPublishedCapsule) {
  Blade b;
  Glass glass(settings_on(false, 2048, 1170), 1);
  glass.settings.wipe_strength = 1;
  glass.wipe({wiper(glass.settings, b, 1.0, 1.1)});
  EXPECT_NEAR(glass.cleared(1), capsule_area(b), 0.01 * 2 * 0.5 * 0.7e-3 + 1e-6) << "where the blade was does not count";
}

TEST(SurfaceWipe, AsPublishedLeavesGapsAtSpeedAndCorrectedNone) {
  for (const double fps : {30.0, 60.0, 144.0}) {
    for (const bool corrected : {false, true}) {
      const Blade b;
      Glass glass(settings_on(corrected, 1024, 592), 1);
      glass.settings.fps = fps;
      const double from = 0.7, to = 2.4, step = peak_rate / fps;
      int frame = 0;
      for (double angle = from; angle < to; angle += step) {
        // Water is drawn anew each frame; here it stays, and what a blade left is to be seen.
        glass.wipe({wiper(glass.settings, b, angle, std::min(to, angle + step), 1 / fps)}, frame++);
      }
      int inside = 0, left = 0;
      for (int y = 0; y < glass.settings.height; ++y) {
        for (int x = 0; x < glass.settings.width; ++x) {
          const double px = 1.4 * (x + 0.5) / glass.settings.width - b.pivot_x, py = 0.8 * (y + 0.5) / glass.settings.height - b.pivot_y;
          const double r = std::hypot(px, py), angle = std::atan2(py, px);
          if (r < b.inner || r > b.outer || angle < from || angle > to) continue;
          ++inside;
          left += at(glass.height, x, y) > 0;
          if (corrected) {
            EXPECT_LT(glass.wiped.row<float>(y)[x], (frame + 1) / fps) << "wiped in this stroke, no seam";
          }
        }
      }
      ASSERT_GT(inside, 100000);
      // A capsule of width 2 w comes every rate / fps: 12 mm of 64 mm at the tip at 60 fps, all of it near the pivot.
      double gaps = 0;
      for (int k = 0; k < 1000; ++k) {
        const double r = b.inner + (b.outer - b.inner) * (k + 0.5) / 1000;
        gaps += r * std::max(0.0, 1 - 2 * b.half_width / (r * step)) / 1000 / ((b.inner + b.outer) / 2);
      }
      // Each gap has two edges that are cleared in part, half a texel each; the ends of the stroke.
      EXPECT_NEAR(static_cast<double>(left) / inside, corrected ? 0 : gaps, corrected ? 0 : 0.05) << fps;
      EXPECT_GT(gaps, fps < 100 ? 0.6 : 0.2);
    }
  }
}

TEST(SurfaceWipe, CoverageIsExactInsideAndNoneOutside) {
  const SurfaceSettings s = settings_on(true, 64, 64);
  const Blade b;
  using D = scalar::Scalar<double>;
  std::mt19937 words(2);
  const double from = 0.8;
  for (const double turn : {0.0, 0.004, 0.1, 0.9, 1.9, 3.1}) {
    for (const bool back : {false, true}) {
      const double to = from + turn;
      const Wiper w = back ? wiper(s, b, to, from) : wiper(s, b, from, to);
      for (int i = 0; i < 20000; ++i) {
        const double x = -0.2 + 1.8 * words() * 0x1p-32, y = -0.7 + 1.6 * words() * 0x1p-32, px = x - b.pivot_x, py = y - b.pivot_y;
        // The distance by cases.
        const double r = std::hypot(px, py), angle = std::fmod(std::atan2(py, px) - from + 2 * pi, 2 * pi);
        const auto to_blade = [&](double a) {
          const double t = std::clamp(px * std::cos(a) + py * std::sin(a), b.inner, b.outer);
          return std::hypot(px - t * std::cos(a), py - t * std::sin(a));
        };
        const double expected = angle <= turn ? std::max({b.inner - r, r - b.outer, 0.0}) : std::min(to_blade(from), to_blade(to));
        ASSERT_NEAR(scalar::sector_distance(w, D(x), D(y)).v, expected, 3e-7)
            << "the record's floats; turn " << turn << " at " << px << " " << py;
      }
    }
  }
}

TEST(SurfaceWipe, TwoWipersAndAParkedOne) {
  for (const bool corrected : {false, true}) {
    Blade left, right;
    left.pivot_x = 0.3;
    left.outer = right.outer = 0.5;
    right.pivot_x = 1.0;
    Glass both(settings_on(corrected, 1024, 592), 1), one(both.settings, 1), parked(both.settings, 1);
    both.settings.wipe_strength = parked.settings.wipe_strength = 1;
    both.wipe({wiper(both.settings, left, 1, 1.1), wiper(both.settings, right, 1, 1.1)});
    one.settings.wipe_strength = 1;
    one.wipe({wiper(both.settings, left, 1, 1.1)});
    EXPECT_NEAR(both.cleared(1), 2 * one.cleared(1), 1e-5);
    parked.wipe({wiper(both.settings, left, 1, 1)});
    EXPECT_NEAR(parked.cleared(1), capsule_area(left), 1e-5);
    Glass none(both.settings, 1);
    none.wipe({});
    EXPECT_EQ(none.cleared(1), 0);
  }
}

TEST(SurfaceWipe, AsPublishedStrengthIsTakenOffOnce) {
  Glass glass(settings_on(false, 256, 148), 8);
  glass.settings.wipe_strength = 3;
  const Blade b;
  glass.wipe({wiper(glass.settings, b, 1.2, 1.2)});
  const int x = static_cast<int>((0.7 + 0.4 * std::cos(1.2)) / 1.4 * 256), y = static_cast<int>((0.05 + 0.4 * std::sin(1.2)) / 0.8 * 148);
  EXPECT_EQ(at(glass.height, x, y), 5);
  for (int i = 0; i < 3; ++i) glass.wipe({wiper(glass.settings, b, 1.2, 1.2)});
  EXPECT_EQ(at(glass.height, x, y), 0) << "and never below nothing";
}

// ---- the mask --------------------------------------------------------------------------------------------------------
/// Frames of this rate after a wipe of everything; gives the mask after each.
std::vector<double> fading(bool corrected, double tau, double fps, int frames, float* wiped = nullptr) {
  SurfaceSettings s = settings_on(corrected, 4, 4);
  s.mask_tau = tau;
  s.fps = fps;
  Glass glass(s, 0);
  for (int y = 0; y < 4; ++y) {
    std::fill_n(glass.mask.row<Half>(y), 4, to_half(1));
    if (corrected) std::fill_n(glass.wiped.row<float>(y), 4, 0.0f);
  }
  std::vector<double> masks;
  for (int frame = 0; frame < frames; ++frame) {
    glass.wipe({}, frame);
    masks.push_back(at(glass.mask, 1, 2));
  }
  if (wiped) *wiped = glass.wiped.row<float>(2)[1];
  return masks;
}
/// Time at which the mask is 1/2 or less; infinity for never.
double half_life(const std::vector<double>& masks, double fps) {
  for (std::size_t i = 0; i < masks.size(); ++i) {
    if (masks[i] <= 0.5) return static_cast<double>(i + 1) / fps;
  }
  return INFINITY;
}

TEST(SurfaceMask, CorrectedFadesAlikeAtEveryFrameRate) {
  for (const double tau : {0.3, 4.0, 5.0, 10.0}) {
    float expected = 0;
    fading(true, tau, 30, static_cast<int>(30 * 6), &expected);
    EXPECT_NEAR(expected / 6, 1, 1e-6 * std::max(1.0, tau / 6));
    for (const double fps : {30.0, 60.0, 144.0, 240.0}) {
      float wiped = 0;
      const std::vector<double> masks = fading(true, tau, fps, static_cast<int>(fps * 12), &wiped);
      EXPECT_EQ(fading(true, tau, fps, static_cast<int>(fps * 6), &wiped).size(), static_cast<std::size_t>(fps * 6));
      EXPECT_EQ(wiped, expected) << tau << " at " << fps << ": the same bits";
      EXPECT_NEAR(half_life(masks, fps), tau * std::log(2), 1 / fps + 1e-3) << tau << " at " << fps;
      for (std::size_t i = 0; i < masks.size(); i += 7) {
        // Half an ulp of a half, relative; what is below 2^-14 is absolute.
        const double exact = std::exp(-static_cast<double>(i + 1) / fps / tau);
        ASSERT_NEAR(masks[i], exact, 0x1p-11 * exact + 0x1p-25) << tau << " at " << fps;
      }
    }
  }
}

TEST(SurfaceMask, CorrectedForgetsAndStopsCounting) {
  const SurfaceSettings s = settings_on(true, 4, 4);
  EXPECT_EQ(wiped_limit(4), 128) << "2^24 of 4 s / 2^19";
  EXPECT_EQ(wiped_limit(10), 256);
  // Never wiped: the limit is more than 16 time constants, which a half does not tell from nothing.
  EXPECT_LT(std::exp(-16), 0x1p-23);
  Glass glass(s, 0);
  glass.wipe({});
  EXPECT_EQ(glass.wiped.row<float>(0)[0], 128);
  EXPECT_EQ(at(glass.mask, 0, 0), 0);
}

TEST(SurfaceMask, AsPublishedStallsInHalves) {
  // The store leaves m where m (1 - k) < ulp / 2: for m in [1/2, 1) at 2^-12 / (1 - k). tau = 10 s (physics: W13).
  const double keep_240 = std::exp(-1.0 / 2400);
  const std::vector<double> at_240 = fading(false, 10, 240, 240 * 60);
  EXPECT_NEAR(at_240.back(), 0x1p-12 / (1 - keep_240), 0x1p-11);
  EXPECT_NEAR(at_240.back(), 0.5859, 1e-4);
  EXPECT_EQ(half_life(at_240, 240), INFINITY) << "it never reaches a half";
  EXPECT_NEAR(half_life(fading(false, 10, 120, 120 * 20), 120), 7.50, 0.02);
  for (const double fps : {30.0, 60.0}) EXPECT_NEAR(half_life(fading(false, 10, fps, static_cast<int>(fps * 20)), fps), 6.93, 0.12) << fps;
  // A shader that truncates fades too fast instead.
  SurfaceSettings s = settings_on(false, 4, 4);
  s.mask_tau = 10;
  s.fps = 240;
  s.rounding = Rounding::rtz;
  Glass glass(s, 0);
  for (int y = 0; y < 4; ++y) std::fill_n(glass.mask.row<Half>(y), 4, to_half(1));
  for (int frame = 0; frame < 240 * 6; ++frame) glass.wipe({}, frame);
  EXPECT_LT(at(glass.mask, 0, 0), std::exp(-0.6) - 0.05);
}

TEST(SurfaceMask, FollowsTheBlade) {
  for (const bool corrected : {false, true}) {
    Glass glass(settings_on(corrected, 1024, 592), 1);
    const Blade b;
    glass.wipe({wiper(glass.settings, b, 1.2, 1.25)});
    const auto under = [&](double r, double angle) {
      return at(glass.mask, static_cast<int>((0.7 + r * std::cos(angle)) / 1.4 * 1024),
                static_cast<int>((0.05 + r * std::sin(angle)) / 0.8 * 592));
    };
    EXPECT_EQ(under(0.4, 1.25), 1);
    EXPECT_EQ(under(0.4, 1.22), corrected ? 1 : 0) << "swept, but the blade is past";
    EXPECT_EQ(under(0.4, 1.4), 0);
  }
}

TEST(SurfaceWipe, TexturesThatDoNotFitAreRefused) {
  const SurfaceSettings s = settings_on(true, 8, 8);
  Image height = filled(8, 8, 0), mask = make_mask(s), narrow = filled(7, 8, 0), normal(Format::rgba16f, 8, 8);
  const auto wipe = [&](bool corrected, const WipedTextures& textures) {
    pass::Run<WipeTexturePass>(wipe_texture_uniforms(s, 0), corrected, Rounding::rne, wipe_texture_io(corrected, {}, textures));
  };
  EXPECT_NO_THROW(wipe(false, {&height, &mask, nullptr}));
  EXPECT_THROW(wipe(true, {&height, &mask, nullptr}), Error);
  EXPECT_THROW(wipe(false, {&height, &narrow, nullptr}), Error);
  EXPECT_THROW(run_normals(two_threads(), s, height, narrow, normal), Error);
}

}  // namespace
}  // namespace rainref::windshield
