// The determinism proof of the kernels: every SIMD target, 1, 2, 3 and 8 threads, shuffled tiles, widths 1 to 33 give the bits
// of one plain float after another; and how far those are from doubles.
#include <bit>

#include "determinism.h"
#include "edge_splash/info.h"
#include "edge_splash/shapes.h"
#include "edge_splash/support.h"
#include "pass/same_as_definition.h"
#include "settings.h"

namespace rainref::edge_splash {
namespace {

using rainref::test::expect_one_result;
using rainref::test::hash_of_frames;

Inputs scene_of(int width, int height) {
  Inputs in = inputs_of_distance(width, height, [&](int x, int y) {
    return 3 * y < height + (x * 5) % 7 ? 0.8 + 0.03 * x : y > height / 2 + x / 3 ? 900.0 : 4.0 + 0.2 * y;
  });
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < 4 * width; ++i) in.colour.row<float>(y)[i] = 0.02f * static_cast<float>(1 + (7 * i + 13 * y) % 41);
  }
  in.layer = plane_of(width, height, [](int x, int y) { return ((x + 2 * y) % 5) / 4.0; });
  return in;
}
Settings settings(Variant variant) {
  Settings s = rainref::test::edge_splash_settings();
  s.variant = variant;
  s.rain_drop_scale = 0.4;
  s.drop_alpha = 0.8;
  s.drop_speed = 133;
  s.band = 0.2;
  s.largest_band = 0.05;
  s.seed = 3;
  return s;
}
auto run_of(const Settings& s, const Inputs& in) {
  return [&s, &in](const parallel::Executor& executor) { return hash_of_frames(EdgeSplash(s, in, executor)); };
}

class EdgeSplashDeterminism : public rainref::test::OfVariant {};
INSTANTIATE_TEST_SUITE_P(Variants, EdgeSplashDeterminism, rainref::test::both_variants, rainref::test::variant_name);

TEST_P(EdgeSplashDeterminism, EveryTargetThreadCountOrderAndWidth) {
  for (int width = 1; width <= 33; ++width) {
    Settings s = settings(GetParam());
    s.storage = width % 2 == 0 ? Format::rgba8 : Format::rgba16f;
    Inputs in = scene_of(width, 19);
    in.noise = make_noise(1, 64);  // once, not in each of seven hundred runs
    expect_one_result(fmt::format("width {}", width), run_of(s, in));
  }
}

TEST_P(EdgeSplashDeterminism, AnotherSettingGivesOtherBits) {
  // The hashes above would also agree if nothing happened.
  Settings s = settings(GetParam());
  const Inputs in = scene_of(33, 19);
  const std::string before = run_of(s, in)(parallel::Executor(1));
  s.seed = 4;
  EXPECT_NE(run_of(s, in)(parallel::Executor(1)), before);
  s.seed = 3;
  s.drop_alpha = 0.5;
  EXPECT_NE(run_of(s, in)(parallel::Executor(1)), before);
}

// What both passes of one variant need, read by plain numbers.
struct Evaluation {
  Settings s = rainref::test::edge_splash_settings();
  Inputs in;
  Image scene, layer, depth_image, noise_image;
  TextureData depth, noise;
  Evaluation(Variant variant, int width, int height)
      : s(settings(variant)),
        in(scene_of(width, height)),
        scene(prepare_scene(in.colour, in.colour_is_encoded)),
        layer(prepare_layer(in.layer, in.colour)) {
    s.width = width;
    s.height = height;
    const bool corrected = variant == Variant::corrected;
    depth_image = prepare_depth(in.depth, in.depth_is_distance, in.colour, s.depth);
    noise_image = prepare_noise(in.noise, s);
    depth = TextureData(depth_image, corrected ? Address::clamp : Address::border, corrected ? Address::clamp : Address::border);
    noise = TextureData(noise_image, corrected ? Address::repeat : Address::border, corrected ? Address::repeat : Address::border);
  }
  template <class N>
  scalar::Splash<N> at(int frame, int x, int y) const {
    scalar::Channels<N, 4> c;
    for (int k = 0; k < 4; ++k) c[k] = N::load(scene.row<Half>(y) + 4 * x + k);
    if (s.variant == Variant::as_published) {
      return scalar::splash_as_published<N>(published_splash_uniforms(s, frame, noise_image.width(), noise_image.height()), depth.view(),
                                            noise.view(), c, x, y);
    }
    return scalar::splash_corrected<N>(splash_uniforms(s, frame, noise_image.width(), noise_image.height()), depth.view(), noise.view(),
                                       N::load(layer.row<Unorm8>(y) + x), c, x, y);
  }
};

