// The determinism proof: every SIMD target, 1, 2, 3 and 8 threads, shuffled tiles, widths 1 to 33 give the bits of one plain
// float after another.
#include <bit>

#include "determinism.h"
#include "rainy_glass/support.h"
#include "pass/same_as_definition.h"
#include "rainy_glass/info.h"

namespace rainref::rainy_glass {
namespace {

using rainref::test::expect_one_result;
using rainref::test::hash_of_frames;
using test::Single;

auto run_of(const Settings& s) {
  return [&s](const parallel::Executor& executor) { return hash_of_frames(RainyGlass(s, test::surroundings(s), executor)); };
}

class RainyGlassDeterminism : public rainref::test::OfVariant {};
INSTANTIATE_TEST_SUITE_P(Variants, RainyGlassDeterminism, rainref::test::both_variants, rainref::test::variant_name);

TEST_P(RainyGlassDeterminism, EveryTargetThreadCountOrderAndWidth) {
  for (int width = 1; width <= 33; ++width) {
    Settings s = test::settings(GetParam(), width, 19);
    s.map_size = 4 + width;
    s.droplet_count = 12;
    s.shape = width % 3 == 0 ? Shape::sphere : Shape::pane;
    s.use_probe = width % 5 == 0;
    expect_one_result(fmt::format("width {}", width), run_of(s));
  }
}

TEST_P(RainyGlassDeterminism, EveryStorageRoundingAndManyBakeTiles) {
  for (const Format storage : {Format::rgba8, Format::rgba16f}) {
    for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
      Settings s = test::settings(GetParam(), 45, 41);
      s.map_storage = storage;
      s.rounding = rounding;
      s.map_size = 147;  // several tiles of the bakes, the last ones cut
      expect_one_result(fmt::format("{} {}", info(storage).name, name(rounding)), run_of(s), {3});
    }
  }
}

// The readings of the shipped shader are other branches of the same text.
TEST(RainyGlassShippedDeterminism, EveryTargetThreadCountOrderAndWidth) {
  for (int width = 1; width <= 33; ++width) {
    Settings s = test::shipped_settings(width, 19);
    s.map_size = 4 + width;
    s.droplet_count = 12;
    s.map_storage = width % 2 == 0 ? Format::rgba8 : Format::rgba16f;
    s.shape = width % 3 == 0 ? Shape::sphere : Shape::pane;
    s.use_probe = width % 5 == 0;
    expect_one_result(fmt::format("width {}", width), run_of(s));
  }
  select_simd_target("");
}
TEST(RainyGlassShippedDeterminism, LanesEqualTheScalarEvaluation) {
  for (const Format storage : {Format::rgba8, Format::rgba16f}) {
    Settings s = test::shipped_settings(61, 39);
    s.shape = Shape::sphere;
    s.map_storage = storage;
    const Surroundings around = test::surroundings(s);
    for (const std::string& target : simd_targets()) {
      select_simd_target(target);
      RainyGlass glass(s, around, test::executor());
      const auto cases = rainref::test::captured(effect_info(), false, "", [&](Recorder& recorder) {
        for (int frame = 0; frame < 8; ++frame) glass.next_frame();
        glass.next_frame(&recorder);
      });
      EXPECT_TRUE(rainref::test::are_as_defined(cases, evaluations())) << target;
    }
  }
  select_simd_target("");
}

TEST_P(RainyGlassDeterminism, OtherSeedTimeOrRainOtherBits) {
  Settings s = test::settings(GetParam(), 33, 21);
  const std::string before = run_of(s)(parallel::Executor(1));
  s.seed = 4;
  EXPECT_NE(run_of(s)(parallel::Executor(1)), before);
  s.seed = 3;
  s.rain_amount = 0.6;
  EXPECT_NE(run_of(s)(parallel::Executor(1)), before);
}

void expect_same(Half found, Single expected, const char* what, int x, int y) {
  Half stored;
  store(&stored, expected, Rounding::rne);
  ASSERT_EQ(found.bits, stored.bits) << what << " at " << x << "," << y;
}

// Each pass of a run against the scalar evaluation of the same text. The bakes are read with every record in the list, so this
// also proves that what droplets_near and trails_near leave out changes no bit.
TEST_P(RainyGlassDeterminism, LanesEqualTheScalarEvaluation) {
  const bool corrected = GetParam() == Variant::corrected;
  Settings s = test::settings(GetParam(), 61, 39);
  s.map_storage = Format::rgba16f;
  s.map_size = 131;
  const Surroundings around = test::surroundings(s);
  for (const std::string& target : simd_targets()) {
    select_simd_target(target);
    RainyGlass glass(s, around, test::executor());
    const auto cases = rainref::test::captured(effect_info(), corrected, "", [&](Recorder& recorder) {
      glass.next_frame(&recorder);
      for (int frame = 1; frame < 8; ++frame) glass.next_frame();
      glass.next_frame(&recorder);
    });
    ASSERT_EQ(cases.size(), 6u);

    const std::vector<Droplet> droplets = make_droplets(s);
    const std::vector<Trail> trails = make_trails(s);
    const TextureData lattice(make_lattice(s), Address::repeat, Address::repeat);
    for (int y = 0; y < s.map_size; ++y) {
      for (int x = 0; x < s.map_size; ++x) {
        const auto d = scalar::bake_raindrops<Single>(bake_raindrops_uniforms(s, static_cast<int>(droplets.size())), corrected,
                                                      droplets.data(), static_cast<int>(droplets.size()), x, y);
        const Half* stored = glass.raindrops().row<Half>(y) + 4 * x;
        int channel = 0;
        for (const Single n : {d.r, d.g, d.b, d.a}) expect_same(stored[channel++], n, "raindrops", x, y);
        const auto r = scalar::bake_rivulets<Single>(bake_rivulets_uniforms(s, static_cast<int>(trails.size())), trails.data(),
                                                     static_cast<int>(trails.size()), lattice.view(), x, y);
        stored = glass.rivulets().row<Half>(y) + 4 * x;
        channel = 0;
        for (const Single n : {r.r, r.g, r.b, r.a}) expect_same(stored[channel++], n, "rivulets", x, y);
      }
    }

    EXPECT_TRUE(rainref::test::are_as_defined(cases, evaluations())) << target;
  }
}

// How far the reference is from real arithmetic: heights and offsets of the bake, and the picture away from thresholds.
TEST_P(RainyGlassDeterminism, FloatIsNearDouble) {
  const bool corrected = GetParam() == Variant::corrected;
  const Settings s = test::settings(GetParam(), 8, 8);
  const std::vector<Droplet> droplets = make_droplets(s);
  const int count = static_cast<int>(droplets.size());
  const BakeRaindropsUniforms u = bake_raindrops_uniforms(s, count);
  for (int y = 0; y < s.map_size; ++y) {
    for (int x = 0; x < s.map_size; ++x) {
      const auto f = scalar::bake_raindrops<Single>(u, corrected, droplets.data(), count, x, y);
      const auto d = scalar::bake_raindrops<test::Double>(u, corrected, droplets.data(), count, x, y);
      // Places are exact; the matrix, the square and the sum round, at a height of at most 1.
      EXPECT_NEAR(f.a.v, d.a.v, 1e-6);
      EXPECT_EQ(f.b.v, d.b.v);
      if (d.a.v > 1e-5 || d.a.v == 0) {
        EXPECT_NEAR(f.r.v, d.r.v, 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace rainref::rainy_glass
