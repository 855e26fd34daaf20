// The blurred pyramid: means, spreads, odd sizes, fog (physics: W17). Its bits: tests/windshield/determinism_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "blur_pyramid/blur_pyramid.h"
#include "blur_pyramid/scalar.h"
#include "image/images.h"
#include "image/texture.h"
#include "math/half.h"
#include "math/half_array.h"

namespace rainref::blur_pyramid::sampled {
using namespace rainref::scalar;
#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "image/sampling-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
}  // namespace rainref::blur_pyramid::sampled

namespace rainref::blur_pyramid {
namespace {

using F = scalar::Scalar<float>;
using D = scalar::Scalar<double>;

const parallel::Executor& two_threads() {
  static const parallel::Executor executor(2);
  return executor;
}
double at(const Image& image, int x, int y, int c = 0) { return to_float(image.row<Half>(y)[4 * x + c]); }

Image image_of(int width, int height, const std::function<double(int x, int y)>& value) {
  return make_image(Format::rgba16f, width, height,
                    [&](int x, int y, int c) { return to_half(static_cast<float>((c + 1) * value(x, y))); });
}
double mean(const Image& image, int channel = 0) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) sum += at(image, x, y, channel);
  }
  return sum / image.width() / image.height();
}
BlurSettings settings(bool corrected, Rounding rounding = Rounding::rne) {
  BlurSettings s;
  s.corrected = corrected;
  s.rounding = rounding;
  s.levels = Texture::max_levels;
  return s;
}
/// The levels below this image, which is level 0 itself.
std::vector<Image> pyramid(const BlurSettings& s, Image base, const parallel::Executor& executor = two_threads()) {
  const int width = base.width(), height = base.height();
  std::vector<Image> levels = make_levels(s, width, height);
  levels[0] = std::move(base);
  for (std::size_t l = 1; l < levels.size(); ++l) {
    const BlurUniforms u = blur_uniforms(s, width, height, static_cast<int>(l));
    halve_run(u, s.corrected, s.rounding, levels[l - 1], levels[l]).tiles(executor, tile_rows(levels[l].height()));
  }
  return levels;
}

TEST(BlurPyramid, LevelsAreHalvesDownToOneTexel) {
  EXPECT_EQ(level_count(1920, 1080), 11);
  EXPECT_EQ(level_count(1, 1), 1);
  EXPECT_EQ((level_size(5, 1, 1)), (std::array<int, 2>{2, 1}));
  EXPECT_EQ((level_size(1920, 1080, 10)), (std::array<int, 2>{1, 1}));
  BlurSettings s = settings(true);
  s.levels = 3;
  EXPECT_EQ(make_levels(s, 64, 64).size(), 3u);
  EXPECT_EQ(make_levels(s, 2, 2).size(), 2u);
}

TEST(BlurPyramid, MeanOfPowersOfTwoIsExact) {
  // Small integers: every sum of four and its quarter is a half, down to the last level but its rounding. Corrected, sums have 10 bits
  // after the point in the first level, and 20 in the next, which has 11 to store them: half of the last of these a level.
  std::mt19937 words(1);
  const Image base = image_of(64, 32, [&](int, int) { return words() % 2; });
  const double expected = mean(base);
  for (const bool corrected : {false, true}) {
    const std::vector<Image> levels =
        pyramid(settings(corrected), image_of(64, 32, [&, generator = std::mt19937(1)](int, int) mutable { return generator() % 2; }));
    for (std::size_t l = 1; l < levels.size(); ++l) {
      // Level 5 has 10 bits after the point and level 6 the sum of two of those: 11 bits of mantissa.
      const double rounded = corrected ? 0x1p-12 * static_cast<double>(l - 1) : l < 6 ? 0 : 0x1p-12;
      EXPECT_NEAR(mean(levels[l]), expected, rounded) << l;
    }
  }
}

// The address rule mirror, of which images and mirror images alternate.
TEST(BlurPyramid, MirrorsAreThoseOfTheAddressRule) {
  for (int n = 1; n <= 9; ++n) {
    for (int i = -2; i <= n + 2; ++i) {
      const int in_period = ((i % (2 * n)) + 2 * n) % (2 * n);
      EXPECT_EQ(mirrored(i, n), in_period < n ? in_period : 2 * n - 1 - in_period) << i << " of " << n;
    }
  }
}

