// Options of pictures: what the curve, the bloom and the dither claim, and that all off is the pass display.
#include "simulation/development.h"

#include <cmath>

#include <gtest/gtest.h>

#include "image/colour.h"
#include "image/images.h"
#include "rainref/error.h"
#include "rainref/simulation.h"
#include "scene/toml.h"
#include "simulation/bloom.h"
#include "simulation/light_mean.h"
#include "simulation/opened.h"
#include "simulation/small_scenes.h"
#include "simulation/tone_curve.h"

namespace rainref::simulation {
namespace {

const parallel::Executor& executor() {
  static const parallel::Executor two(2);
  return two;
}
int code(const Image& image, int x, int y, int c = 0) { return image.row<Unorm8>(y)[4 * x + c].code; }
Image radiance(int width, int height, const std::function<float(int x, int y)>& of) {
  return make_image(Format::rgba32f, width, height, [&](int x, int y, int) { return of(x, y); });
}
double sum(const LightImage& image) {
  double all = 0;
  for (const float x : image.light) all += static_cast<double>(x);
  return all;
}

TEST(ToneCurve, RisesWithSlopeOneUpToItsShoulderAndNearsWhite) {
  for (const double s : {0.0, 0.3, 0.76, 0.99}) {
    const auto grey = [&](double x) { return shown({x, x, x}, s, 0.15)[0]; };
    double before = -1;
    for (double x = 0; x < 200; x += x < 2 ? 1.0 / 256 : 0.5) {
      const double y = grey(x);
      EXPECT_GT(y, before) << s << " " << x;
      EXPECT_LE(y, 1);
      if (x <= s) {
        EXPECT_EQ(y, x);
      }
      before = y;
    }
    EXPECT_GT(grey(65504), 0.9999);
    // The slope goes on: 1 - (1 - s)^2 / (x + 1 - 2 s) has it 1 at s, and second derivative -2 / (1 - s).
    const double h = 1e-4 * (1 - s);
    EXPECT_NEAR((grey(s + h) - s) / h, 1, 1.01e-4);
  }
}
TEST(ToneCurve, KeepsHueUntilItFadesToWhite) {
  const Light red{4, 1, 0.5};
  const Light kept = shown(red, 0.5, 0);
  EXPECT_DOUBLE_EQ(kept[1] / kept[0], 0.25);
  EXPECT_DOUBLE_EQ(kept[2] / kept[0], 0.125);
  EXPECT_DOUBLE_EQ(kept[0], 1 - 0.25 / 4) << "1 - (1 - s)^2 / (p + 1 - 2 s)";
  const Light faded = shown(red, 0.5, 0.15), far = shown({4000, 1000, 500}, 0.5, 0.15);
  EXPECT_DOUBLE_EQ(faded[0], kept[0]) << "the brightest channel stays";
  EXPECT_GT(faded[1] / faded[0], 0.25);
  EXPECT_GT(far[2] / far[0], 0.99);
}
TEST(ToneCurve, WithoutShoulderChannelsEndAtOne) { EXPECT_EQ(shown({3, 0.5, 1}, 1, 0.15), (Light{1, 0.5, 1})); }

TEST(Bloom, KeepsALevelPicture) {
  for (const auto& [w, h] : {std::pair{64, 48}, {37, 21}, {1, 1}}) {
    LightImage level(w, h);
    for (float& x : level.light) x = 0.75f;
    // Weights are powers of two and shares 1/4: nothing rounds.
    for (const float x : bloomed(level, 4, executor()).light) ASSERT_EQ(x, 0.75f);
  }
}
TEST(Bloom, KeepsTheSumOfLightWhereverASourceLies) {
  for (const auto& [x, y] : {std::pair{31, 17}, {0, 0}, {127, 63}, {64, 0}}) {
    LightImage spot(128, 64);
    spot.row(y)[3 * x] = 512;
    const LightImage wide = bloomed(spot, 6, executor());
    EXPECT_NEAR(sum(wide), 512, 512 * 1e-5) << "roundings of floats";
    EXPECT_LT(wide.row(y)[3 * x], 512 * 0.1f) << "most of it lies elsewhere";
  }
}
TEST(Bloom, HoldsAsMuchLightInEachOctave) {
  LightImage spot(512, 512);
  spot.row(256)[3 * 256] = 1;
  // Of a blur about 2^k wide most lies within 2^k of its middle: of five levels, five equal shares.
  const LightImage wide = bloomed(spot, 5, executor());
  double within = 0;
  std::vector<double> inside(7);
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 512; ++x) {
      within += static_cast<double>(wide.row(y)[3 * x]);
      for (std::size_t k = 0; k < inside.size(); ++k)
        if (std::hypot(x - 256, y - 256) < 1.5 * (1 << k)) inside[k] += static_cast<double>(wide.row(y)[3 * x]);
    }
  EXPECT_NEAR(within, 1, 1e-5);
  for (std::size_t k = 1; k <= 5; ++k) EXPECT_NEAR(inside[k] - inside[k - 1], 0.2, 0.08) << k;
}
TEST(Bloom, LevelsGoUpToTheRadius) {
  EXPECT_EQ(bloom_levels(720, 0.1), 6) << "64 of 72 pixels";
  EXPECT_EQ(bloom_levels(720, 0.001), 1);
  EXPECT_EQ(bloom_levels(1080, 0.1), 6);
}

TEST(Dither, MeanIsTheLight) {
  for (const double light : {0.0003, 0.01, 0.3, 0.97}) {
    constexpr int draws = 200000;
    double mean = 0, widest = 0;
    for (int i = 0; i < draws; ++i) {
      const int shown_code = dithered_code(light, (i + 0.5) / draws);
      mean += light_of(static_cast<std::uint8_t>(shown_code)) / draws;
      widest = std::max(widest, std::abs(shown_code - 255 * encode_srgb(light)));
    }
    EXPECT_NEAR(mean, light, 1.0 / draws) << "u is spread evenly: one draw of it";
    EXPECT_LT(widest, 1) << "one of the two codes beside it";
  }
}
TEST(Dither, LightOfACodeIsThatCode) {
  for (int k = 0; k < 256; ++k) EXPECT_EQ(dithered_code(light_of(static_cast<std::uint8_t>(k)), 0), k);
  EXPECT_EQ(dithered_code(2, 0.5), 255);
  EXPECT_EQ(dithered_code(-1, 0), 0);
}

// From code 20 to 22 in 512 columns: three levels of 128 to 256 columns without it. The mean of a column of 1024 rows is the light within
// five standard deviations of a draw between two codes, at most half their distance each.
TEST(Dither, AGradientHasNoBands) {
  constexpr int width = 512, height = 1024;
  const double low = light_of(20), high = light_of(22), step = light_of(22) - light_of(21);
  const Image in = radiance(width, height, [&](int x, int) { return static_cast<float>(low + (high - low) * (x + 0.5) / width); });
  const effect::Display display{&in};
  Development options;
  const auto farthest = [&](const Image& picture) {
    double worst = 0;
    for (int x = 0; x < width; ++x) {
      double mean = 0;
      for (int y = 0; y < height; ++y) mean += light_of(static_cast<std::uint8_t>(code(picture, x, y))) / height;
      worst = std::max(worst, std::abs(mean - static_cast<double>(in.row<float>(0)[4 * x])));
    }
    return worst;
  };
  EXPECT_GT(farthest(developed(display, options, 1, 1, 0, executor())), 0.45 * step);
  options.dither = true;
  const Image first = developed(display, options, 1, 1, 0, executor());
  EXPECT_LT(farthest(first), 5 * 0.5 * step / std::sqrt(height));
  EXPECT_FALSE(same(first, developed(display, options, 1, 1, 1, executor()))) << "another frame";
  EXPECT_FALSE(same(first, developed(display, options, 1, 2, 0, executor()))) << "another seed";
  int equal = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) equal += code(first, x, y, 0) == code(first, x, y, 1);
  EXPECT_LT(equal, 0.9 * width * height) << "channels are drawn apart";
}

