// Textures decode every format exactly, and mip levels are exact box means at every size.
#include "image/texture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "rainref/error.h"

namespace rainref {
namespace {

TextureData texture(int width, int height, std::vector<float> texels, int channels = 1) {
  return TextureData(std::move(texels), channels, width, height, Address::clamp, Address::clamp);
}
std::vector<float> noise(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);  // its words are fixed by the C++ standard
  std::vector<float> out(count);
  for (float& x : out) x = static_cast<float>(random() >> 8) * 0x1p-24f;
  return out;
}
std::span<const float> level(const TextureData& t, int l) {
  const Texture& v = t.view();
  return {v.texels + static_cast<std::size_t>(v.offset[l]) * v.channels, static_cast<std::size_t>(v.width[l]) * v.height[l] * v.channels};
}
double mean(std::span<const float> x) { return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size()); }
double variance(std::span<const float> x) {
  const double m = mean(x);
  double sum = 0;
  for (const float v : x) sum += (v - m) * (v - m);
  return sum / static_cast<double>(x.size());
}

TEST(Texture, DecodesEveryFormatExactly) {
  Image bytes(Format::rgba8, 64, 1), srgb(Format::rgba8_srgb, 64, 1), halves(Format::r16f, 31744, 1), floats(Format::rg32f, 2, 2);
  for (int i = 0; i < 256; ++i) bytes.row<Unorm8>(0)[i] = srgb.row<Unorm8>(0)[i] = {static_cast<std::uint8_t>(i)};
  for (int i = 0; i < 31744; ++i) halves.row<Half>(0)[i] = {static_cast<std::uint16_t>(i)};
  const float values[] = {0x1p-149f, -0.0f, 1e30f, 3, 4, 5, 6, 7};
  for (int y = 0; y < 2; ++y) std::copy_n(values + 4 * y, 4, floats.row<float>(y));

  const TextureData b(bytes, Address::clamp, Address::clamp), s(srgb, Address::clamp, Address::clamp);
  for (int i = 0; i < 256; ++i) {
    EXPECT_EQ(b.view().texels[i], static_cast<float>(i / 255.0L));
    EXPECT_EQ(s.view().texels[i], b.view().texels[i]) << "no colour conversion";
  }
  const TextureData h(halves, Address::clamp, Address::clamp);
  for (int i = 0; i < 31744; ++i) {
    const int exponent = i >> 10, mantissa = i & 1023;
    ASSERT_EQ(h.view().texels[i], exponent ? std::ldexp(1024.0 + mantissa, exponent - 25) : std::ldexp(double(mantissa), -24)) << i;
  }
  const TextureData f(floats, Address::repeat, Address::mirror);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(std::bit_cast<std::uint32_t>(f.view().texels[i]), std::bit_cast<std::uint32_t>(values[i]));
  EXPECT_EQ(f.view().channels, 2);
  EXPECT_EQ(f.view().levels, 1);
  EXPECT_EQ(f.view().address_u, Address::repeat);
  EXPECT_EQ(f.view().address_v, Address::mirror);
  EXPECT_THROW(TextureData(Image(Format::r32ui, 1, 1), Address::clamp, Address::clamp), Error);
}

TEST(Texture, CopiesAndMovesPointAtTheirOwnTexels) {
  TextureData a = texture(2, 1, {1, 2});
  a.set_border(1, 2, 3, 4);
  TextureData b = a;
  b.texels()[0] = 9;
  EXPECT_EQ(a.view().texels[0], 1);
  EXPECT_EQ(b.view().texels[0], 9);
  EXPECT_EQ(b.view().border[3], 4);
  const TextureData c = std::move(b);
  EXPECT_EQ(c.view().texels[0], 9);
  a = c;
  EXPECT_EQ(a.view().texels[0], 9);
  EXPECT_NE(a.view().texels, c.view().texels);
  EXPECT_TRUE(TextureData().empty());
}

TEST(Mips, HalveEachSideDownToOneTexel) {
  TextureData t = texture(20, 5, std::vector<float>(100, 1));
  t.build_mips();
  const Texture& v = t.view();
  ASSERT_EQ(v.levels, 5);
  const int widths[] = {20, 10, 5, 2, 1}, heights[] = {5, 2, 1, 1, 1};
  int offset = 0;
  for (int l = 0; l < 5; ++l) {
    EXPECT_EQ(v.width[l], widths[l]);
    EXPECT_EQ(v.height[l], heights[l]);
    EXPECT_EQ(v.offset[l], offset);
    offset += widths[l] * heights[l];
  }
  TextureData limited = texture(20, 5, std::vector<float>(100, 1));
  limited.build_mips(3);
  EXPECT_EQ(limited.view().levels, 3);
  limited.build_mips();  // goes on
  EXPECT_EQ(limited.view().levels, 5);
}