// A pack says how texels beyond the edge are read, of loads too.
TEST(BlurPyramid, TheLevelAboveIsRecordedWithItsAddressRule) {
  struct Rules : Recorder {
    std::vector<Address> seen;
    void before(const PassStart& start) override {
      for (const PassInput& input : start.inputs) seen.push_back(input.address);
    }
    void pass(const PassCall&) override {}
  };
  const Image above(Format::rgba16f, 6, 4);
  Image out(Format::rgba16f, 3, 2);
  for (const bool corrected : {false, true}) {
    Rules rules;
    halve_run(blur_uniforms(settings(corrected), 6, 4, 1), corrected, Rounding::rne, above, out)
        .start({&rules, 0, 0, 0, 0, Rounding::rne, 1});
    EXPECT_EQ(rules.seen, std::vector<Address>{corrected ? Address::mirror : Address::clamp});
  }
}

TEST(BlurPyramid, OddSizesKeepTheMeanWhenCorrected) {
  for (const std::array<int, 2> size : {std::array<int, 2>{5, 5}, {7, 4}, {33, 19}, {1, 9}, {255, 127}}) {
    const auto value = [&](int x, int y) { return (x * 7 + y * 13) % 5 + (x == size[0] - 1 ? 8 : 0); };
    const double expected = mean(image_of(size[0], size[1], value));
    // In real arithmetic, by the double evaluation.
    const BlurUniforms u = blur_uniforms(settings(true), size[0], size[1], 1);
    const auto [width, height] = level_size(size[0], size[1], 1);
    double sum = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        sum +=
            scalar::halved_corrected<D>(
                u, [&](int i, int j) { return D(static_cast<double>(value(mirrored(2 * x + i, size[0]), mirrored(2 * y + j, size[1])))); },
                x, y)
                .v;
      }
    }
    EXPECT_NEAR(sum / width / height, expected, 1e-6) << size[0] << "x" << size[1] << ": the weights are floats";
    // As stored: half an ulp of a half for each texel, at worst in one direction.
    const std::vector<Image> corrected = pyramid(settings(true), image_of(size[0], size[1], value));
    for (std::size_t l = 1; l < corrected.size(); ++l) EXPECT_NEAR(mean(corrected[l]) / expected, 1, 0x1p-11 * static_cast<double>(l));
    // As published the last column or row is not seen, where it is odd.
    const Image published = std::move(pyramid(settings(false), image_of(size[0], size[1], value))[1]);
    double seen = 0;
    const int columns = size[0] == 1 ? 1 : size[0] / 2 * 2, rows = size[1] == 1 ? 1 : size[1] / 2 * 2;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) seen += value(x, y);
    }
    EXPECT_NEAR(mean(published), seen / columns / rows, 1e-9) << "sums of small integers are exact";
    if (size[0] % 2 && size[0] > 1) {
      EXPECT_GT(std::abs(mean(published) / expected - 1), 0.01);
    }
  }
}

TEST(BlurPyramid, AConstantStaysAtEverySizeAndRounding) {
  for (const bool corrected : {false, true}) {
    for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
      for (const std::array<int, 2> size : {std::array<int, 2>{37, 23}, {3, 1}, {1, 7}, {64, 9}, {2, 2}}) {
        for (const double c : {0.1, 1.0 / 3, 7.0, 1234.5}) {
          const double stored = to_float(to_half(static_cast<float>(c)));
          for (const Image& level : pyramid(settings(corrected, rounding), image_of(size[0], size[1], [&](int, int) { return c; }))) {
            for (int y = 0; y < level.height(); ++y) {
              for (int x = 0; x < level.width(); ++x) ASSERT_EQ(at(level, x, y), stored);
            }
          }
        }
      }
    }
  }
}

/// What one level of a side of n texels is, n even, by the corrected form in double.
std::vector<double> halved(const std::vector<double>& above) {
  const int n = static_cast<int>(above.size());
  const BlurUniforms u = blur_uniforms(settings(true), n, n, 1);
  std::vector<double> out;
  for (int x = 0; x < n / 2; ++x) {
    const auto tap = [&](int i, int) { return D(above[static_cast<std::size_t>(mirrored(2 * x + i, n))]); };
    out.push_back(scalar::halved_corrected<D>(u, tap, x, n / 4).v);
  }
  return out;
}
/// Level l of 64 texels.
std::vector<double> level_of(std::vector<double> texels, int l) {
  for (int k = 0; k < l; ++k) texels = halved(texels);
  return texels;
}

