// The film that blades leave behind them: what is laid down, and how it dries.
#include <gtest/gtest.h>

#include <cmath>

#include "windshield/surface/surface.h"
#include "windshield/surface_support.h"

namespace rainref::windshield {
namespace {

/// The textures of smear behind those of wipe_texture.
struct Smeared {
  Glass glass;
  SmearSettings settings;
  Image profile, laid, smear;

  explicit Smeared(const SurfaceSettings& surface)
      : glass(surface, 0), profile(smear_profile(settings, 7)), laid(make_laid(surface)), smear(make_laid(surface)) {}
  void frame(const std::vector<Wiper>& wipers, int number) {
    glass.wipe(wipers, number);
    SmearUniforms u = smear_uniforms(settings, glass.settings);
    u.wiper_count = static_cast<std::int32_t>(wipers.size());
    pass::HostIo<SmearPass> io;
    io.height = glass.height;
    io.wiped = glass.wiped;
    io.laid = laid;
    io.wipers = wipers;
    io.profile = profile;
    io.smear = smear;
    io.new_laid = laid;
    pass::Run<SmearPass>(u, true, glass.settings.rounding, io).tiles(two_threads(), 8, 16);
  }
  double left(int x, int y, int channel = 2) const { return at(smear, 4 * x + channel, y); }
  /// Of the profile, as a bilinear lookup has it.
  double thickness(double along) const {
    const int n = profile.width();
    const double place = std::clamp(along * n - 0.5, 0.0, n - 1.0);
    const int i = std::min(static_cast<int>(place), n - 2);
    return at(profile, i, 0) + (place - i) * (at(profile, i + 1, 0) - at(profile, i, 0));
  }
};
constexpr int columns = 280, rows = 160;
constexpr double texel = 1.4 / columns;
/// A texel's place from a blade's pivot.
struct Polar {
  double r, angle;
  Polar(const Blade& b, int x, int y)
      : r(std::hypot((x + 0.5) * texel - b.pivot_x, (y + 0.5) * texel - b.pivot_y)),
        angle(std::atan2((y + 0.5) * texel - b.pivot_y, (x + 0.5) * texel - b.pivot_x)) {}
};

// Behind a blade lies its profile, the same all along each arc, and nothing where it never was.
TEST(Smear, LiesInArcsAlongTheBladesWay) {
  Smeared s(settings_on(true, columns, rows));
  s.settings.drying = 60;
  const Blade blade;
  const double from = 0.6, to = 2.4;
  for (int n = 0; n < 10; ++n) s.frame({wiper(s.glass.settings, blade, from + (to - from) * n / 10, from + (to - from) * (n + 1) / 10)}, n);
  int inside = 0, outside = 0;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const Polar p(blade, x, y);
      const double soft = blade.half_width + 2 * texel;
      if (p.r > blade.inner && p.r < blade.outer && p.angle > from && p.angle < to) {
        const double laid = s.thickness((p.r - blade.inner) / (blade.outer - blade.inner));
        // Stored as a half, twice; the place along the blade is good to 1e-6 of 256 columns, whose values differ by 1 at most. What dried
        // in 1/6 s of 60 s is 1/360.
        ASSERT_NEAR(at(s.laid, 4 * x + 2, y), laid, 1e-3) << x << ' ' << y;
        ASSERT_NEAR(s.left(x, y), laid, 1e-3 + 1.0 / 360) << x << ' ' << y;
        ASSERT_NEAR(s.left(x, y, 0), std::cos(p.angle), 1e-3);
        ASSERT_NEAR(s.left(x, y, 1), std::sin(p.angle), 1e-3);
        ++inside;
      } else if (p.r < blade.inner - soft || p.r > blade.outer + soft || p.angle < 0 || p.angle < from - soft / p.r ||
                 p.angle > to + soft / p.r) {
        ASSERT_EQ(s.left(x, y), 0) << x << ' ' << y;
        ++outside;
      }
    }
  }
  EXPECT_GT(inside, 5000);
  EXPECT_GT(outside, 10000);
}