TEST(Mips, OfPowersOfTwoAreBoxMeans) {
  TextureData t = texture(4, 2, {1, 2, 3, 4, 5, 6, 7, 8});
  t.build_mips();
  EXPECT_THAT(level(t, 1), testing::ElementsAre(3.5f, 5.5f));
  EXPECT_THAT(level(t, 2), testing::ElementsAre(4.5f));
}

TEST(Mips, OfThreeTexelsWeighTheWholeFootprint) {
  TextureData three = texture(3, 1, {1, 10, 100});
  three.build_mips();
  EXPECT_THAT(level(three, 1), testing::ElementsAre(testing::FloatEq(37)));
  TextureData five = texture(5, 1, {1, 2, 4, 8, 16});
  five.build_mips();
  EXPECT_THAT(level(five, 1), testing::ElementsAre(testing::FloatEq((1 + 2 + 2) / 2.5f), testing::FloatEq((2 + 8 + 16) / 2.5f)));
}

TEST(Mips, KeepEveryChannelApart) {
  std::vector<float> texels;
  for (int i = 0; i < 15; ++i) texels.insert(texels.end(), {1.0f, static_cast<float>(i), -2.0f});
  TextureData t = texture(5, 3, texels, 3);
  t.build_mips();
  for (int l = 0; l < t.view().levels; ++l) {
    const auto x = level(t, l);
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); i += 3) {
      EXPECT_FLOAT_EQ(x[i], 1);
      EXPECT_FLOAT_EQ(x[i + 2], -2);
      sum += x[i + 1];
    }
    EXPECT_NEAR(sum / static_cast<double>(x.size() / 3), 7, 1e-6 * 7) << l;
  }
}

TEST(Mips, KeepTheMeanAtEverySize) {
  for (const auto& [w, h] : {std::pair{5, 5}, {1, 7}, {17, 9}, {64, 64}, {100, 37}, {255, 3}, {333, 77}, {1, 1}}) {
    TextureData t = texture(w, h, noise(static_cast<std::size_t>(w * h), 1));
    t.build_mips();
    const double whole = mean(level(t, 0));
    for (int l = 1; l < t.view().levels; ++l) EXPECT_NEAR(mean(level(t, l)), whole, 1e-6 * whole) << w << 'x' << h << " level " << l;
  }
}

TEST(Mips, AConstantStaysConstant) {
  for (const float value : {1.0f, 0.1f, 1.0f / 3, 1e-30f, 65504.0f, -7.7f}) {
    for (const auto& [w, h] : {std::pair{64, 16}, {63, 17}, {7, 1}, {129, 99}}) {
      TextureData t = texture(w, h, std::vector<float>(static_cast<std::size_t>(w * h), value));
      t.build_mips();
      for (int l = 1; l < t.view().levels; ++l) {
        for (const float x : level(t, l)) ASSERT_EQ(x, value) << w << 'x' << h << " level " << l;
      }
    }
  }
}

// Estimated from 4^(10 - L) independent texels: relative standard deviation of a variance of uniform noise is
// sqrt(0.8 / n) at level 0 and at most sqrt(2 / n); five of them never fail by chance.
TEST(Mips, WhiteNoiseLosesThreeQuartersOfItsVarianceALevel) {
  TextureData t = texture(1024, 1024, noise(1 << 20, 3));
  t.build_mips();
  for (int l = 0; l <= 6; ++l) {
    const double expected = std::pow(4.0, -l) / 12, n = std::pow(4.0, 10 - l);
    EXPECT_NEAR(variance(level(t, l)) / expected, 1, 5 * std::sqrt(2 / n)) << l;
  }
}

// One bright texel spreads over its footprint, a box of 2^L texels: variance (4^L - 1) / 12 about the centre.
TEST(Mips, ThePointSpreadIsABoxOfTheFootprint) {
  constexpr int side = 64;
  for (int l = 0; l <= 5; ++l) {
    double sum = 0, first = 0, second = 0;
    for (int x = 0; x < side; ++x) {
      std::vector<float> texels(side, 0.0f);
      texels[static_cast<std::size_t>(x)] = 1;
      TextureData t = texture(side, 1, texels);
      t.build_mips();
      const double weight = level(t, l)[0];  // of texel x in the first texel of the level
      sum += weight;
      first += weight * x;
      second += weight * x * x;
    }
    EXPECT_NEAR(sum, 1, 1e-6);
    EXPECT_NEAR(first, (std::pow(2.0, l) - 1) / 2, 1e-6);
    EXPECT_NEAR(second - first * first, (std::pow(4.0, l) - 1) / 12, 1e-4) << l;
  }
}

}  // namespace
}  // namespace rainref
