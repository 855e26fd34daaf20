// The determinism proof of every pass: each SIMD target, 1, 2, 3 and 8 threads, shuffled tiles, widths 1 to 33 give the bits that the
// definitions give one number at a time.
#include "determinism.h"
#include "pass/same_as_definition.h"
#include "windshield/golden_scenes.h"
#include "windshield/info.h"

namespace rainref::windshield {
namespace {

using rainref::test::expect_one_result;
using rainref::test::hash_of_frames;

/// A drive on which every pass runs (many drops: all but those of the falling rain), the picture and the scene before the car so many
/// texels wide, the textures somewhat wider. A fifth of a second a frame: blades move on, drops are many.
std::string drive(Variant variant, int width, bool has_many_drops = false) {
  const std::string both = fmt::format(
      "seed = 5\n[run]\nsize = [{}, 11]\nfps = 5\n[vehicle]\nkey_frames = '0 2 0; 1 9 0.3; 2 4 -0.1'\n[wipers]\ncycles_per_minute = 60\n"
      "[camera]\nvertical_fov_deg = 50\n[falling_rain]\non = {}\nexposure = 0.02\ngain = 10\nsmallest_drop = 1.5\n"
      "[windshield]\nheight_size = [{}, 13]\nrounding = '{}'\npanes = '0.2 0.8 0.9, 1.2 0.8 0.9, 0.2 0.7 1.5'\n",
      width, !has_many_drops, width + 8, width % 2 ? "rtz" : "rne");
  if (variant == Variant::as_published)
    return both + fmt::format("drag = 3\nheight_tau = 0.5\nblend = 'max'\nspawn_rate = {}\n", has_many_drops ? 30000 : 2000);
  return both + fmt::format(
                    "substeps = 2\nlean = 0.8\nneck_time = 1.5\n[smear]\non = true\nwear = 0.8\n[condensation]\non = true\ntau = 2\n"
                    "[interior]\non = true\nlight = 0.1\n[rain]\nrate = {}\nsmallest_drop = {}\n",
                    has_many_drops ? 200 : 50, has_many_drops ? 0.3 : 0.8);
}

class WindshieldDeterminism : public rainref::test::OfVariant {
 protected:
  /// The passes of a later frame with this target, which have the bits of their definitions.
  std::vector<capture::PassCase> cases_as_defined(const std::string& target, int width, std::string_view pass,
                                                  bool has_many_drops = false) {
    select_simd_target(target);
    parallel::Executor executor(1 + width % 3);
    executor.shuffle_tiles(static_cast<std::uint64_t>(width));
    Windshield w(config_of(name(GetParam()), drive(GetParam(), width, has_many_drops)), small_surroundings(width, 13), executor);
    for (int frame = 0; frame < 3; ++frame) w.next_frame();
    std::vector<capture::PassCase> cases = rainref::test::captured(effect_info(), GetParam() == Variant::corrected, pass,
                                                                   [&](Recorder& recorder) { w.next_frame(&recorder); });
    EXPECT_TRUE(rainref::test::are_as_defined(cases, evaluations())) << target << ", width " << width;
    return cases;
  }
};
INSTANTIATE_TEST_SUITE_P(Variants, WindshieldDeterminism, rainref::test::both_variants, rainref::test::variant_name);

TEST_P(WindshieldDeterminism, EveryTargetThreadCountOrderAndWidth) {
  for (int width = 1; width <= 33; ++width) {
    const scene::Config config = config_of(name(GetParam()), drive(GetParam(), width));
    const auto run = [&](const parallel::Executor& executor) {
      return hash_of_frames(Windshield(config, small_surroundings(width, 13), executor));
    };
    if (width % 16 == 1)
      expect_one_result(fmt::format("width {}", width), run);
    else
      expect_one_result(fmt::format("width {}", width), run, {1 + width % 3});
  }
}

TEST_P(WindshieldDeterminism, LanesEqualTheScalarEvaluation) {
  const std::vector<std::string> targets = simd_targets();
  std::vector<std::string> missing = effect_info().pass_names(name(GetParam()));
  for (int width = 1; width <= 33; ++width) {
    for (const capture::PassCase& c : cases_as_defined(targets[static_cast<std::size_t>(width) % targets.size()], width, ""))
      std::erase(missing, c.pass);
  }
  EXPECT_EQ(missing, std::vector<std::string>());
}

TEST_P(WindshieldDeterminism, ListsOfSeveralChunksEqualTheScalarEvaluation) {
  for (const std::string& target : simd_targets()) {
    for (const char* pass : {"integrate", "wipe_drops"}) {
      const std::vector<capture::PassCase> cases = cases_as_defined(target, 33, pass, true);
      EXPECT_GT(cases.front().outputs.front().array.width, 4096) << pass;
      EXPECT_NE(cases.front().input("drops")->array.levels, cases.front().outputs.front().array.levels) << pass << " does something";
    }
  }
}

}  // namespace
}  // namespace rainref::windshield