TEST(Development, BloomKeepsEnergyAndLeavesWhatIsBelowTheThreshold) {
  // 0.25 has no rest in floats; shown without codes it could be compared exactly, with them to half a code of each pixel.
  const Image in = radiance(64, 64, [](int x, int y) { return x == 32 && y == 32 ? 0.9f : 0.1f; });
  Development options;
  options.bloom = 0.5;
  options.bloom_threshold = 0.2;
  const Image shown = developed({&in}, options, 1, 0, 0, executor());
  EXPECT_EQ(code(shown, 0, 0), nearest_code(0.1));
  EXPECT_LT(code(shown, 32, 32), nearest_code(0.6));
  EXPECT_GT(code(shown, 33, 32), code(shown, 0, 0));
}
TEST(Development, ExposureVignetteAndWhatIsNoNumber) {
  const Image in = radiance(9, 9, [](int x, int y) { return x == 0 ? NAN : x == 1 ? -1.0f : x == 2 ? INFINITY : y == 4 ? 0.25f : 0.0f; });
  const Image shown = developed({&in, 1, 0.5}, {}, 1, 0, 0, executor());
  EXPECT_EQ(code(shown, 0, 4), 0);
  EXPECT_EQ(code(shown, 1, 4), 0);
  EXPECT_EQ(code(shown, 2, 4), 255);
  EXPECT_EQ(code(shown, 4, 4), nearest_code(0.5));
  EXPECT_EQ(code(shown, 8, 4), nearest_code(0.5 * (1 - 0.5 * 4 / 9)));
}
TEST(Development, SameBitsForAnyThreads) {
  const Image in = radiance(74, 58, [](int x, int y) { return static_cast<float>((x * 2654435761u + y * 40503u) >> 13 & 255) / 64; });
  Development options{.shoulder = 0.5, .bloom = 0.2, .bloom_threshold = 1, .dither = true};
  const Image expected = developed({&in, 0.3, 0.2}, options, 2, 5, 7, parallel::Executor(1));
  for (const int threads : {2, 3, 8}) {
    parallel::Executor several(threads);
    several.shuffle_tiles(7);
    EXPECT_TRUE(same(developed({&in, 0.3, 0.2}, options, 2, 5, 7, several), expected)) << threads;
  }
}

