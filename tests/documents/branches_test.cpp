// Ways through a formula that the small packs do not take: the same functions on packs of other settings.
#include "cli/support.h"
#include "documents/judged_written.h"
#include "image_io/read.h"

namespace rainref::documents {
namespace {

using cli::Circumstances;
using cli::Outcome;
using cli::run_rainref;

struct Branch {
  std::string name, pack;
  std::vector<std::string> settings;
  std::string pass, mistake = "wrong branch";  ///< what this way is taken by, and what shows there alone
};
void PrintTo(const Branch& b, std::ostream* out) { *out << b.name; }

/// Six faces of 4 x 4 in a column, no two texels alike.
std::string faces() {
  std::vector<std::string> rows(24);
  for (int y = 0; y < 24; ++y)
    for (int i = 0; i < 12; ++i) rows[static_cast<std::size_t>(y)] += static_cast<char>(30 + (37 * y + 23 * i) % 200);
  return image_io::png(4, 24, 8, 2, rows);
}

const std::string ground = rainref::test::pack_sources() / "ground.png", sun = rainref::test::pack_sources() / "sun.exr";

const std::vector<Branch> branches{
    {"StepBetweenTexels", "puddle-as-published", {"puddle.step=1.5"}, "wave_step"},
    {"StepOfThree", "puddle-as-published", {"puddle.step=3", "puddle.boundary=periodic"}, "wave_step", "centre of s0 forgotten"},
    {"EightBits", "puddle-as-published", {"puddle.storage=rgba8"}, "wave_step", "not packed"},
    {"GroundImage", "puddle-as-published", {"puddle.use_checkerboard=false", "puddle.ground_image=" + ground}, "shade"},
    {"Cube", "puddle-as-published", {"environment.layout=cube", "environment.image=faces.png"}, "shade"},
    {"CorrectedCube", "puddle-corrected", {"environment.layout=cube", "environment.image=faces.png"}, "shade"},
    {"Shore", "puddle-corrected", {"puddle.shape=natural"}, "wave_step"},
    {"Rim", "puddle-corrected", {"puddle.rim_width=0.1"}, "wave_step"},
    {"RimOfAShore", "puddle-corrected", {"puddle.shape=natural", "puddle.rim_width=0.14"}, "wave_step"},
    {"Reflecting", "puddle-corrected", {"puddle.boundary=reflecting"}, "raindrops"},
    {"Periodic", "puddle-corrected", {"puddle.boundary=periodic"}, "raindrops"},
    {"Sheltered", "puddle-corrected", {"rain.shelter=-0.2 -0.2 0.013 0.2"}, "raindrops", "sheltered where it is open"},
    {"Objects", "puddle-corrected", {"puddle.objects=0.06 0.004: 0 -0.2 0, 1 0.2 0.1"}, "raindrops", "the first object left out"},
    {"EightBitsOfMetres", "puddle-corrected", {"puddle.storage=rgba8"}, "wave_step", "crater 2 s for 4 s"},
    {"Schlick", "puddle-corrected", {"puddle.fresnel=schlick", "puddle.fog_depth=0", "puddle.use_checkerboard=true"}, "shade"},
    {"EightBitTarget", "edge_splash-as-published", {"edge_splash.storage=rgba8"}, "splash", "wrong constant"},
    {"DisplayOfEightBits", "edge_splash-as-published", {"edge_splash.storage=rgba8", "display.exposure=2"}, "display", "wrong constant"},
    {"Misprint", "screen_drops-as-published", {"drops.printed_misprint=true"}, "drops", "threshold 0.3"},
    {"NearestNoise", "screen_drops-as-published", {"noise.filter=nearest"}, "drops", "threshold 0.3"},
    {"OtherConstants",
     "screen_drops-as-published",
     {"drops.layers=6", "drops.cell_angle=5.5", "drops.noise_middle=0.4", "drops.displacement=-1.5", "drops.keep_from=6.5",
      "drops.threshold=0.75"},
     "drops",
     "threshold 0.3"},
    {"PrintedNormal", "screen_drops-as-published", {"drops.printed_normal=true"}, "drops", "threshold 0.3"},
    {"FixedLevel", "screen_drops-as-published", {"drops.lod=fixed", "drops.level=1.5", "scene.wrap=mirror"}, "drops", "finest level"},
    {"GradientLevel", "screen_drops-as-published", {"drops.lod=gradient", "scene.wrap=repeat"}, "drops", "finest level"},
    {"GradientOfThePrintedNormal",
     "screen_drops-as-published",
     {"drops.lod=gradient", "drops.printed_normal=true", "drops.refraction=0.6", "scene.wrap=mirror"},
     "drops",
     "finest level"},
    {"WrappedBackground", "screen_drops-as-published", {"scene.wrap=repeat", "background.level=2"}, "background", "level 3.5"},
    {"DryWindow", "screen_drops-corrected", {"flow.on=false"}, "drops", "wrong constant"},
    {"Probe", "rainy_glass-as-published", {"glass.background=probe", "glass.probe_image=" + sun}, "rain_on_glass"},
    {"Shipped", "rainy_glass-shipped", {}, "rain_on_glass", "wrong constant"},
    {"CorrectedProbe", "rainy_glass-corrected", {"glass.background=probe", "glass.probe_image=" + sun}, "rain_on_glass"},
    {"Ball", "rainy_glass-corrected", {"glass.shape=sphere"}, "rain_on_glass", "wrong constant"},
    {"Quartic", "windshield-as-published", {"windshield.kernel=quartic", "windshield.blend=max"}, "splat"},
    {"Smoothstep", "windshield-as-published", {"windshield.kernel=smoothstep", "windshield.accumulate=float"}, "splat"},
    {"Hemisphere", "windshield-corrected", {"windshield.kernel=hemisphere", "windshield.blend=max"}, "splat"},
    {"Disc", "windshield-as-published", {"windshield.kernel=disc"}, "splat"},
    {"Behind",
     "windshield-corrected",
     {"falling_rain.on=true", "falling_rain.gain=30", "falling_rain.far=3", "scene.size=[38, 22]"},  // there the order of a sum shows
     "falling_rain",
     "wrong constant"},
    {"Mist", "windshield-corrected", {"condensation.on=true", "condensation.tau=0.5"}, "condense", "wrong constant"},
    {"ThroughMist", "windshield-corrected", {"condensation.on=true", "condensation.blur_lod=1.3"}, "mist", "wrong constant"},
    {"Lean", "windshield-corrected", {"windshield.lean=1"}, "splat", "wrong constant"},
    {"OutlinesThatStay", "windshield-neck", {}, "necks", "no time"},
    {"Neck", "windshield-neck", {}, "splat", "wrong constant"},
    {"UprightNeck", "windshield-neck", {"windshield.lean=0", "windshield.kernel=hemisphere"}, "splat", "wrong constant"},
    {"Smear", "windshield-corrected", {"smear.on=true", "smear.drying=2"}, "smear", "wrong constant"},
    {"ThroughSmear", "windshield-corrected", {"smear.on=true", "smear.spread=9"}, "soften", "wrong constant"},
    {"Inside", "windshield-corrected", {"interior.on=true"}, "interior", "wrong constant"},
    {"Trails", "windshield-as-published", {"windshield.height_tau=0.3"}, "persist", "wrong constant"},
    {"Panes", "windshield-corrected", {"windshield.panes=1.7 0.6 0.9, 1.7 0.1 0.9, 1.6 0.6 1.6"}, "join_panes", "wrong constant"},
};

class PrintedBranches : public testing::TestWithParam<Branch> {
 protected:
  /// The packs of all branches that are asked for, in folders of their names: copies of a process that has read a picture need not load
  /// OpenImageIO, and copies are made before the judge starts threads.
  static void SetUpTestSuite() {
    static_cast<void>(image_io::read(ground));
    made = std::make_unique<TemporaryFolder>();
    put(*made / "faces.png", faces());
    const testing::TestSuite& suite = *testing::UnitTest::GetInstance()->current_test_suite();
    for (int i = 0; i < suite.total_test_count(); ++i) {
      const testing::TestInfo& test = *suite.GetTestInfo(i);
      const std::string name = test.name();
      for (const Branch& b : branches)
        if (test.should_run() && name.ends_with("/" + b.name)) packed[b.name] = pack(b);
    }
  }
  static void TearDownTestSuite() { made.reset(); }