TEST_P(EdgeSplashDeterminism, LanesEqualTheScalarEvaluation) {
  const Evaluation evaluation(GetParam(), 37, 29);
  for (const Format storage : {Format::rgba16f, Format::rgba8}) {
    Settings s = evaluation.s;
    s.storage = storage;
    for (const std::string& target : simd_targets()) {
      select_simd_target(target);
      const parallel::Executor executor(2);
      EdgeSplash effect(s, evaluation.in, executor);
      const auto cases = rainref::test::captured(effect_info(), GetParam() == Variant::corrected, "", [&](Recorder& recorder) {
        for (int frame = 0; frame < 5; ++frame) effect.next_frame(&recorder);
      });
      ASSERT_TRUE(rainref::test::are_as_defined(cases, evaluations())) << target << ' ' << info(storage).name;
    }
  }
}

// Thresholds jump, so as published a few pixels in a hundred may fall on the other side (the flat ones, whose gradient is nothing
// but rounding); where the masks agree, and everywhere corrected, float stays beside double.
TEST_P(EdgeSplashDeterminism, FloatStaysNearDouble) {
  const Evaluation evaluation(GetParam(), 96, 64);
  int jumped = 0, checked = 0;
  double worst = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 96; ++x) {
      const auto f = evaluation.at<F>(7, x, y);
      const auto d = evaluation.at<D>(7, x, y);
      ++checked;
      if (GetParam() == Variant::as_published &&
          (f.edge.v != d.edge.v || f.noise.v != d.noise.v || (f.edge.v == 1 && f.angle.v != d.angle.v))) {
        ++jumped;
        continue;
      }
      for (int k = 0; k < 4; ++k) worst = std::max(worst, std::abs(f.colour[k].v - d.colour[k].v));
      if (GetParam() == Variant::corrected) {
        worst = std::max({worst, std::abs(f.edge.v - d.edge.v), std::abs(f.angle.v - d.angle.v), std::abs(f.noise.v - d.noise.v)});
      }
    }
  }
  RecordProperty("worst", fmt::format("{:.3g}", worst));
  RecordProperty("jumped", jumped);
  EXPECT_LE(jumped, checked / 100);
  // Measured 8e-5: distances up to 900 m carry 2^-24 of 1 / z, which ramps of the masks magnify.
  EXPECT_LT(worst, GetParam() == Variant::corrected ? 1e-3 : 1e-6);
}

// The built-in scene is the same whatever the threads; what its camera sees stands where it was put.
TEST(EdgeSplashShapes, SameBitsAndKnownDistances) {
  const scene::Camera eye{{5, 5, 0}, {5, 0.15, -7.5}, {0, 1, 0}, 20};
  const parallel::Executor one(1);
  parallel::Executor three(3);
  three.shuffle_tiles(5);
  const ShapesView a = render_shapes(eye, 61, 47, 1000, one), b = render_shapes(eye, 61, 47, 1000, three);
  EXPECT_TRUE(same(a.colour, b.colour) && same(a.depth, b.depth));
  // The middle of the picture looks at the slab's top, (5, .75, -z): on the line from the eye to (5, .15, -7.5) at height .75.
  const double share = (5 - 0.75) / (5 - 0.15), expected = share * std::hypot(5 - 0.15, 7.5);
  EXPECT_NEAR(a.depth.row<float>(23)[30], expected, 1e-4);
  // Past everything there is nothing.
  const ShapesView sky = render_shapes({{0, 50, 0}, {0, 100, -1}, {0, 1, 0}, 20}, 8, 8, 1000, one);
  for (int x = 0; x < 8; ++x) EXPECT_EQ(sky.depth.row<float>(4)[x], 1000);
}

}  // namespace
}  // namespace rainref::edge_splash
