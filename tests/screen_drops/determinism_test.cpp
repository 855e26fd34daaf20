// The determinism proof: every SIMD target, 1, 2, 3 and 8 threads, shuffled tiles, widths 1 to 33 give the bits of one plain
// float after another; and how far those are from doubles.
#include "determinism.h"
#include "pass/display.h"
#include "pass/display_scalar.h"
#include "screen_drops/support.h"

namespace rainref::screen_drops {
namespace {

using rainref::test::expect_one_result;
using rainref::test::hash_of_frames;
using test::Double;
using test::Single;

auto run_of(const Settings& s, bool flows = true) {
  return [&s, flows](const parallel::Executor& executor) {
    FlowSettings flow = test::wet_pane();
    flow.pane = {s.pane_height * s.width / s.height, s.pane_height};
    flow.wind = 100;
    flow.warm_up = 0.2;
    return hash_of_frames(ScreenDrops(s, test::inputs(s), executor, flows && s.variant == Variant::corrected ? &flow : nullptr));
  };
}

class ScreenDropsDeterminism : public rainref::test::OfVariant {};
INSTANTIATE_TEST_SUITE_P(Variants, ScreenDropsDeterminism, rainref::test::both_variants, rainref::test::variant_name);

TEST_P(ScreenDropsDeterminism, EveryTargetThreadCountOrderAndWidth) {
  for (int width = 1; width <= 33; ++width) {
    Settings s = test::settings(GetParam(), width, 19);
    s.printed_misprint = width % 7 == 0;
    s.printed_normal = width % 5 == 0;
    s.noise_filter = width % 3 == 0 ? Filter::nearest : Filter::linear;
    s.layers = 1 + width % 6;
    expect_one_result(fmt::format("width {}", width), run_of(s));
  }
}
TEST_P(ScreenDropsDeterminism, OtherSeedOtherBits) {
  Settings s = test::settings(GetParam(), 33, 21);
  const std::string before = run_of(s, false)(parallel::Executor(1));
  s.seed = 4;
  EXPECT_NE(run_of(s, false)(parallel::Executor(1)), before);
}

void expect_same(Half found, Single expected, const char* what, int x, int y) {
  Half stored;
  store(&stored, expected, Rounding::rne);
  ASSERT_EQ(found.bits, stored.bits) << what << " at " << x << "," << y;
}

// Each pass of a run against the scalar evaluation of the same text; and that one against doubles where both show the same water.
TEST_P(ScreenDropsDeterminism, LanesEqualTheScalarEvaluationWhichIsNearDouble) {
  const bool corrected = GetParam() == Variant::corrected;
  Settings s = test::settings(GetParam(), 61, 39);
  s.pane_height = 0.05;
  FlowSettings flow = test::wet_pane();
  flow.pane = {s.pane_height * s.width / s.height, s.pane_height};
  flow.wind = 100;
  flow.warm_up = 0.5;
  const Inputs in = test::inputs(s);
  const std::vector<Image> levels = scene_levels(in.colour);
  std::vector<float> texels;
  Texture scene;
  scene.channels = 4;
  scene.levels = static_cast<int>(levels.size());
  scene.precision = TexelPrecision::float16;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    scene.width[l] = levels[l].width();
    scene.height[l] = levels[l].height();
    scene.offset[l] = static_cast<std::int32_t>(texels.size() / 4);
    for (int y = 0; y < levels[l].height(); ++y) {
      for (int i = 0; i < 4 * levels[l].width(); ++i) texels.push_back(to_float(levels[l].row<Half>(y)[i]));
    }
  }
  scene.texels = texels.data();
  const TextureData noise(make_noise(s.seed, s.noise_size), Address::repeat, Address::repeat);
  const std::vector<Tap> taps = make_taps(s);
  for (const std::string& target : simd_targets()) {
    select_simd_target(target);
    ScreenDrops window(s, in, test::executor(), corrected ? &flow : nullptr);
    for (int frame = 0; frame < 9; ++frame) window.next_frame();
    const BackgroundUniforms b = background_uniforms(s);
    const PublishedDropsUniforms p = published_drops_uniforms(s, 8);
    DropsUniforms d{};
    TextureData cells, height;
    if (corrected) {
      d = drops_uniforms(s, make_layers(s), {window.height().width(), window.height().height()});
      cells = TextureData(window.cells(), Address::clamp, Address::clamp);
      height = TextureData(window.height(), Address::clamp, Address::clamp);
    }
    int wet = 0, far = 0;
    for (int y = 0; y < s.height; ++y) {
      for (int x = 0; x < s.width; ++x) {
        const auto blurred = corrected ? scalar::background_corrected<Single>(b, scene, taps.data(), x, y)
                                       : scalar::background_as_published<Single>(b, scene, x, y);
        const Half* below = window.background().row<Half>(y) + 4 * x;
        expect_same(below[0], blurred.x, "background.r", x, y);
        expect_same(below[2], blurred.z, "background.b", x, y);
        const auto window_of = [&](auto n) {
          using N = decltype(n);
          const scalar::Vec3<N> own(N::load(below), N::load(below + 1), N::load(below + 2));
          return corrected ? scalar::drops_corrected<N>(d, scene, cells.view(), height.view(), own, x, y)
                           : scalar::drops_as_published<N>(p, scene, noise.view(), own, x, y);
        };
        const auto w = window_of(Single());
        const Half* stored = window.colour().row<Half>(y) + 4 * x;
        expect_same(stored[0], w.colour.x, "colour.r", x, y);
        expect_same(stored[1], w.colour.y, "colour.g", x, y);
        expect_same(stored[2], w.colour.z, "colour.b", x, y);
        ASSERT_EQ(window.water().row<Unorm8>(y)[x].code, to_unorm8(w.water.v).code) << target << " " << x << "," << y;
        const auto shown =
            pass::scalar::display<Single>(pass::display_uniforms(s.exposure),
                                          scalar::Vec3<Single>(Single::load(stored), Single::load(stored + 1), Single::load(stored + 2)));
        ASSERT_EQ(window.picture().row<Unorm8>(y)[4 * x + 1].code, to_unorm8(shown.y.v).code) << target << " " << x << "," << y;
        const auto exact = window_of(Double());
        wet += w.water.v > 0;
        // A lookup of texels that differ by 1 in 1 / 61: 1e-4 of a texel.
        far += std::abs(exact.water.v - w.water.v) < 1e-4 && std::abs(exact.colour.x.v - w.colour.x.v) > 1e-4;
      }
    }
    EXPECT_GT(wet, 50) << target;
    EXPECT_LE(far, 3) << target;  // at the edge of total reflection a root magnifies
  }
}

}  // namespace
}  // namespace rainref::screen_drops