TEST(BlurPyramid, NoiseAndSpread) {
  for (const bool corrected : {false, true}) {
    std::mt19937 words(3);
    const int side = 512;
    const std::vector<Image> levels = pyramid(settings(corrected), image_of(side, side, [&](int, int) { return 0.125 * (words() % 256); }));
    const auto variance = [&](const Image& i) {
      const double m = mean(i);
      double sum = 0;
      for (int y = 0; y < i.height(); ++y) {
        for (int x = 0; x < i.width(); ++x) sum += (at(i, x, y) - m) * (at(i, x, y) - m);
      }
      return sum / i.width() / i.height();
    };
    const double first = variance(levels[0]);
    for (int l = 1; l <= 4; ++l) {
      const double texels = std::pow(side >> l, 2);
      // Of weights w of one level and all those before it: the sum of w^2 along a side, squared.
      double kept = std::pow(0.5, l);
      if (corrected) {
        kept = 0;
        for (std::size_t x = 0; x < 64; ++x) {
          std::vector<double> one(64);
          one[x] = 1;
          kept += std::pow(level_of(one, l)[static_cast<std::size_t>(32 >> l)], 2);
        }
      }
      // The sample variance of n values has a relative standard deviation of sqrt(2 / n); four of them. Texels beside each other share
      // weights, corrected: of a B-spline of fourth degree at whole steps correlations 0.56, 0.09, in two directions 1.65 times that.
      EXPECT_NEAR(variance(levels[static_cast<std::size_t>(l)]) / first / (kept * kept), 1,
                  (corrected ? 1.65 : 1) * 4 * std::sqrt(2 / texels))
          << l;
    }
  }
  // Variance of the point spread: as published (4^L - 1) / 12 square texels. Mean of x^2 less square of the mean of x, exact in halves.
  for (int l = 1; l <= 3; ++l) {
    const double x = at(pyramid(settings(false), image_of(8, 8, [](int i, int) { return i; }))[static_cast<std::size_t>(l)], 0, 0);
    const double xx = at(pyramid(settings(false), image_of(8, 8, [](int i, int) { return i * i; }))[static_cast<std::size_t>(l)], 0, 0);
    EXPECT_EQ(xx - x * x, (std::pow(4, l) - 1) / 12);
  }
  // Corrected five times as much: 1 5 10 10 5 1 have 5/4 square texels where 1 1 have 1/4.
  std::vector<double> ramp, squares;
  for (int i = 0; i < 64; ++i) ramp.push_back(i), squares.push_back(i * i);
  for (int l = 1; l <= 3; ++l) {
    const auto middle = static_cast<std::size_t>(32 >> l);
    const double x = level_of(ramp, l)[middle], xx = level_of(squares, l)[middle];
    EXPECT_NEAR(xx - x * x, 5 * (std::pow(4, l) - 1) / 12, 1e-10) << l;
  }
}

