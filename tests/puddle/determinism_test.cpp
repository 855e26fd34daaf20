// The determinism proof of the puddle's kernels: every SIMD target, 1, 2, 3 and 8 threads, shuffled tiles, widths 1 to 33
// give the bits of one plain float after another.
#include <gtest/gtest.h>

#include <algorithm>

#include "determinism.h"
#include "pass/same_as_definition.h"
#include "puddle/info.h"
#include "rainref/executor.h"
#include "rainref/puddle.h"
#include "settings.h"

namespace rainref::puddle {
namespace {

using rainref::test::expect_one_result;
using rainref::test::hash_of_frames;

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

TEST_P(PuddleDeterminism, LanesEqualTheScalarEvaluation) {
  const bool corrected = GetParam() == Variant::corrected;
  Settings s = settings(GetParam(), 37);
  s.height = 23;
  if (corrected) s.grid = {31, 29};
  if (corrected) s.shape = Shape::natural;
  for (const std::string& target : simd_targets()) {
    select_simd_target(target);
    const parallel::Executor executor(2);
    Puddle puddle(s, surroundings(), executor);
    for (int frame = 0; frame < 5; ++frame) puddle.simulate();
    auto cases = rainref::test::captured(effect_info(), corrected, "", [&](Recorder& recorder) { puddle.next_frame(&recorder); });
    std::erase_if(cases, [](const auto& c) { return c.pass == "raindrops"; });  // drawn without lanes
    EXPECT_TRUE(rainref::test::are_as_defined(cases, evaluations())) << target;
    for (const char* pass : {"wave_step", "surface_hit", "shade", "display"})
      EXPECT_TRUE(std::any_of(cases.begin(), cases.end(), [&](const auto& c) { return c.pass == pass; })) << pass;
  }
}

}  // namespace
}  // namespace rainref::puddle
