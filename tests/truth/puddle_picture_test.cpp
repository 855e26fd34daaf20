// Traced puddles: recorded hashes, the same bits however they are traced, and what a level puddle must show.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "compositor/embree_isas.h"
#include "image/images.h"
#include "truth/golden_scenes.h"
#include "truth/puddle_scene.h"
#include "golden/recorded.h"
#include "math/half.h"
#include "math/simd_target.h"
#include "rainref/error.h"
#include "settings.h"

namespace rainref::truth {
namespace {

class Golden : public ::testing::TestWithParam<GoldenScene> {};

TEST_P(Golden, HashesAreAsRecordedForEveryIsaTargetAndThread) {
  // Each choice once, several of them in one picture: whichever changes a bit, one of the pictures differs.
  const std::vector<std::string> expected = golden::recorded(GetParam().name + " "), targets = simd_targets();
  ASSERT_FALSE(expected.empty());
  const std::vector<std::string> isas = rainref::test::embree_isas();
  const std::vector<int> threads{1, 2, 3, 8};
  const std::string before = selected_simd_target();
  for (std::size_t k = 0; k < std::max(isas.size(), targets.size()); ++k) {
    const std::string &isa = isas[k % isas.size()], &target = targets[k % targets.size()];
    parallel::Executor executor(threads[k % threads.size()]);
    executor.shuffle_tiles(k);
    TracerOptions tracer{rainref::test::embree_config(isa)};
    if (k % 2 == 0) tracer = {rainref::test::embree_config(isa), 4, false};
    select_simd_target(target);
    EXPECT_EQ(golden_lines(GetParam(), executor, tracer), expected)
        << "Embree " << isa << ", " << target << ", " << executor.threads() << " threads";
  }
  select_simd_target(before);
}

INSTANTIATE_TEST_SUITE_P(Compositor, Golden, ::testing::ValuesIn(golden_scenes()),
                         [](const auto& scene) { return std::regex_replace(scene.param.name, std::regex("[^a-z]"), "_"); });

Image uniform(int width, int height, float value) {
  return make_image(Format::rgba32f, width, height, [=](int, int, int) { return value; });
}

/// Level water of constant depth, clear, over white ground, in white surroundings.
struct WhiteBasin {
  puddle::Settings settings = rainref::test::puddle_settings();
  puddle::Surroundings around;
  WhiteBasin() {
    settings.width = 48;
    settings.height = 32;
    settings.grid = {40, 30};
    settings.cell_size = 0.05;
    settings.shape = puddle::Shape::basin;
    settings.storage = Format::rg32f;
    settings.rain_rate = 0;
    settings.tint = {1, 1, 1};
    settings.camera_position = {0, 1.2, 1.0};
    settings.camera_target = {0, 0, 0};
    around.environment = uniform(128, 64, 1);
    around.ground = uniform(2, 2, 1);
  }
};

TEST(TracedPuddle, StaysWhiteInAFurnace) {
  WhiteBasin white;
  white.settings.fog_depth = 0.3;
  const parallel::Executor executor(2);
  puddle::Puddle puddle(white.settings, white.around, executor);
  std::vector<float> waves(40 * 30);
  for (std::size_t i = 0; i < waves.size(); ++i) waves[i] = 0.004f * static_cast<float>((i * 37 % 101) / 50.0 - 1);
  puddle.set_water(waves, waves);
  PuddleScene traced(white.settings, white.around, {}, executor);
  traced.update(puddle, executor);
  const Picture p = trace_picture(traced.scene(), traced.camera(), 48, 32, {{}, 4}, executor);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 48; ++x) {
      // The ambient radiance is a midpoint sum, 0.04 % above 1 at 64 rows; a half keeps 11 bits.
      ASSERT_NEAR(to_float(p.beauty.row<Half>(y)[4 * x]), 1, 4e-4 + 0x1p-11) << x << " " << y;
    }
  }
}

