// The scene keys of the flowing layer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error_of.h"
#include "config_of.h"
#include "rainref/error.h"
#include "screen_drops/flow.h"
#include "screen_drops/flow_support.h"

namespace rainref::screen_drops {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::vector<std::string> variants{"as-published", "corrected"};

FlowSettings settings_of(const std::vector<std::string>& values, const std::string& variant = "corrected") {
  return flow_settings(rainref::test::config_of("screen_drops", flow_parameters(), variant, "seed = 5\n", values), {0.5, 0.25},
                       Rounding::rtz);
}
std::string refusal(const std::vector<std::string>& values, const std::string& variant = "corrected") {
  return error_of([&] { settings_of(values, variant); });
}

TEST(FlowDeclared, KeysAreSoundAndOfCorrectedAlone) {
  const std::vector<scene::Parameter> all = flow_parameters();
  scene::validate(all, variants);
  for (const scene::Parameter& p : all) EXPECT_FALSE(p.used_by("as-published")) << p.key;
  EXPECT_THAT(refusal({"flow.capacity=9"}, "as-published"), StartsWith("2 "));
}

TEST(FlowDeclared, DefaultsAreThoseOfTheSettings) {
  const FlowSettings s = settings_of({}), d;
  EXPECT_EQ(s.fps, d.fps);
  EXPECT_EQ(s.substeps, d.substeps);
  EXPECT_EQ(s.gravity, d.gravity);
  EXPECT_EQ(s.wind, d.wind);
  EXPECT_EQ(s.warm_up, d.warm_up);
  EXPECT_EQ(s.pane, (std::array{0.5, 0.25}));
  EXPECT_EQ(s.drops.seed, 5u);
  EXPECT_TRUE(s.drops.corrected);
  EXPECT_EQ(s.drops.lifetime, d.drops.lifetime);
  EXPECT_EQ(s.splat.rounding, Rounding::rtz);
  EXPECT_EQ(s.splat.width, 1024);
  EXPECT_EQ(s.splat.height, 576);
}

TEST(FlowDeclared, ScenesSetEveryKey) {
  const FlowSettings s =
      settings_of({"flow.capacity=77", "flow.substeps=4", "flow.warm_up=2.5", "rain.wind=7", "world.gravity=1.62",
                   "flow.height_size=[64, 32]", "flow.kernel=quartic", "flow.receding_angle=30", "rain.rate=44", "run.fps=30"});
  EXPECT_EQ(s.drops.capacity, 77);
  EXPECT_EQ(s.substeps, 4);
  EXPECT_EQ(s.warm_up, 2.5);
  EXPECT_EQ(s.wind, 7);
  EXPECT_EQ(s.gravity, 1.62);
  EXPECT_EQ(s.splat.width, 64);
  EXPECT_EQ(s.splat.height, 32);
  EXPECT_EQ(s.splat.kernel, drops::SplatKernel::quartic);
  EXPECT_EQ(s.drops.receding_deg, 30);
  EXPECT_EQ(s.drops.rain_rate, 44);
  EXPECT_EQ(s.fps, 30);
}

TEST(FlowDeclared, RefusesWhatCannotBe) {
  EXPECT_THAT(refusal({"rain.wind=-1"}), AllOf(StartsWith("2 "), HasSubstr("rain.wind")));
  EXPECT_THAT(refusal({"flow.substeps=0"}), AllOf(StartsWith("2 "), HasSubstr("flow.substeps")));
  EXPECT_THAT(refusal({"flow.wind_drag=1"}), AllOf(StartsWith("2 "), HasSubstr("flow.wind_drag")));  // nothing blows along the pane
  EXPECT_EQ(refusal({"flow.receding_angle=60"}), "2 flow.receding_angle is 60 degrees: expected at most flow.advancing_angle = 50");
}

}  // namespace
}  // namespace rainref::screen_drops