// What an effect says of its display is what its pass does: a picture developed with nothing on has its codes. The pass takes its code of
// one float and this step of a double, so that a code may go the other way where the light lies between two.
TEST(Development, AllOffIsThePassDisplay) {
  const auto expect = [](const std::string& effect, const std::string& variant, const std::vector<std::string>& keys) {
    std::vector<std::string> dither = keys;
    dither.emplace_back("picture.dither=true");
    Simulation plain(small(effect, variant, keys), executor()), dithered(small(effect, variant, dither), executor());
    plain.next_frame();
    dithered.next_frame();
    Opened opened(scene::parse(small(effect, variant, keys), effect_table()), executor());
    opened.next_frame(nullptr);
    const Image off = developed(*opened.display(), {}, 1, 0, 0, executor());
    int other = 0, far = 0;
    for (int y = 0; y < off.height(); ++y)
      for (int x = 0; x < off.width(); ++x)
        for (int c = 0; c < 3; ++c) {
          const int there = code(plain.picture(), x, y, c);
          other += there != code(off, x, y, c);
          far += std::abs(there - code(off, x, y, c)) > 1;
          EXPECT_LE(std::abs(there - code(dithered.picture(), x, y, c)), 1);
        }
    EXPECT_EQ(far, 0) << effect << " " << variant;
    EXPECT_LE(other, 3 * off.width() * off.height() / 100) << effect << " " << variant;
  };
  for (const auto* effect : {"puddle", "screen_drops", "rainy_glass", "windshield", "edge_splash"})
    for (const auto* variant : {"as-published", "corrected"}) expect(effect, variant, {});
  expect("edge_splash", "as-published", {"edge_splash.storage=rgba8"});
}
// The passes' bits and what the recorder hears do not change; only the picture that is handed out does.
TEST(Development, PassesKeepTheirBits) {
  for (const auto* effect : {"windshield", "puddle"}) {
    Simulation plain(small(effect, "corrected"), executor());
    Simulation bright(small(effect, "corrected", {"picture.shoulder=0.4", "picture.bloom=0.3", "picture.dither=true"}), executor());
    plain.next_frame();
    bright.next_frame();
    EXPECT_FALSE(same(plain.picture(), bright.picture())) << effect;
    for (const std::string& name : plain.buffers()) {
      const Buffer one = plain.buffer(name), other = bright.buffer(name);
      const auto *a = std::get_if<BufferView>(&one), *b = std::get_if<BufferView>(&other);
      if (!a || !b) continue;
      std::vector<std::byte> left(a->row_bytes()), right(b->row_bytes());
      for (int y = 0; y < a->height(); ++y) {
        a->copy_row(y, left.data());
        b->copy_row(y, right.data());
        ASSERT_EQ(left, right) << effect << " " << name << " row " << y;
      }
    }
  }
}

}  // namespace
}  // namespace rainref::simulation
