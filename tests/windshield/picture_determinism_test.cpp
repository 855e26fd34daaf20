// composite, display and the street's views: every SIMD target, 1, 2, 3 and 8 threads, shuffled tiles and widths 1 to 33 give the bits
// of one plain float after another.
#include <gtest/gtest.h>

#include <cstring>

#include "math/half.h"
#include "math/simd_target.h"
#include "math/unorm.h"
#include "windshield/picture.h"
#include "windshield/plain.h"
#include "windshield/street.h"

namespace rainref::windshield {
namespace {

using F = plain::Plain<float>;

/// Values in [0, 1] with structure.
TextureData pattern(int channels, int width, int height, int levels = 1, float scale = 1) {
  std::vector<float> texels(static_cast<std::size_t>(channels) * width * height);
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = scale * static_cast<float>((i * 7919 + 31 * (i / 5)) % 257) / 256;
  TextureData t(std::move(texels), channels, width, height, Address::clamp, Address::clamp);
  t.build_mips(levels);
  return t;
}
const Corners raked{{{1.0, 0.7, 0.95}, {1.0, -0.7, 0.95}, {0.2872, 0.7, 1.3132}}};

struct View {
  Image colour, picture;
  SceneView street;
};
constexpr int height = 11;

struct Scene {
  TextureData pyramid = pattern(4, 37, 23, 4), depth = pattern(1, 37, 23, 1, 60), water = pattern(1, 29, 17), normal = pattern(4, 29, 17), mask = pattern(1, 29, 17);
  Keyframe newer{pattern(4, 19, 13), pattern(1, 19, 13, 1, 40)}, older{pattern(4, 19, 13, 1, 0.5f), pattern(1, 19, 13, 1, 50)};
  PictureSettings settings;
  CompositeUniforms composite;
  DisplayUniforms display;
  ReprojectUniforms reproject{{0.6f, 0.3f}, {0.05f, 0.05f}, {0.01f, -0.02f, 0.99f}, 2.5f, 10.5f, 0.4f};
  std::vector<Glint> lights;

  explicit Scene(int width) {
    settings.width = width;
    settings.height = height;
    settings.camera_position = {-0.25, 0, 1.16};
    settings.vertical_fov_deg = 60;  // beyond the glass, too
    settings.lights = {{{-0.9, 0.2, 0.4}, {1, 0.9, 0.8}}, {{0.1, 0.9, 0.2}, {0.2, 0.3, 0.9}}};
    composite = composite_uniforms(settings, raked);
    display = display_uniforms(settings);
    lights = glints(settings);
  }
  View make() const {
    const int w = settings.width;
    return {Image(Format::rgba16f, w, height), Image(Format::rgba8, w, height), {Image(Format::rgba16f, w, height), Image(Format::r32f, w, height)}};
  }
  View by_lanes(bool corrected, const parallel::Executor& executor) const {
    View v = make();
    const CompositeInputs in{&pyramid.view(), &depth.view(), &water.view(), &normal.view(), &mask.view(), lights};
    executor.for_tiles(settings.width, height, settings.width, 2, [&](const parallel::Tile& tile) {
      composite_rows(composite, corrected, Rounding::rne, in, v.colour, tile);
      display_rows(display, Rounding::rne, v.colour, v.picture, tile);
      reproject_rows(reproject, newer, older, v.street, tile);
    });
    return v;
  }
};

void expect_same(const Image& a, const Image& b, const std::string& what) {
  const BufferView x(a), y(b);
  std::vector<std::byte> one(x.row_bytes()), other(y.row_bytes());
  for (int row = 0; row < a.height(); ++row) {
    x.copy_row(row, one.data());
    y.copy_row(row, other.data());
    ASSERT_EQ(std::memcmp(one.data(), other.data(), one.size()), 0) << what << ", row " << row;
  }
}
void expect_same(const View& a, const View& b, const std::string& what) {
  expect_same(a.colour, b.colour, what + " composite");
  expect_same(a.picture, b.picture, what + " display");
  expect_same(a.street.colour, b.street.colour, what + " street");
  expect_same(a.street.depth, b.street.depth, what + " street's depth");
}

class PictureDeterminism : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Variants, PictureDeterminism, testing::Bool(), [](const auto& variant) { return variant.param ? "Corrected" : "AsPublished"; });

// composite and display have a plain reading; the views of the street are an input, and are compared between targets.
TEST_P(PictureDeterminism, LanesEqualThePlainReading) {
  for (int width = 1; width <= 33; ++width) {
    const Scene s(width);
    const View lanes = s.by_lanes(GetParam(), parallel::Executor(1));
    View plain = s.make();
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const plain::Vec3<F> c = GetParam() ? scalar::composite_corrected<F>(s.composite, s.pyramid.view(), s.depth.view(), s.water.view(), s.normal.view(), s.mask.view(), s.lights.data(), x, y)
                                            : scalar::composite_as_published<F>(s.composite, s.pyramid.view(), s.water.view(), s.normal.view(), s.mask.view(), s.lights.data(), x, y);
        Half* colour = plain.colour.row<Half>(y) + 4 * x;
        const float rgba[4] = {c.x.v, c.y.v, c.z.v, 1};
        for (int k = 0; k < 4; ++k) colour[k] = to_half(rgba[k] + 0.0f);
        const plain::Vec3<F> code = scalar::display<F>(s.display, plain::Vec3<F>(F(to_float(colour[0])), F(to_float(colour[1])), F(to_float(colour[2]))));
        const float codes[4] = {code.x.v, code.y.v, code.z.v, 1};
        for (int k = 0; k < 4; ++k) plain.picture.row<Unorm8>(y)[4 * x + k] = to_unorm8(codes[k], Rounding::rne);
      }
    }
    expect_same(lanes.colour, plain.colour, std::to_string(width) + " composite");
    expect_same(lanes.picture, plain.picture, std::to_string(width) + " display");
  }
}

TEST_P(PictureDeterminism, EveryTargetThreadCountOrderAndWidth) {
  for (int width = 1; width <= 33; ++width) {
    const Scene s(width);
    const View expected = s.by_lanes(GetParam(), parallel::Executor(1));
    for (const std::string& target : simd_targets()) {
      select_simd_target(target);
      expect_same(s.by_lanes(GetParam(), parallel::Executor(1)), expected, target + " " + std::to_string(width));
    }
    select_simd_target("");
  }
  const Scene s(33);
  const View expected = s.by_lanes(GetParam(), parallel::Executor(1));
  for (const int threads : {2, 3, 8}) {
    parallel::Executor executor(threads);
    executor.shuffle_tiles(static_cast<std::uint64_t>(threads));
    expect_same(s.by_lanes(GetParam(), executor), expected, std::to_string(threads) + " threads");
  }
}

}  // namespace
}  // namespace rainref::windshield
