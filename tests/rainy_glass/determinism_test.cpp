// The determinism proof: every SIMD target, 1, 2, 3 and 8 threads, shuffled tiles, widths 1 to 33 give the bits of one plain
// float after another.
#include <bit>

#include "capture/hash_of_frames.h"
#include "math/simd_target.h"
#include "rainy_glass/support.h"
#include "pass/display.h"
#include "pass/display_every_evaluation.h"

namespace rainref::rainy_glass {
namespace {

using test::Single;

std::string hash_of_run(const Settings& s, int threads, std::uint64_t shuffle, int frames = 3) {
  parallel::Executor executor(threads);
  executor.shuffle_tiles(shuffle);
  RainyGlass glass(s, test::surroundings(s), executor);
  return capture::hash_of_frames(frames, [&](Recorder* recorder) { glass.next_frame(recorder); });
}

class RainyGlassDeterminism : public testing::TestWithParam<Variant> {
 protected:
  ~RainyGlassDeterminism() override { select_simd_target(""); }
};

TEST_P(RainyGlassDeterminism, EveryTargetThreadCountOrderAndWidth) {
  for (int width = 1; width <= 33; ++width) {
    Settings s = test::settings(GetParam(), width, 19);
    s.map_size = 4 + width;
    s.droplet_count = 12;
    s.shape = width % 3 == 0 ? Shape::sphere : Shape::pane;
    s.use_probe = width % 5 == 0;
    select_simd_target(simd_targets().back());
    const std::string expected = hash_of_run(s, 1, 0);
    for (const std::string& target : simd_targets()) {
      select_simd_target(target);
      for (const int threads : {1, 2, 3, 8}) {
        ASSERT_EQ(hash_of_run(s, threads, static_cast<std::uint64_t>(threads + width)), expected)
            << target << ", " << threads << " threads, width " << width;
      }
    }
  }
}

TEST_P(RainyGlassDeterminism, EveryStorageRoundingAndManyBakeTiles) {
  for (const Format storage : {Format::rgba8, Format::rgba16f}) {
    for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
      Settings s = test::settings(GetParam(), 45, 41);
      s.map_storage = storage;
      s.rounding = rounding;
      s.map_size = 147;  // several tiles of the bakes, the last ones cut
      select_simd_target(simd_targets().back());
      const std::string expected = hash_of_run(s, 1, 0);
      for (const std::string& target : simd_targets()) {
        select_simd_target(target);
        EXPECT_EQ(hash_of_run(s, 3, 99), expected) << target << " " << info(storage).name << " " << name(rounding);
      }
    }
  }
}

TEST_P(RainyGlassDeterminism, OtherSeedTimeOrRainOtherBits) {
  Settings s = test::settings(GetParam(), 33, 21);
  const std::string before = hash_of_run(s, 1, 0);
  EXPECT_EQ(hash_of_run(s, 2, 0), before);
  s.seed = 4;
  EXPECT_NE(hash_of_run(s, 1, 0), before);
  s.seed = 3;
  s.rain_amount = 0.6;
  EXPECT_NE(hash_of_run(s, 1, 0), before);
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
    for (int frame = 0; frame < 9; ++frame) glass.next_frame();

    const std::vector<Droplet> droplets = make_droplets(s);
    const std::vector<Trail> trails = make_trails(s);
    const TextureData lattice(make_lattice(s), Address::repeat, Address::repeat);
    for (int y = 0; y < s.map_size; ++y) {
      for (int x = 0; x < s.map_size; ++x) {
        const auto d = scalar::bake_raindrops<Single>(bake_raindrops_uniforms(s, static_cast<int>(droplets.size())), corrected,
                                                      droplets.data(), static_cast<int>(droplets.size()), x, y);
        const Half* stored = glass.raindrops().row<Half>(y) + 4 * x;
        expect_same(stored[0], d.r, "raindrops.r", x, y);
        expect_same(stored[1], d.g, "raindrops.g", x, y);
        expect_same(stored[2], d.b, "raindrops.b", x, y);
        expect_same(stored[3], d.a, "raindrops.a", x, y);
        const auto r = scalar::bake_rivulets<Single>(bake_rivulets_uniforms(s, static_cast<int>(trails.size())), trails.data(),
                                                     static_cast<int>(trails.size()), lattice.view(), x, y);
        stored = glass.rivulets().row<Half>(y) + 4 * x;
        expect_same(stored[0], r.r, "rivulets.r", x, y);
        expect_same(stored[1], r.g, "rivulets.g", x, y);
        expect_same(stored[2], r.b, "rivulets.b", x, y);
        expect_same(stored[3], r.a, "rivulets.a", x, y);
      }
    }

    const TextureData raindrops(glass.raindrops(), Address::repeat, Address::repeat),
        rivulets(glass.rivulets(), Address::repeat, Address::repeat);
    std::vector<float> halves;
    for (int y = 0; y < s.height; ++y) {
      for (int i = 0; i < 4 * s.width; ++i) halves.push_back(to_float(to_half(around.colour.row<float>(y)[i])));
    }
    const TextureData scene(halves, 4, s.width, s.height, Address::clamp, Address::clamp),
        near(near_depth(around.depth), 1, s.width, s.height, Address::clamp, Address::clamp);
    const scalar::GlassMaps<Texture, Texture, Texture> maps{&raindrops.view(), &rivulets.view(), &scene.view(), &near.view(), nullptr};
    const Code code = code_of(s, s.map_storage);
    const RainOnGlassUniforms u = rain_on_glass_uniforms(s, 8, code, code);
    for (int y = 0; y < s.height; ++y) {
      for (int x = 0; x < s.width; ++x) {
        const float* place = glass.surface().row<float>(y) + 4 * x;
        const Half* n = glass.orientation().row<Half>(y) + 4 * x;
        const float* own = &halves[4 * (static_cast<std::size_t>(y) * s.width + x)];
        const scalar::GlassPixel<Single> p{Single(place[0]),
                                           Single(place[1]),
                                           Single(place[2]),
                                           Single::load(n + 3),
                                           plain::Vec3<Single>(Single::load(n), Single::load(n + 1), Single::load(n + 2)),
                                           plain::Vec3<Single>(Single(own[0]), Single(own[1]), Single(own[2])),
                                           Single(around.depth.row<float>(y)[x])};
        const auto c = corrected ? scalar::rain_on_glass_corrected<Single>(u, maps, p, x, y)
                                 : scalar::rain_on_glass_as_published<Single>(u, maps, p, x, y);
        const Half* stored = glass.colour().row<Half>(y) + 4 * x;
        expect_same(stored[0], c.x, "colour.r", x, y);
        expect_same(stored[1], c.y, "colour.g", x, y);
        expect_same(stored[2], c.z, "colour.b", x, y);
        const auto shown =
            pass::every::display<Single>(pass::display_uniforms(s.exposure),
                                         plain::Vec3<Single>(Single::load(stored), Single::load(stored + 1), Single::load(stored + 2)));
        const Unorm8* code_value = glass.picture().row<Unorm8>(y) + 4 * x;
        ASSERT_EQ(code_value[0].code, to_unorm8(shown.x.v).code) << target << " " << x << "," << y;
        ASSERT_EQ(code_value[2].code, to_unorm8(shown.z.v).code) << target << " " << x << "," << y;
      }
    }
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

INSTANTIATE_TEST_SUITE_P(Variants, RainyGlassDeterminism, testing::Values(Variant::as_published, Variant::corrected),
                         [](const auto& param) { return param.param == Variant::corrected ? "corrected" : "as_published"; });

}  // namespace
}  // namespace rainref::rainy_glass
