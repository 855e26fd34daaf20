// The determinism proof: every SIMD target, 1, 2, 3 and 8 threads, shuffled tiles, widths 1 to 33 give the bits of one plain
// float after another; and how far those are from doubles.
#include <algorithm>
#include <array>

#include "determinism.h"
#include "pass/same_as_definition.h"
#include "screen_drops/info.h"
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
    s.lod = std::array{Lod::finest, Lod::gradient, Lod::fixed}[static_cast<std::size_t>(width % 3)];
    s.lod_level = 1.25;
    s.wrap = std::array{Address::clamp, Address::repeat, Address::mirror, Address::repeat}[static_cast<std::size_t>(width % 4)];
    s.refraction = 0.7;
    expect_one_result(fmt::format("width {}", width), run_of(s));
  }
}
TEST_P(ScreenDropsDeterminism, OtherSeedOtherBits) {
  Settings s = test::settings(GetParam(), 33, 21);
  const std::string before = run_of(s, false)(parallel::Executor(1));
  s.seed = 4;
  EXPECT_NE(run_of(s, false)(parallel::Executor(1)), before);
}

/// The ninth frame of a wet window with this target.
std::vector<capture::PassCase> ninth_frame(Variant variant, const std::string& target, std::string_view pass, Lod lod = Lod::finest,
                                           Address wrap = Address::clamp) {
  const bool corrected = variant == Variant::corrected;
  Settings s = test::settings(variant, 61, 39);
  s.pane_height = 0.05;
  s.lod = lod;
  s.lod_level = 1.7;
  s.wrap = wrap;
  FlowSettings flow = test::wet_pane();
  flow.pane = {s.pane_height * s.width / s.height, s.pane_height};
  flow.wind = 100;
  flow.warm_up = 0.5;
  select_simd_target(target);
  ScreenDrops window(s, test::inputs(s), test::executor(), corrected ? &flow : nullptr);
  for (int frame = 0; frame < 8; ++frame) window.next_frame();
  return rainref::test::captured(effect_info(), corrected, pass, [&](Recorder& recorder) { window.next_frame(&recorder); });
}

TEST_P(ScreenDropsDeterminism, LanesEqualTheScalarEvaluation) {
  for (const std::string& target : simd_targets()) {
    const std::vector<capture::PassCase> cases = ninth_frame(GetParam(), target, "");
    EXPECT_TRUE(rainref::test::are_as_defined(cases, evaluations())) << target;
    for (const capture::PassCase& c : cases) {
      if (c.pass == "merge") {
        EXPECT_GT(c.output("drops")->array.width, 50);
      }
    }
  }
}

TEST(ScreenDropsLods, LanesEqualTheScalarEvaluation) {
  for (const std::string& target : simd_targets())
    for (const Lod lod : {Lod::finest, Lod::fixed, Lod::gradient})
      for (const Address wrap : {Address::clamp, Address::repeat, Address::mirror}) {
        const std::vector<capture::PassCase> cases = ninth_frame(Variant::as_published, target, "drops", lod, wrap);
        EXPECT_EQ(cases.at(0).input("scene")->address_u, wrap);
        EXPECT_TRUE(rainref::test::are_as_defined(cases, evaluations())) << target << ' ' << static_cast<int>(lod) << ' ' << name(wrap);
      }
}

// Floats and doubles show the same light where both show the same water.
TEST_P(ScreenDropsDeterminism, FloatIsNearDouble) {
  const std::vector<capture::PassCase> cases = ninth_frame(GetParam(), simd_targets().front(), "drops");
  const auto model =
      std::find_if(evaluations().begin(), evaluations().end(), [](const auto& e) { return e.pass == "drops"; })->bind(cases.at(0));
  int wet = 0, far = 0;
  for (int y = 0; y < model->height(); ++y) {
    for (int x = 0; x < model->width(); ++x) {
      std::array<Single, 5> found;  // water, colour
      std::array<Double, 5> exact;
      model->evaluate(x, y, found.data());
      model->evaluate(x, y, exact.data());
      wet += found[0].v > 0;
      // A lookup of texels that differ by 1 in 1 / 61: 1e-4 of a texel.
      far += std::abs(exact[0].v - found[0].v) < 1e-4 && std::abs(exact[1].v - found[1].v) > 1e-4;
    }
  }
  EXPECT_GT(wet, 50);
  EXPECT_LE(far, 3);  // at the edge of total reflection a root magnifies
}

}  // namespace
}  // namespace rainref::screen_drops