  static Outcome pack(const Branch& b) {
    // One frame: a formula takes the same way in each.
    std::vector<std::string> arguments{"pack", rainref::test::pack_scene(b.pack).string(), "--at", "12", "-o", b.name};
    for (const std::string& setting : b.settings) arguments.insert(arguments.end(), {"--set", setting});
    Circumstances c;
    c.is_copy = true;
    return run_rainref(made->path(), arguments, c);
  }

  static inline std::unique_ptr<TemporaryFolder> made;
  static inline std::map<std::string, Outcome> packed;
};

TEST_P(PrintedBranches, AreJudgedRight) {
  const Branch& b = GetParam();
  const Outcome& o = packed.at(b.name);
  ASSERT_EQ(o.code, 0) << o.err;
  const Pack pack(*made / b.name);
  // Under ieee alone: the reference's own bits pass under every profile.
  expect_pass(judged(pack, without_mistake, "ieee"), pack.effect + "-" + pack.variant);
  const PortJudgement wrong = judged(pack, [&](const Written&) { return b.mistake; }, "vulkan", {b.pass});
  EXPECT_EQ(pass_of(wrong, b.pass).status, Status::fail) << b.pass << ": " << b.mistake;
}

INSTANTIATE_TEST_SUITE_P(Settings, PrintedBranches, testing::ValuesIn(branches), [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace rainref::documents