// What is bright at a texel has its centre there on every level, corrected, wherever in a coarse texel it lies: nothing stands still, and
// nothing jumps. As published it lies in the middle of the coarse texel.
TEST(BlurPyramid, APointOfLightMovesWithItsTexel) {
  for (std::size_t x = 24; x < 40; ++x) {
    std::vector<double> one(64);
    one[x] = 1;
    for (int l = 1; l <= 3; ++l) {
      double sum = 0, moment = 0;
      const std::vector<double> level = level_of(one, l);
      for (std::size_t k = 0; k < level.size(); ++k) {
        sum += level[k];
        moment += level[k] * (static_cast<double>(k) + 0.5) * std::exp2(l);
      }
      EXPECT_NEAR(sum, std::exp2(-l), 1e-15);
      EXPECT_NEAR(moment / sum, static_cast<double>(x) + 0.5, 1e-12) << x << ", level " << l;
    }
  }
}
// A point becomes round: what a lookup on level 3 gives at one distance r from it along a side and along the diagonal, p(r) p(0) and
// p(r / sqrt 2)^2, differs less than a sixth as much as where levels are boxes, wherever in a coarse texel the point lies.
TEST(BlurPyramid, APointOfLightIsRound) {
  const auto worst = [](bool corrected) {
    double most = 0;
    for (std::size_t texel = 28; texel < 36; ++texel) {
      std::vector<double> level(64);
      level[texel] = 1;
      if (corrected) {
        level = level_of(level, 3);
      } else {
        level.assign(8, 0);
        level[texel / 8] = 1.0 / 8;
      }
      const auto p = [&](double r) {
        const double x = (static_cast<double>(texel) + 0.5) / 8 + r - 0.5, low = std::floor(x);
        return std::lerp(level[static_cast<std::size_t>(low)], level[static_cast<std::size_t>(low) + 1], x - low);
      };
      for (double r = -1.5; r <= 1.5; r += 0.01)
        most = std::max(most, std::abs(p(r) * p(0) - p(r / std::sqrt(2.0)) * p(std::abs(r) / std::sqrt(2.0))) / std::pow(p(0), 2));
    }
    return most;
  };
  EXPECT_LT(6 * worst(true), worst(false));
}

// As published: white noise of variance 1 has variance sum w^2, w the answer to an impulse in each texel of level 0: an exact figure, with
// no noise drawn. At the centre of a texel of level L, trilinear at L + f takes that texel (variance V_L = 4^-L) and of level L + 1 a
// bilinear mix whose weights are 9, 3, 3, 1 / 16, of which the first is the texel's own parent (covariance V_{L+1}):
//   (1 - f)^2 V_L + 2 f (1 - f) 9/16 V_{L+1} + f^2 100/256 V_{L+1}.
// Where the coarse level is read at its own texel's centre the fine one is a bilinear mix of its four: both equal their mean, V_{L+1}.
TEST(BlurPyramid, NoiseBetweenTwoLevels) {
  constexpr int side = 32;
  const auto variance = [](double u, double v, double lod) {
    double sum = 0;
    for (int i = 0; i < side * side; ++i) {
      const std::vector<Image> levels =
          pyramid(settings(false), image_of(side, side, [&](int x, int y) { return y * side + x == i ? 1 : 0; }));
      LevelTexture texture(levels);
      texture.refresh(two_threads(), levels);
      StoredTexture<float> t{nullptr, 4, texture.view().levels};
      std::copy_n(texture.view().width, t.levels, t.width);
      std::copy_n(texture.view().height, t.levels, t.height);
      std::copy_n(texture.view().pitch, t.levels, t.pitch);
      std::copy_n(texture.view().offset, t.levels, t.offset);
      std::vector<float> texels(4 * static_cast<std::size_t>(t.offset[t.levels - 1] + 1));
      to_float_array(texture.view().texels, texels.data(), texels.size());
      t.texels = texels.data();
      const double w = sampled::sample_trilinear<0, 1, D>(fixed_texture<Address::clamp, Address::clamp, 4>(t), D(u), D(v), D(lod))[0].v;
      sum += w * w;
    }
    return sum;
  };
  for (const int level : {0, 1, 2}) {
    const double fine = std::pow(0.25, level), coarse = fine / 4, texel = std::exp2(level) / side;
    for (const double f : {0.0, 0.25, 0.5, 1.0}) {
      const double expected = (1 - f) * (1 - f) * fine + 2 * f * (1 - f) * 9 / 16 * coarse + f * f * 100 / 256 * coarse;
      EXPECT_NEAR(variance(2.5 * texel, 3.5 * texel, level + f), expected, 1e-14) << level << " " << f;
    }
    EXPECT_NEAR(variance(2 * texel * 1.5, 2 * texel * 1.5, level + 0.4), coarse, 1e-14) << level;
  }
}

TEST(BlurPyramid, CorrectedKeepsTheCentreOfGravityOfOddSizes) {
  // A ramp: with dropped columns its middle moves.
  const auto ramp = [](int x, int) { return x; };
  EXPECT_EQ(at(pyramid(settings(true), image_of(5, 5, ramp)).back(), 0, 0), 2);
  EXPECT_EQ(at(pyramid(settings(false), image_of(5, 5, ramp)).back(), 0, 0), 1.5);
}

