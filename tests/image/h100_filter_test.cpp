// A filter as an NVIDIA H100 was seen to make it (CUDA texture objects, 1D, one-hot 2D, half and float texels, driver 580.159):
// x rounded to 1/256, half up; of the four weights the product fx fy rounded to 1/256 and the others such that rows,
// columns and the whole keep their sums; texels of half give a half. Every such result must lie in the hull.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "image/footprint.h"
#include "image/texture.h"
#include "math/half.h"
#include "math/profiles.h"

namespace rainref::test {
namespace h100 {
using namespace rainref::plain;
#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "image/sampling-inl.h"
#include "image/sampling_enclosed-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
}  // namespace h100
namespace {

using enclosed::Enclosure;

constexpr int size = 5;

double filtered_by_h100(const std::vector<float>& texels, double x, double y, bool half) {
  const auto snapped = [](double c) { return std::floor(c * 256 + 0.5) / 256; };
  x = snapped(x);
  y = snapped(y);
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double fx = x - i, fy = y - j, both = std::floor(fx * fy * 256 + 0.5) / 256;
  const auto texel = [&](int a, int b) { return static_cast<double>(texels[static_cast<std::size_t>(std::min(b, size - 1) * size + std::min(a, size - 1))]); };
  const double value = (1 - fx - fy + both) * texel(i, j) + (fx - both) * texel(i + 1, j) + (fy - both) * texel(i, j + 1) + both * texel(i + 1, j + 1);
  return half ? static_cast<double>(to_float(to_half(static_cast<float>(value)))) : value;
}

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
    const double x = static_cast<double>(u) * size - 0.5, y = static_cast<double>(v) * size - 0.5;
    const Enclosure hull = h100::sample_bilinear<0, 1, Enclosure>(t, Enclosure(u), Enclosure(v))[0];
    const double got = filtered_by_h100(texels, x, y, half);
    EXPECT_LE(hull.lo, got);
    EXPECT_GE(hull.hi, got);
    // Not covered by the coordinate's slack alone: the test would have failed before weights were modelled.
    t.precision = TexelPrecision::float32;
    beyond_exact += std::abs(got - filtered_by_h100(texels, x, y, false)) > 0;
  }
  EXPECT_EQ(beyond_exact > 0, half);
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
