// The determinism proof of the puddle's kernels: every SIMD target, 1, 2, 3 and 8 threads, shuffled tiles, widths 1 to 33
// give the bits of one plain float after another.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "determinism.h"
#include "rainref/executor.h"
#include "puddle/bounds.h"
#include "puddle/ground.h"
#include "puddle/host.h"
#include "puddle/kernels.h"
#include "puddle/scalar.h"
#include "rainref/puddle.h"
#include "settings.h"

namespace rainref::puddle {
namespace {

using rainref::test::expect_one_result;
using rainref::test::hash_of_frames;
using F = scalar::Scalar<float>;

// An environment and a ground with structure, small enough to be made for every case.
Image pattern(int width, int height, float scale) {
  Image image(Format::rgba32f, width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 4; ++c) image.row<float>(y)[4 * x + c] = scale * static_cast<float>(1 + (7 * x + 13 * y + 5 * c) % 17);
    }
  }
  return image;
}
Surroundings surroundings() {
  Surroundings s;
  s.environment = pattern(16, 8, 0.05f);
  s.ground = pattern(8, 8, 0.02f);
  return s;
}

Settings settings(Variant variant, int width, Format storage = Format::rg16f) {
  Settings s = rainref::test::puddle_settings();
  s.variant = variant;
  s.storage = storage;
  s.width = width;
  s.height = 5;
  s.seed = 3;
  s.fog_depth = 0.02;
  s.vignette = 0.3;
  s.tint = {0.05, 0.04, 0.03};
  if (variant == Variant::as_published) {
    s.drop_count = 10;
    s.rain_speed = 7;
    s.ground_scale = 0.15;
    s.water_turbidity = 0.05;
    s.puddle_depth = 5;
    s.reflectivity = 0.6;
    s.camera_position = {20, 18, 14};
    s.camera_target = {-6, -4, 10};
    s.vertical_fov_deg = 60;
  } else {
    s.grid = {width + 1, 7};
    s.cell_size = 0.05;
    s.shape = Shape::basin;
    s.rain_rate = 60;
    s.ground_reach = 0.3;  // the street's own ground is seen in whole vectors, in parts of them and not at all
    s.camera_position = {0.2, 0.5, 0.9};
    s.camera_target = {0, 0, 0};
  }
  return s;
}

auto run_of(const Settings& s) {
  return [s](const parallel::Executor& executor) { return hash_of_frames(Puddle(s, surroundings(), executor)); };
}

class PuddleDeterminism : public rainref::test::OfVariant {};
INSTANTIATE_TEST_SUITE_P(Variants, PuddleDeterminism, rainref::test::both_variants, rainref::test::variant_name);

TEST_P(PuddleDeterminism, EveryTargetThreadCountOrderAndWidth) {
  for (int width = 1; width <= 33; ++width) expect_one_result(fmt::format("width {}", width), run_of(settings(GetParam(), width)));
}

TEST_P(PuddleDeterminism, EveryStorageAndRounding) {
  for (const Format storage : {Format::rg16f, Format::rg32f, Format::rgba8}) {
    for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
      Settings s = settings(GetParam(), 45, storage);
      s.rounding = rounding;
      s.height = 70;  // several tiles
      if (GetParam() == Variant::corrected) s.grid = {47, 71};
      expect_one_result(fmt::format("{} {}", info(storage).name, name(rounding)), run_of(s), {3});
    }
  }
}

TEST_P(PuddleDeterminism, OtherSeedOrRainOtherBits) {
  // The hashes above would also agree if nothing happened.
  Settings s = settings(GetParam(), 33);
  const std::string before = run_of(s)(parallel::Executor(1));
  if (GetParam() == Variant::corrected)
    s.seed = 4;
  else
    s.rain_speed = 8;
  EXPECT_NE(run_of(s)(parallel::Executor(1)), before);
}