TEST(BlurPyramid, Fog) {
  BlurSettings s = settings(true);
  s.fog_density = 0.02;
  s.fog_colour = {0.5, 0.25, 2};
  const BlurUniforms u = blur_uniforms(s, 8, 8, 0);
  // White before black fog is the transmittance.
  BlurUniforms black = u;
  std::fill_n(black.fog_colour, 3, 0.0f);
  const auto t = [&](double depth) { return scalar::fogged(black, scalar::Vec3<D>(D(1), D(1), D(1)), D(depth)).x.v; };
  // T(a + b) = T(a) T(b), for the density as a float.
  for (const double a : {0.0, 3.0, 50.0}) EXPECT_NEAR(t(a + 7) / (t(a) * t(7)), 1, 1e-12);
  EXPECT_NEAR(t(50), std::exp(-1), 1e-7);
  EXPECT_EQ(t(-4), 1) << "nothing lies behind the eye";

  Image colour = image_of(3, 1, [](int, int) { return 1; }), depth(Format::r32f, 3, 1), out(Format::rgba16f, 3, 1);
  depth.row<float>(0)[1] = 50;
  depth.row<float>(0)[2] = 1e30f;
  fog_run(u, Rounding::rne, colour, depth, out).tiles(two_threads(), tile_rows(out.height()));
  for (int c = 0; c < 3; ++c) {
    const double fog = s.fog_colour[static_cast<std::size_t>(c)], own = c + 1;
    EXPECT_EQ(at(out, 0, 0, c), own);
    EXPECT_NEAR(at(out, 1, 0, c), fog + (own - fog) * std::exp(-1), 0x1p-11 * 2);
    EXPECT_EQ(at(out, 2, 0, c), fog);
    EXPECT_EQ(at(out, c, 0, 3), 1);
  }
}

TEST(BlurPyramid, TheTextureHoldsTheLevels) {
  const std::vector<Image> levels = pyramid(settings(true), image_of(37, 21, [](int x, int y) { return x + 0.25 * y; }));
  LevelTexture texture(levels);
  texture.refresh(two_threads(), levels);
  const StoredTexture<Half>& t = texture.view();
  ASSERT_EQ(t.levels, static_cast<int>(levels.size()));
  for (int l = 0; l < t.levels; ++l) {
    for (int y = 0; y < t.height[l]; ++y) {
      for (int i = 0; i < 4 * t.width[l]; ++i) {
        ASSERT_EQ(t.texels[4 * (t.offset[l] + t.pitch[l] * y) + i].bits, levels[static_cast<std::size_t>(l)].row<Half>(y)[i].bits);
      }
    }
  }
}

Image noise(int width, int height) {
  std::mt19937 words(static_cast<unsigned>(width));
  return image_of(width, height, [&](int, int) { return words() * 0x1p-30; });
}

TEST(BlurPyramid, FloatsAreWithinRoundingOfDoubles) {
  for (const bool corrected : {false, true}) {
    const int width = 35, height = 27;
    const Image above = noise(width, height);
    const BlurUniforms u = blur_uniforms(settings(corrected), width, height, 1);
    for (int y = 0; y < height / 2; ++y) {
      for (int x = 0; x < width / 2; ++x) {
        const auto tap = [&](auto one, int i, int j) {
          const auto held = [&](int k, int n) { return corrected ? mirrored(k, n) : std::clamp(k, 0, n - 1); };
          const int row = held(2 * y + j, height), column = held(2 * x + i, width);
          return decltype(one)::load(above.row<Half>(row) + 4 * column);
        };
        const auto value = [&](auto one) {
          using N = decltype(one);
          const auto of = [&](int i, int j) { return tap(N(0.0f), i, j); };
          return corrected ? scalar::halved_corrected<N>(u, of, x, y) : scalar::halved_as_published<N>(of);
        };
        // Up to eighteen roundings of numbers no larger than twice the largest tap, 4.
        ASSERT_NEAR(value(F(0.0f)).v, value(D(0.0f)).v, 18 * 8 * 0x1p-24);
      }
    }
  }
}

}  // namespace
}  // namespace rainref::blur_pyramid
