// How drops join in a texel: order, storage, film (physics: W7).
#include <gtest/gtest.h>

#include "drops/splat_support.h"
#include "rainref/error.h"

namespace rainref::drops {
namespace {

constexpr int width = 45, height = 37;

SplatSettings flat(double h, bool half_accumulation) {
  // A disc over everything: each texel sees only the blending.
  SplatSettings s = settings_on(square_glass, false, width, height, SplatKernel::disc);
  s.keys.drop_radius = 5;
  s.keys.drop_height = h;
  s.keys.half_accumulation = half_accumulation;
  return s;
}
void expect_all(const Image& image, double value) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) ASSERT_EQ(at(image, x, y), value) << x << " " << y;
  }
}

TEST(SplatBlending, ADropBelowHalfAnUlpIsLostInHalves) {
  // ulp(1) = 2^-10. One drop of mass 1 gives 1; those of mass 2^-36 give 2^-12, a quarter of it.
  std::vector<Drop> drops{drop_at(0.5, 0.5, 1)};
  for (int i = 0; i < 64; ++i) drops.push_back(drop_at(0.5, 0.5, 0x1p-36));
  SplatSettings s = flat(1, true);
  s.keys.drop_radius = 5 * 4096;  // the small ones cover everything too
  expect_all(splatted(two_threads(), s, drops), 1);
  s.keys.half_accumulation = false;
  // 2^-36 to the power of the float next to 1/3 is off by 36 ln 2 1e-8; the half that is stored is not.
  expect_all(splatted(two_threads(), s, drops), 1 + 64 * 0x1p-12);
  // In the other order the small ones have become 2^-6 before they meet the large one.
  std::rotate(drops.begin(), drops.begin() + 1, drops.end());
  s.keys.half_accumulation = true;
  expect_all(splatted(two_threads(), s, drops), 1 + 64 * 0x1p-12);
}

TEST(SplatBlending, HalvesKeepTheVolumeWithinHalfAnUlpForEachDrop) {
  SplatSettings s = settings_on(oblong_glass, false, width, height);
  s.keys.drop_radius = 0.2;
  const std::vector<Drop> drops = any_drops(40, 3, 1);
  s.keys.half_accumulation = true;
  const Image halves = splatted(two_threads(), s, drops);
  const SplatUniforms u = splat_uniforms(s);
  const auto stamps = stamps_of<scalar::Scalar<double>>(u, drops);
  double worst = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double exact = plain_texel(u, false, Rounding::rne, stamps, nullptr, x, y).v;
      const double ulp = std::exp2(std::floor(std::log2(std::max(exact, 0x1p-14))) - 10);
      EXPECT_LE(std::abs(at(halves, x, y) - exact), 40 * ulp / 2);
      worst = std::max(worst, std::abs(at(halves, x, y) - exact) / ulp);
    }
  }
  EXPECT_GT(worst, 0.6) << "roundings do add up";
}

TEST(SplatBlending, TowardZeroIsNeverMore) {
  SplatSettings s = settings_on(oblong_glass, false, width, height);
  s.keys.drop_radius = 0.2;
  const std::vector<Drop> drops = any_drops(40, 3, 1);
  const Image nearest = splatted(two_threads(), s, drops);
  s.keys.rounding = Rounding::rtz;
  const Image cut = splatted(two_threads(), s, drops);
  int less = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      EXPECT_LE(at(cut, x, y), at(nearest, x, y));
      less += at(cut, x, y) < at(nearest, x, y);
    }
  }
  EXPECT_GT(less, width * height / 8) << "much of it is covered once or not at all, and sums of two often have no rest";
}

TEST(SplatBlending, MaxTakesTheHighest) {
  SplatSettings s = flat(1, true);
  s.keys.drop_radius = 50;
  s.keys.blend = SplatBlend::max;
  expect_all(splatted(two_threads(), s, {drop_at(0.5, 0.5, 1), drop_at(0.4, 0.2, 8), drop_at(0.1, 0.9, 0.125)}), 2);
  s.keys.blend = SplatBlend::add;
  expect_all(splatted(two_threads(), s, {drop_at(0.5, 0.5, 1), drop_at(0.4, 0.2, 8), drop_at(0.1, 0.9, 0.125)}), 3.5);
}

TEST(SplatBlending, DeadAndDistantDropsDrawNothingAndTheTextureIsCleared) {
  SplatSettings s = flat(1, true);
  s.keys.drop_radius = 0.01;
  Drop dead = drop_at(0.5, 0.5, 1000), dying = dead;
  dead.life = 0;
  dying.life = -1;
  Image image = splatted(two_threads(), flat(1, true), {drop_at(0.5, 0.5, 1)});
  expect_all(image, 1);
  SplatScratch scratch;
  const std::vector<Drop> none{dead, dying, drop_at(3, 0.5, 1), drop_at(-2, -2, 1), drop_at(0.5, 1.5, 1), drop_at(0.5, 0.5, 0)};
  splat(two_threads(), splat_uniforms(s), true, Rounding::rne, none, {}, nullptr, image, scratch);
  expect_all(image, 0);
}

TEST(SplatBlending, TheFilmKeepsItsWater) {
  // Powers of two, so that every height is a half.
  for (const Glass& glass : {oblong_glass, sheared_glass}) {
    SplatSettings s = settings_on(glass, true, width, height);
    SplatUniforms u = splat_uniforms(s);
    EXPECT_NEAR(u.film_scale, 1e3 * mass_unit / 998.2 / (glass.u * glass.v * std::sin(glass.phi) / (width * height)), 1e-6 * u.film_scale);
    u.film_scale = 0x1p-6f;
    Image film(Format::r32f, width, height), image(Format::r16f, width, height);
    film.row<float>(0)[0] = 16;            // in the corner,
    film.row<float>(height - 1)[20] = 32;  // at an edge,
    film.row<float>(17)[22] = 64;          // and inside
    SplatScratch scratch;
    splat(two_threads(), u, false, Rounding::rne, {}, {}, &film, image, scratch);
    double sum = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) sum += at(image, x, y);
    }
    EXPECT_EQ(sum, (16 + 32 + 64) * 0x1p-6);
    EXPECT_EQ(at(image, 22, 17), 64 * 0x1p-6 / 4);
    EXPECT_EQ(at(image, 23, 17), 64 * 0x1p-6 / 8);
    EXPECT_EQ(at(image, 23, 16), 64 * 0x1p-6 / 16);
    EXPECT_EQ(at(image, 24, 17), 0);
    EXPECT_EQ(at(image, 0, 0), 16 * 0x1p-6 * 9 / 16);
  }
}

TEST(SplatBlending, ImagesThatDoNotFitAreRefused) {
  const SplatSettings s = flat(1, false);
  SplatScratch scratch;
  Image small(Format::r16f, width - 1, height), good(Format::r16f, width, height), film(Format::r32f, width, height);
  EXPECT_THROW(splat(two_threads(), splat_uniforms(s), false, Rounding::rne, {}, {}, nullptr, small, scratch), Error);
  EXPECT_THROW(splat(two_threads(), splat_uniforms(s), true, Rounding::rne, {}, {}, &film, good, scratch), Error) << "halves and a film";
}

}  // namespace
}  // namespace rainref::drops
