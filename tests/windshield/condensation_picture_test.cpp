// What is seen through the mist of condensed water on the glass.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "image/images.h"
#include "math/half.h"
#include "windshield/golden_scenes.h"
#include "windshield/surface/surface.h"

namespace rainref::windshield {
namespace {

const std::string rain = std::string(wet_drive) + "[rain]\nrate = 120\nsmallest_drop = 0.8\n";
/// Neither rain nor blades.
const std::string dry = "[run]\nsize = [97, 61]\nfps = 60\n[wipers]\ncount = 0\n[rain]\nrate = 0\n[windshield]\nheight_size = [89, 53]\n";

Windshield running(const std::string& toml, int frames, const parallel::Executor& executor) {
  Windshield w(config_of("corrected", toml), small_surroundings(), executor);
  for (int n = 0; n < frames; ++n) {
    w.simulate();
    w.render();
  }
  return w;
}

TEST(Condensation, OfNoneThePictureIsWhatItWas) {
  const parallel::Executor executor(2);
  const Windshield without = running(rain, 20, executor), none = running(rain + "[condensation]\non = true\nmost = 0\n", 20, executor),
                   some = running(rain + "[condensation]\non = true\n", 20, executor);
  EXPECT_TRUE(same(without.colour(), none.colour()));
  EXPECT_FALSE(same(without.colour(), some.colour()));
  EXPECT_TRUE(same(without.height(), some.height())) << "mist is no water of the drops";
}

// All of the light scattered, and all of that from the scene as a whole: one colour over the glass, the coarsest level's, whatever is
// behind.
TEST(Condensation, AFullVeilIsTheMeanOfTheScene) {
  const parallel::Executor executor(2);
  const Windshield w =
      running(dry + "[condensation]\non = true\nmost = 1\nveil = 1\n[blur]\nblur_levels = 6\nfog_density = 0\n", 1, executor);
  const Windshield clear = running(dry + "[blur]\nblur_levels = 6\nfog_density = 0\n", 1, executor);
  double mean[3]{}, least[3]{1e9, 1e9, 1e9}, most[3]{};
  for (int y = 0; y < 23; ++y)
    for (int x = 0; x < 37; ++x)
      for (int c = 0; c < 3; ++c) mean[c] += to_float(w.scene_colour().row<Half>(y)[4 * x + c]) / (37 * 23);
  int on_glass = 0;
  for (int y = 0; y < 61; ++y) {
    for (int x = 0; x < 97; ++x) {
      const Half *seen = w.colour().row<Half>(y) + 4 * x, *before = clear.colour().row<Half>(y) + 4 * x;
      if (std::memcmp(seen, before, 8) == 0) continue;  // beside the glass
      ++on_glass;
      for (int c = 0; c < 3; ++c) {
        least[c] = std::min<double>(least[c], to_float(seen[c]));
        most[c] = std::max<double>(most[c], to_float(seen[c]));
      }
    }
  }
  EXPECT_GT(on_glass, 2000);
  for (int c = 0; c < 3; ++c) {
    // The last level is one texel, a mean of means in halves.
    EXPECT_NEAR(least[c], mean[c], 0.01 * mean[c]);
    EXPECT_NEAR(most[c], mean[c], 0.01 * mean[c]);
  }
}

// An even disc of radius R has variance R^2 / 4 on each axis.
TEST(Condensation, TapsAreADiscWithItsVariance) {
  for (const double lod : {0.0, 2.5, 5.0}) {
    CondensationSettings s;
    s.blur_lod = lod;
    const std::vector<Tap> taps = mist_taps(s, 320, 160);
    const MistUniforms u = mist_uniforms(s, {});
    ASSERT_EQ(static_cast<int>(taps.size()), u.tap_count);
    EXPECT_NEAR(u.weight * static_cast<float>(u.tap_count), 1, 1e-6);
    const double radius = std::exp2(lod);
    double x = 0, y = 0, xx = 0, yy = 0;
    for (const Tap& t : taps) {
      const double px = static_cast<double>(t.x) * 320 / radius, py = static_cast<double>(t.y) * 160 / radius;
      EXPECT_LT(std::hypot(px, py), 1);
      x += px / u.tap_count;
      y += py / u.tap_count;
      xx += px * px / u.tap_count;
      yy += py * py / u.tap_count;
    }
    EXPECT_NEAR(x, 0, 1e-6);
    EXPECT_NEAR(y, 0, 1e-6);
    EXPECT_NEAR(xx, 0.25, 1e-6);
    EXPECT_NEAR(yy, 0.25, 1e-6);
    EXPECT_EQ(u.lod, static_cast<float>(std::max(std::floor(lod - 1.5), 0.0)));
  }
}

// A small lamp before black, behind mist alone: where its light falls to a share of the brightest is a circle.
TEST(Condensation, ALampBehindMistIsRound) {
  constexpr int side = 256;
  const std::string text =
      "[run]\nsize = [256, 256]\n[wipers]\ncount = 0\n[rain]\nrate = 0\n[windshield]\nheight_size = [64, 64]\n[scene]\nmargin = 1\n"
      "[camera]\nvertical_fov_deg = 10\n[blur]\nfog_density = 0\nblur_levels = 8\n[condensation]\non = true\nmost = 1\nveil = 0\nblur_lod "
      "= 4\n";
  const parallel::Executor executor(2);
  for (const int at : {128, 131, 140}) {
    Surroundings around{Image(Format::rgba16f, side, side), Image(Format::r32f, side, side)};
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const bool is_lamp = x >= at && x < at + 3 && y >= at && y < at + 3;
        for (int c = 0; c < 4; ++c) around.colour.row<Half>(y)[4 * x + c] = to_half(is_lamp || c == 3 ? 1000.0f : 0.0f);
        around.depth.row<float>(y)[x] = 100;
      }
    }
    Windshield w(config_of("corrected", text), std::move(around), executor);
    w.next_frame();
    const auto light = [&](double x, double y) {
      const int i = static_cast<int>(std::floor(x - 0.5)), j = static_cast<int>(std::floor(y - 0.5));
      const double a = x - 0.5 - i, b = y - 0.5 - j;
      const auto texel = [&](int column, int row) { return static_cast<double>(to_float(w.colour().row<Half>(row)[4 * column])); };
      return (1 - b) * ((1 - a) * texel(i, j) + a * texel(i + 1, j)) + b * ((1 - a) * texel(i, j + 1) + a * texel(i + 1, j + 1));
    };
    double brightest = 0, sum = 0, across = 0, up = 0;  // the middle of its light: a level's texels may lie to one side of it
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const double here = to_float(w.colour().row<Half>(y)[4 * x]);
        brightest = std::max(brightest, here);
        sum += here;
        across += here * (x + 0.5);
        up += here * (y + 0.5);
      }
    }
    ASSERT_GT(brightest, 0);
    for (const double share : {0.5, 0.1, 0.02}) {
      constexpr int rays = 64;
      double mean = 0, squares = 0;
      for (int k = 0; k < rays; ++k) {
        const double angle = 2 * std::acos(-1.0) * k / rays;
        double r = 0;
        while (r < 60 && light(across / sum + r * std::cos(angle), up / sum + r * std::sin(angle)) > share * brightest) r += 0.125;
        mean += r / rays;
        squares += r * r / rays;
      }
      EXPECT_LT(std::sqrt(squares - mean * mean) / mean, 0.08) << at << ' ' << share << ", radius " << mean;
    }
  }
}

}  // namespace
}  // namespace rainref::windshield
