// What a scene may say of the drops.
#include <gtest/gtest.h>

#include "base/error_of.h"
#include "config_of.h"
#include "drops/settings.h"
#include "rainref/error.h"

namespace rainref::drops {
namespace {

const std::vector<std::string> variants{"as-published", "corrected"};

Settings settings(const std::string& prefix, const std::string& variant, const std::vector<std::string>& values) {
  return settings_from(rainref::test::config_of(prefix, parameters(prefix), variant, "seed = 5\n", values), prefix);
}
std::string refusal(const std::string& variant, const std::vector<std::string>& values) {
  return error_of([&] { settings("windshield", variant, values); });
}

TEST(DropsParameters, AreSoundForTwoEffects) {
  for (const std::string prefix : {"windshield", "screen_drops"}) {
    scene::validate(parameters(prefix), variants);
    EXPECT_EQ(settings(prefix, "corrected", {prefix + ".capacity=77", "rain.rate=12"}).capacity, 77);
    EXPECT_EQ(settings(prefix, "corrected", {}).seed, 5u);
    EXPECT_EQ(settings(prefix, "as-published", {}).lifetime, 6);
  }
}

TEST(DropsParameters, OfAStillGlassAreCorrectedsWithoutTheWindAlongIt) {
  const std::vector<scene::Parameter> all = still_parameters("pane");
  scene::validate(all, variants);
  for (const scene::Parameter& p : all) {
    EXPECT_FALSE(p.used_by("as-published")) << p.key;
    EXPECT_EQ(p.key.find("wind"), std::string::npos) << p.key;
  }
  const Settings s = still_settings_from(rainref::test::config_of("pane", all, "corrected", "", {"pane.mobility=0.5"}), "pane"), d;
  EXPECT_EQ(s.lifetime, d.lifetime);  // that of corrected
  EXPECT_EQ(s.mobility, 0.5);
  EXPECT_EQ(s.wind_drag, 0);
  EXPECT_EQ(s.wind_exposure, 0);
}

TEST(DropsParameters, RefuseWhatContradictsItself) {
  EXPECT_EQ(refusal("corrected", {"windshield.receding_angle=60"}),
            "2 windshield.receding_angle is 60 degrees: expected at most windshield.advancing_angle = 50");
  EXPECT_EQ(refusal("as-published", {"windshield.mass_min=2"}), "2 windshield.mass_min is 2: expected at most windshield.mass_max = 1.6");
  EXPECT_EQ(refusal("as-published", {"windshield.drag=120"}),
            "2 windshield.drag is 120: expected less than 120, twice run.fps; the published step is unstable beyond");
  EXPECT_EQ(refusal("as-published", {"windshield.drag=119"}), "none");
  EXPECT_EQ(refusal("as-published", {"windshield.humidity=0.5"})[0], '2');  // corrected only
}

}  // namespace
}  // namespace rainref::drops
