// composite, display and the street's views: every SIMD target, 1, 2, 3 and 8 threads, shuffled tiles and widths 1 to 33 give the bits
// of one plain float after another.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <type_traits>

#include "blur_pyramid/blur_pyramid.h"
#include "determinism.h"
#include "image/images.h"
#include "math/half.h"
#include "math/unorm.h"
#include "pass/run.h"
#include "pass/display.h"
#include "pass/display_scalar.h"
#include "windshield/picture/picture.h"
#include "windshield/scalar.h"
#include "windshield/scene/street.h"

namespace rainref::windshield {
namespace {

using F = scalar::Scalar<float>;

/// Values in [0, 1] with structure, as they are stored and as the scalar evaluation takes them.
template <class Stored>
Image pattern(Format format, int width, int height, float scale = 1) {
  std::size_t i = 0;
  return make_image(format, width, height, [&](int, int, int) {
    const float value = scale * static_cast<float>((i * 7919 + 31 * (i / 5)) % 257) / 256;
    ++i;
    if constexpr (std::is_same_v<Stored, Half>)
      return to_half(value);
    else
      return value;
  });
}
TextureData decoded(const Image& image) { return {image, Address::clamp, Address::clamp}; }

/// Four levels whose sizes halve.
struct Pyramid {
  std::vector<Image> levels;
  std::vector<float> texels;
  Texture plain;
  std::optional<blur_pyramid::LevelTexture> stored;

  Pyramid(int width, int height) {
    for (int l = 0; l < 4; ++l)
      levels.push_back(pattern<Half>(Format::rgba16f, width >> l, height >> l, 1.0f - 0.125f * static_cast<float>(l)));
    stored.emplace(levels);
    stored->refresh(parallel::Executor(1), levels);
    const StoredTexture<Half>& view = stored->view();
    plain.channels = 4;
    plain.levels = view.levels;
    std::copy_n(view.width, 4, plain.width);
    std::copy_n(view.height, 4, plain.height);
    std::copy_n(view.offset, 4, plain.offset);
    const int last = view.levels - 1;
    for (int i = 0; i < 4 * (view.offset[last] + view.width[last] * view.height[last]); ++i) texels.push_back(to_float(view.texels[i]));
    plain.texels = texels.data();
  }
};

const Corners raked{{{1.0, 0.7, 0.95}, {1.0, -0.7, 0.95}, {0.2872, 0.7, 1.3132}}};

struct View {
  Image colour, picture;
  SceneView street;
};
constexpr int height = 11;

struct Scene {
  Pyramid pyramid{37, 23};
  Image depth = pattern<float>(Format::r32f, 37, 23, 60), water = pattern<Half>(Format::r16f, 29, 17),
        normal = pattern<Half>(Format::rgba16f, 29, 17), mask = pattern<Half>(Format::r16f, 29, 17);
  TextureData plain_depth = decoded(depth), plain_water = decoded(water), plain_normal = decoded(normal), plain_mask = decoded(mask);
  Keyframe behind{pattern<Half>(Format::rgba16f, 19, 13), pattern<float>(Format::r32f, 19, 13, 40)},
      ahead{pattern<Half>(Format::rgba16f, 19, 13, 0.5f), pattern<float>(Format::r32f, 19, 13, 50)};
  PictureSettings settings;
  CompositeUniforms composite;
  pass::DisplayUniforms display;
  ReprojectUniforms reproject{{0.6f, 0.3f}, {0.05f, 0.05f}, {0.01f, -0.02f, 0.99f}, 2.5f, -5.5f, 0.4f};
  std::vector<Glint> lights;