// The thickness falls at an even rate: the thin film is gone first, the thickest streak after `drying`, whatever the frame rate.
TEST(Smear, DriesEvenlyAtEveryFrameRate) {
  for (const int fps : {24, 60, 144, 240}) {
    SurfaceSettings surface = settings_on(true, columns, rows);
    surface.fps = fps;
    Smeared s(surface);
    s.settings.drying = 0.5;
    const Blade blade;
    s.frame({wiper(surface, blade, 1.4, 1.8)}, 0);
    for (int n = 1; n <= fps; ++n) {
      s.frame({}, n);
      for (int y = 60; y < 120; y += 7) {
        const int x = 140;  // straight above the pivot
        const double laid = at(s.laid, 4 * x + 2, y), exact = std::max(laid - n / (fps * 0.5), 0.0);
        ASSERT_GT(laid, 0.01);
        // The time is whole on a grid of some microseconds; the result is a half.
        ASSERT_NEAR(s.left(x, y), exact, 0x1p-11 * exact + 4e-5) << fps << ' ' << n;
        if (2 * n > fps) {
          ASSERT_EQ(s.left(x, y), 0) << "after drying";
        }
      }
    }
  }
}

TEST(Smear, WaterTakesItUpForGood) {
  Smeared s(settings_on(true, columns, rows));
  s.settings.drying = 60;
  const Blade blade;
  s.frame({wiper(s.glass.settings, blade, 1.4, 1.8)}, 0);
  const double dry = at(s.laid, 4 * 140 + 2, 80), half_wet = at(s.laid, 4 * 140 + 2, 90);
  s.glass.height.row<Half>(80)[140] = to_half(0.3f);
  s.glass.height.row<Half>(90)[140] = to_half(0.01f);
  s.frame({}, 1);
  s.glass.height.row<Half>(80)[140] = s.glass.height.row<Half>(90)[140] = to_half(0.0f);
  s.frame({}, 2);
  EXPECT_GT(dry, 0.01);
  EXPECT_EQ(s.left(140, 80), 0) << "under a drop, and after it";
  EXPECT_NEAR(at(s.laid, 4 * 140 + 2, 90), 0.5 * half_wet, 1e-3) << "half of the height that takes all";
}

// Where two blades pass, the one that comes last leaves its film: in a list, the later one.
TEST(Smear, TheLastBladesFilmLies) {
  Smeared s(settings_on(true, columns, rows));
  s.settings.drying = 60;
  Blade left, right;
  left.pivot_x = 0.4;
  right.pivot_x = 1.0;
  const Wiper a = wiper(s.glass.settings, left, 0.6, 1.2), b = wiper(s.glass.settings, right, 2.0, 2.5);
  const auto direction = [&](const std::vector<Wiper>& wipers) {
    s.frame(wipers, 0);
    return s.left(140, 90, 0);
  };
  const Polar of_left(left, 140, 90), of_right(right, 140, 90);
  ASSERT_TRUE(of_left.angle > 0.65 && of_left.angle < 1.15 && of_right.angle > 2.05 && of_right.angle < 2.45);
  EXPECT_NEAR(direction({a, b}), std::cos(of_right.angle), 1e-3);
  EXPECT_NEAR(direction({b, a}), std::cos(of_left.angle), 1e-3);
}

// A thin film with streaks that stand out of it; most of it at the ends, and more of a worn blade.
TEST(Smear, ProfileIsThickestAtTheEndsAndOfAWornBlade) {
  double middle[3]{}, ends[3]{};
  for (std::uint64_t seed = 0; seed < 64; ++seed) {
    for (int k = 0; k < 3; ++k) {
      SmearSettings s;
      s.wear = 0.5 * k;
      const Image p = smear_profile(s, seed);
      double most = 0, mean = 0;
      for (int i = 0; i < p.width(); ++i) {
        ASSERT_GT(at(p, i, 0), 0);
        ASSERT_LE(at(p, i, 0), 1);
        most = std::max(most, at(p, i, 0));
        mean += at(p, i, 0) / p.width();
        const bool is_end = i < p.width() / 50 || i >= p.width() - p.width() / 50;
        if (is_end) ends[k] += at(p, i, 0) / (2 * (p.width() / 50) * 64);
        if (std::abs(i - p.width() / 2) < p.width() / 4) middle[k] += at(p, i, 0) / ((p.width() / 2 - 1) * 64);
      }
      EXPECT_GT(most, 1.5 * mean) << "streaks";
    }
  }
  for (int k = 0; k < 3; ++k) EXPECT_GT(ends[k], 1.2 * middle[k]);
  EXPECT_GT(middle[1], 1.2 * middle[0]);
  EXPECT_GT(middle[2], 1.2 * middle[1]);
  EXPECT_GT(ends[2], ends[0]);
}

}  // namespace
}  // namespace rainref::windshield