TEST(TracedPuddle, LevelWaterLiesWhereThePassesSeeIt) {
  WhiteBasin white;
  const parallel::Executor executor(2);
  puddle::Puddle puddle(white.settings, white.around, executor);
  puddle.simulate();
  puddle.render();
  PuddleScene traced(white.settings, white.around, {}, executor);
  traced.update(puddle, executor);
  const Comparison truth = compare(puddle, white.settings, traced, {}, executor);
  const auto named = [&](const std::string& name) -> const Difference& {
    return *std::find_if(truth.differences.begin(), truth.differences.end(), [&](const Difference& d) { return d.name() == name; });
  };
  EXPECT_GT(truth.pixels[1].second, 1000u);  // water in both
  EXPECT_EQ(truth.pixels[2].second + truth.pixels[3].second, 0u);
  // A few roundings of floats of metres up to 4, 2^-23 each, at angles of at least 27 degrees.
  EXPECT_LT(named("hit_distance").percentiles().max, 4e-6);
  EXPECT_LT(named("normal_angle").percentiles().max, 1e-6);
  // A bed of constant depth is where shade's refraction is exact: what is left is the float of the hit.
  EXPECT_LT(named("ground_offset").percentiles().max, 4e-6);
  // physics P9: Schlick minus Fresnel lies in [-.00936, .05918].
  EXPECT_GT(named("schlick").percentiles().max, 0.005);
  EXPECT_LT(named("schlick").percentiles().max, 0.05919);
}

TEST(TracedPuddle, RefusesWhatHasNoTruth) {
  WhiteBasin white;
  white.settings.variant = Variant::as_published;
  EXPECT_THROW(PuddleScene(white.settings, white.around, {}, parallel::Executor(1)), Error);
}

TEST(Samples, PatternsAreBalancedAndShareNoRowOrColumn) {
  for (const int count : {1, 4, 8, 16}) {
    double x = 0, y = 0;
    std::set<double> columns, rows;
    for (const Sample& s : samples(count)) {
      x += s.x / count;
      y += s.y / count;
      columns.insert(s.x);
      rows.insert(s.y);
      EXPECT_TRUE(s.x >= -0.5 && s.x < 0.5 && s.y >= -0.5 && s.y < 0.5);
    }
    EXPECT_EQ(columns.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(count));
    const double off = count == 16 ? -1.0 / 32 : 0;  // the one of 16 reaches the pixel's edge on one side only
    EXPECT_EQ(x, off);
    EXPECT_EQ(y, off);
  }
  for (const int count : {0, 2, 3, 32}) EXPECT_THROW(samples(count), Error);
}

TEST(Difference, PercentilesAndScale) {
  Difference d("x", "m", 10, 10);
  EXPECT_EQ(d.percentiles().count, 0u);
  for (int i = 0; i < 100; ++i) d.at(i % 10, i / 10) = (i % 2 ? 1 : -1) * 0.01 * (i + 1);
  d.at(9, 9) = Difference::undefined;
  const Percentiles p = d.percentiles();
  EXPECT_EQ(p.count, 99u);
  EXPECT_DOUBLE_EQ(p.p50, 0.50);
  EXPECT_DOUBLE_EQ(p.p90, 0.90);
  EXPECT_DOUBLE_EQ(p.p99, 0.99);
  EXPECT_DOUBLE_EQ(p.max, 0.99);
  EXPECT_EQ(d.scale(), 1);
  EXPECT_EQ(d.file_name(), "x-1m");
  const Image picture = d.picture();
  const auto texel = [&](int x, int y) { return picture.row<Unorm8>(y) + 4 * x; };
  EXPECT_EQ(texel(9, 9)[0].code, 0);                    // undefined
  EXPECT_GT(texel(7, 9)[0].code, texel(7, 9)[2].code);  // 0.98: red
  EXPECT_LT(texel(8, 9)[0].code, texel(8, 9)[2].code);  // -0.99: blue
  EXPECT_LT(texel(0, 0)[0].code, texel(0, 0)[2].code);  // the bar's left end
}

}  // namespace
}  // namespace rainref::truth