  explicit Scene(int width) {
    settings.width = width;
    settings.height = height;
    settings.camera_position = {-0.25, 0, 1.16};
    settings.vertical_fov_deg = 60;  // beyond the glass, too
    settings.lights = {{{-0.9, 0.2, 0.4}, {1, 0.9, 0.8}}, {{0.1, 0.9, 0.2}, {0.2, 0.3, 0.9}}};
    composite = composite_uniforms(settings, raked);
    display = pass::display_uniforms(settings.exposure);
    lights = glints(settings);
  }
  View make() const {
    const int w = settings.width;
    return {Image(Format::rgba16f, w, height),
            Image(Format::rgba8, w, height),
            {Image(Format::rgba16f, w, height), Image(Format::r32f, w, height)}};
  }
  View by_lanes(bool corrected, const parallel::Executor& executor) const {
    View v = make();
    pass::HostIo<CompositePass> io;
    io.blurred.set(pyramid.stored->view(), {});
    io.scene_depth = depth;
    io.height = water;
    io.normal = normal;
    io.mask = mask;
    io.glints = lights;
    io.colour = v.colour;
    auto shown = pass::display_run(settings.exposure, Rounding::rne, v.colour, v.picture);
    pass::Run<CompositePass> seen(composite, corrected, Rounding::rne, io);
    executor.for_tiles(settings.width, height, settings.width, 2, [&](const parallel::Tile& tile) {
      seen.tile(tile);
      shown.tile(tile);
      reproject_rows(reproject, behind, ahead, v.street, tile);
    });
    return v;
  }
};

std::string hash_of(const View& v) {
  std::string all;
  for (const Image* image : {&v.colour, &v.picture, &v.street.colour, &v.street.depth}) all += capture::hash_of(*image).text();
  return all;
}

class PictureDeterminism : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Variants, PictureDeterminism, testing::Bool(),
                         [](const auto& variant) { return variant.param ? "Corrected" : "AsPublished"; });

// composite and display have a scalar evaluation; the views of the street are an input, and are compared between targets.
TEST_P(PictureDeterminism, LanesEqualTheScalarEvaluation) {
  for (int width = 1; width <= 33; ++width) {
    const Scene s(width);
    const View lanes = s.by_lanes(GetParam(), parallel::Executor(1));
    View plain = s.make();
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const scalar::Vec3<F> c =
            GetParam() ? scalar::composite_corrected<F>(s.composite, s.pyramid.plain, s.plain_depth.view(), s.plain_water.view(),
                                                        s.plain_normal.view(), s.plain_mask.view(), s.lights.data(), x, y)
                       : scalar::composite_as_published<F>(s.composite, s.pyramid.plain, s.plain_water.view(), s.plain_normal.view(),
                                                           s.plain_mask.view(), s.lights.data(), x, y);
        Half* colour = plain.colour.row<Half>(y) + 4 * x;
        const float rgba[4] = {c.x.v, c.y.v, c.z.v, 1};
        for (int k = 0; k < 4; ++k) colour[k] = to_half(rgba[k] + 0.0f);
        const scalar::Vec3<F> code =
            pass::scalar::display<F>(s.display, scalar::Vec3<F>(F(to_float(colour[0])), F(to_float(colour[1])), F(to_float(colour[2]))));
        const float codes[4] = {code.x.v, code.y.v, code.z.v, 1};
        for (int k = 0; k < 4; ++k) plain.picture.row<Unorm8>(y)[4 * x + k] = to_unorm8(codes[k], Rounding::rne);
      }
    }
    EXPECT_TRUE(same(lanes.colour, plain.colour)) << width << " composite";
    EXPECT_TRUE(same(lanes.picture, plain.picture)) << width << " display";
  }
}

TEST_P(PictureDeterminism, EveryTargetThreadCountOrderAndWidth) {
  const auto check = [](int width, std::initializer_list<int> thread_counts) {
    const Scene s(width);
    const auto run = [&](const parallel::Executor& executor) { return hash_of(s.by_lanes(GetParam(), executor)); };
    rainref::test::expect_one_result(fmt::format("width {}", width), run, thread_counts);
    select_simd_target("");
  };
  for (int width = 1; width <= 33; ++width) check(width, {1});
  check(33, {2, 3, 8});
}

}  // namespace
}  // namespace rainref::windshield