void expect_same(const float found, F expected, const char* what, int x, int y) {
  ASSERT_EQ(std::bit_cast<std::uint32_t>(found), std::bit_cast<std::uint32_t>(expected.v + 0.0f)) << what << " at " << x << "," << y;
}
void expect_same(Half found, F expected, const char* what, int x, int y) {
  Half stored;
  store(&stored, expected, Rounding::rne);
  ASSERT_EQ(found.bits, stored.bits) << what << " at " << x << "," << y;
}

// Each picture pass of a run against the scalar evaluation of the same text, from the same stored inputs.
TEST_P(PuddleDeterminism, LanesEqualTheScalarEvaluation) {
  const bool corrected = GetParam() == Variant::corrected;
  Settings s = settings(GetParam(), 37);
  s.height = 23;
  if (corrected) s.grid = {31, 29};
  if (corrected) s.shape = Shape::natural;
  const Surroundings around = surroundings();
  for (const std::string& target : simd_targets()) {
    select_simd_target(target);
    const parallel::Executor executor(2);
    Puddle puddle(s, around, executor);
    for (int frame = 0; frame < 6; ++frame) puddle.simulate();
    puddle.render();

    const Image& shown = corrected ? puddle.newest() : puddle.previous();
    std::vector<float> decoded(static_cast<std::size_t>(shown.width()) * shown.height());
    for (int y = 0; y < shown.height(); ++y) {
      for (int x = 0; x < shown.width(); ++x) decoded[static_cast<std::size_t>(y) * shown.width() + x] = to_float(shown.row<Half>(y)[x]);
    }
    SurfaceHitUniforms u = surface_hit_uniforms(s);
    TextureData bounds;
    if (corrected) bounds = surface_bounds(s, decoded.data(), executor, u);
    const Address edge = corrected ? Address::border : Address::clamp;
    TextureData water(decoded, 1, shown.width(), shown.height(), edge, edge);
    water.set_border(encoding(s).rest, 0, 0, 0);
    for (int y = 0; y < s.height; ++y) {
      for (int x = 0; x < s.width; ++x) {
        const auto hit = corrected ? scalar::surface_hit_corrected<F>(u, water.view(), bounds.view(), x, y)
                                   : scalar::surface_hit_as_published<F>(u, water.view(), x, y);
        const float* stored = puddle.hit().row<float>(y) + 4 * x;
        expect_same(stored[0], hit.position.x, "hit.x", x, y);
        expect_same(stored[1], hit.position.y, "hit.y", x, y);
        expect_same(stored[2], hit.position.z, "hit.z", x, y);
        expect_same(stored[3], hit.iterations, "iterations", x, y);
        const Half* normal = puddle.normal().row<Half>(y) + 4 * x;
        expect_same(normal[0], hit.normal.x, "normal.x", x, y);
        expect_same(normal[1], hit.normal.y, "normal.y", x, y);
        expect_same(normal[2], hit.normal.z, "normal.z", x, y);
        expect_same(normal[3], hit.flag, "flag", x, y);

        // display reads what shade stored.
        const Half* colour = puddle.colour().row<Half>(y) + 4 * x;
        const scalar::Vec3<F> linear(F(to_float(colour[0])), F(to_float(colour[1])), F(to_float(colour[2])));
        const DisplayUniforms d = display_uniforms(s);
        const auto shown_colour =
            corrected ? scalar::display_corrected<F>(d, linear, x, y) : scalar::display_as_published<F>(d, linear, x, y);
        const Unorm8* code = puddle.picture().row<Unorm8>(y) + 4 * x;
        ASSERT_EQ(code[0].code, to_unorm8(shown_colour.x.v).code) << target << " " << x << "," << y;
        ASSERT_EQ(code[1].code, to_unorm8(shown_colour.y.v).code);
        ASSERT_EQ(code[2].code, to_unorm8(shown_colour.z.v).code);
      }
    }
  }
}

}  // namespace
}  // namespace rainref::puddle
