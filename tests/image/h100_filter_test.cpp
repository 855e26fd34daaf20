// A filter as an NVIDIA H100 was seen to make it (CUDA texture objects, 1D, one-hot 2D, half and float texels, driver 580.159):
// u cut to 21 bits (an H200, outputs of ports), x rounded to 1/256, half up; of the four weights the product fx fy rounded to 1/256 and the
// others such that rows, columns and the whole keep their sums; texels of half give a half, half away from zero. Between two levels (32000
// lookups, one-hot and random texels) all eight weights are multiples of 1/256: the coarse level's share S is cut, S f_x is rounded half up
// to X, X f_y half up and (S - X) f_y half down. Every such result must lie in the hull, and be what Perturbeds give that filter in fixed
// point.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "image/footprint.h"
#include "image/texture.h"
#include "math/half.h"
#include "math/perturbed.h"
#include "math/profiles.h"

namespace rainref::test {
namespace h100 {
using namespace rainref::scalar;
#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "image/sampling_perturbed-inl.h"
#include "image/sampling-inl.h"
#include "image/sampling_enclosed-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
}  // namespace h100
namespace {

using enclosed::Enclosure;

constexpr int size = 5;

double place_by_h100(float u, int side) {
  const double cut = std::floor(static_cast<double>(u) * 0x1p21) / 0x1p21;
  return std::floor((cut * side - 0.5) * 256 + 0.5) / 256;
}
double half_by_h100(double value) {
  const double step = std::ldexp(1, std::max(std::ilogb(value), -14) - 10);
  return std::round(value / step) * step;
}
double filtered_by_h100(const std::vector<float>& texels, float u, float v, bool half) {
  const double x = place_by_h100(u, size), y = place_by_h100(v, size);
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double fx = x - i, fy = y - j, both = std::floor(fx * fy * 256 + 0.5) / 256;
  const auto texel = [&](int a, int b) {
    return static_cast<double>(texels[static_cast<std::size_t>(std::min(b, size - 1) * size + std::min(a, size - 1))]);
  };
  const double value =
      (1 - fx - fy + both) * texel(i, j) + (fx - both) * texel(i + 1, j) + (fy - both) * texel(i, j + 1) + both * texel(i + 1, j + 1);
  return half ? half_by_h100(value) : value;
}

struct TwoLevels {
  int side;                   ///< of the fine level; the coarse one has half of it
  std::vector<float> texels;  ///< both, one channel
};
double between_by_h100(const TwoLevels& t, float u, float v, double lod, bool half) {
  const double coarse_share = std::floor(lod * 256);
  double value = 0;
  for (int level = 0; level < 2; ++level) {
    const int s = t.side >> level;
    const float* texels = t.texels.data() + (level == 0 ? 0 : t.side * t.side);
    const double x = place_by_h100(u, s), y = place_by_h100(v, s), share = level == 0 ? 256 - coarse_share : coarse_share;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const double right = std::floor(share * (x - i) + 0.5), left = share - right;
    const double right_above = std::floor(right * (y - j) + 0.5), left_above = std::ceil(left * (y - j) - 0.5);
    const auto texel = [&](int a, int b) { return static_cast<double>(texels[std::min(b, s - 1) * s + std::min(a, s - 1)]); };
    value += ((left - left_above) * texel(i, j) + (right - right_above) * texel(i + 1, j) + left_above * texel(i, j + 1) +
              right_above * texel(i + 1, j + 1)) /
             256;
  }
  return half ? half_by_h100(value) : value;
}
/// What a device gives whose sampler works in fixed point.
struct ByKnownDevice {
  perturbed::Scope scope;
  ByKnownDevice()
      : scope([] {
          perturbed::Behaviour b;
          b.filter = perturbed::Filter::fixed_point;
          return b;
        }()) {}
  using Number = perturbed::Perturbed;
  static Number number(float x) { return Number::of(x); }
};

class H100Filter : public testing::TestWithParam<TexelPrecision> {};

TEST_P(H100Filter, LiesInTheHull) {
  std::mt19937 words{11};
  const auto random = [&](double low, double high) { return low + (high - low) * (words() * 0x1p-32); };
  const enclosed::ProfileScope scope(profile_named("vulkan"));
  const bool half = GetParam() == TexelPrecision::float16;
  int beyond_exact = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<float> texels(size * size);
    for (float& t : texels) t = to_float(to_half(static_cast<float>(random(-1, 1))));
    TextureData data(texels, 1, size, size, Address::clamp, Address::clamp);
    Texture t = data.view();
    t.precision = GetParam();
    const float u = static_cast<float>(random(0.1, 0.9)), v = static_cast<float>(random(0.1, 0.9));
    const Enclosure hull = h100::sample_bilinear<0, 1, Enclosure>(t, Enclosure(u), Enclosure(v))[0];
    const double got = filtered_by_h100(texels, u, v, half);
    EXPECT_LE(hull.lo, got);
    EXPECT_GE(hull.hi, got);
    {
      const ByKnownDevice device;
      EXPECT_EQ((h100::sample_bilinear<0, 1, ByKnownDevice::Number>(t, device.number(u), device.number(v))[0].v), static_cast<float>(got));
    }
    // Not covered by the coordinate's slack alone: the test would have failed before weights were modelled.
    t.precision = TexelPrecision::float32;
    beyond_exact += std::abs(got - filtered_by_h100(texels, u, v, false)) > 0;
  }
  EXPECT_EQ(beyond_exact > 0, half);
}
TEST_P(H100Filter, BetweenTwoLevelsLiesInTheHull) {
  std::mt19937 words{12};
  const auto random = [&](double low, double high) { return low + (high - low) * (words() * 0x1p-32); };
  const enclosed::ProfileScope scope(profile_named("vulkan"));
  const bool half = GetParam() == TexelPrecision::float16;
  const auto one = [](const Texture& t, Enclosure u, Enclosure v, Enclosure lod) {
    return h100::sample_trilinear<0, 1, Enclosure>(t, u, v, lod)[0];
  };
  int beyond_each_alone = 0, off = 0;
  double widest = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    TwoLevels levels{8, std::vector<float>(64 + 16)};
    // Strong edges: most of what rounding moves.
    for (float& t : levels.texels)
      t = words() % 2 == 0 ? to_float(to_half(static_cast<float>(random(0, 0.1)))) : to_float(to_half(static_cast<float>(random(0.9, 1))));
    TextureData data(std::vector<float>(levels.texels.begin(), levels.texels.begin() + 64), 1, 8, 8, Address::clamp, Address::clamp);
    data.build_mips(2);
    std::copy(levels.texels.begin() + 64, levels.texels.end(), data.texels() + 64);
    Texture t = data.view();
    t.precision = GetParam();
    const float u = static_cast<float>(random(0.2, 0.8)), v = static_cast<float>(random(0.2, 0.8)),
                lod = trial % 2 == 0 ? 0.5f : static_cast<float>(random(0, 1));
    const Enclosure hull = one(t, Enclosure(u), Enclosure(v), Enclosure(lod));
    const double got = between_by_h100(levels, u, v, lod, half);
    EXPECT_LE(hull.lo, got) << u << ' ' << v << ' ' << lod;
    EXPECT_GE(hull.hi, got) << u << ' ' << v << ' ' << lod;
    {
      const ByKnownDevice device;
      const float same =
          h100::sample_trilinear<0, 1, ByKnownDevice::Number>(t, device.number(u), device.number(v), device.number(lod))[0].v;
      EXPECT_NEAR(same, got, half ? 0x1p-11 : 0x1p-23);
      off += half && same != static_cast<float>(got);
    }
    widest = std::max(widest, static_cast<double>(hull.hi) - hull.lo);
    // Each level rounded alone would not do: the test would have failed before the weights were modelled together.
    Texture fine = t, coarse = t;
    fine.levels = 1;
    coarse.levels = 1;
    coarse.offset[0] = t.offset[1];
    coarse.width[0] = coarse.height[0] = 4;
    const auto level = [&](const Texture& l) { return h100::sample_bilinear<0, 1, Enclosure>(l, Enclosure(u), Enclosure(v))[0]; };
    const Enclosure alone = mix(level(fine), level(coarse), Enclosure(std::max(0.0f, lod - 0x1p-8f), std::min(1.0f, lod + 0x1p-8f)));
    beyond_each_alone += got < alone.lo || got > alone.hi;
  }
  EXPECT_GT(beyond_each_alone, 0);
  EXPECT_LT(off, 8) << "the levels' shares are floats, whose sum may miss a tie";
  EXPECT_LT(widest, 0.06);  // of texels from 0 to 1: two coordinates of either level off by 1/256, six roundings by 1/512, the LOD
}
INSTANTIATE_TEST_SUITE_P(Every, H100Filter, testing::Values(TexelPrecision::float32, TexelPrecision::float16));

TEST(H100Filter, AConstantTextureStaysConstant) {
  const enclosed::ProfileScope scope(profile_named("vulkan"));
  Texture t;
  const std::vector<float> texels(size * size, 0.25f);
  TextureData data(texels, 1, size, size, Address::clamp, Address::clamp);
  t = data.view();
  t.precision = TexelPrecision::float16;
  const Enclosure hull = h100::sample_bilinear<0, 1, Enclosure>(t, Enclosure(0.3f), Enclosure(0.6f))[0];
  EXPECT_LT(hull.hi - hull.lo, 16 * 0x1p-24);  // roundings of two mixes, flushes
}

}  // namespace
}  // namespace rainref::test
