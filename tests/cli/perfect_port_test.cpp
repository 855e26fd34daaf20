// A perfect port is green: the expected outputs of packs that a user would make, given back. scripts/full/perfect_ports has all scenes.
#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

#include "cli/support.h"
#include "source_folder.h"

namespace rainref::cli {
namespace {

/// Of a pass: elements without a useful bound by the profile, and by what known devices do either [%].
struct Shares {
  double vacuous = 0, unbounded = 0;
};
Shares shares(const nlohmann::json& pass) {
  double elements = 0, vacuous = 0, unbounded = 0;
  for (const nlohmann::json& c : pass["cases"])
    for (const nlohmann::json& o : c["outputs"]) {
      elements += o["elements"].get<double>() - o["free"].get<double>();
      vacuous += o["vacuous"].get<double>();
      unbounded += o["unbounded"].get<double>();
    }
  return elements > 0 ? Shares{100 * vacuous / elements, 100 * unbounded / elements} : Shares{};
}

class PerfectPort : public CommandLine {
 protected:
  /// Judged under each profile. `most`: of any pass.
  void expect_green(const std::string& scene, const std::map<std::string, Shares>& most, const std::vector<std::string>& frames = {}) {
    const Outcome packed =
        rainref(joined({"pack", rainref::test::source_folder() + "/scenes/" + scene, "--size", "96x54", "-o", "pack"}, frames));
    ASSERT_EQ(packed.code, 0) << packed.err;
    EXPECT_THAT(packed.out + packed.err, testing::Not(testing::HasSubstr("says nothing of"))) << "a port that does nothing passes";
    std::filesystem::copy(folder / "pack", folder / "port", std::filesystem::copy_options::recursive);
    std::filesystem::remove(folder / "port/manifest.json");
    for (const auto& [profile, limit] : most) {
      const Outcome o = rainref({"validate", "pack", "--port", "port", "--profile", profile, "--json", "judged.json"});
      EXPECT_EQ(o.code, 0) << scene << ' ' << profile << '\n' << o.out;
      const auto judged = nlohmann::json::parse(contents(folder / "judged.json"));
      Shares found;
      for (const nlohmann::json& pass : judged["passes"]) {
        for (const nlohmann::json& c : pass["cases"]) EXPECT_EQ(c["status"], "PASS") << profile << ' ' << c["id"];
        // rainref rounds halves to nearest, and d3d asks for truncation: nothing else may warn.
        const bool rounds = profile == "d3d" && pass["status"] == "WARN" &&
                            pass["reason"] == "stores to binary16 round to nearest, where the profile d3d asks for toward zero";
        EXPECT_TRUE(rounds || pass["status"] == "PASS") << profile << ' ' << pass["pass"] << ' ' << pass["reason"];
        found = {std::max(found.vacuous, shares(pass).vacuous), std::max(found.unbounded, shares(pass).unbounded)};
      }
      // Measured: tighter is welcome, and changes these.
      EXPECT_LE(found.vacuous, limit.vacuous) << scene << ' ' << profile;
      EXPECT_LE(found.unbounded, limit.unbounded) << scene << ' ' << profile;
    }
  }
};

TEST_F(PerfectPort, OfScreenDropsAsPublishedIsGreen) {
  // Few cells hold a drop, and WGSL promises nothing of the sines that place them: what known devices do tells a port that draws none.
  expect_green("screen_drops/as_published.toml",
               {{"vulkan", {0.46, 0.46}}, {"webgpu", {3.31, 0.46}}, {"d3d", {0.46, 0.46}}, {"cuda", {0.46, 0.46}}});
}
TEST_F(PerfectPort, OfEdgeSplashIsGreen) {
  expect_green("edge_splash/default.toml", {{"vulkan", {0, 0}}, {"webgpu", {0.19, 0}}, {"d3d", {0, 0}}, {"cuda", {0, 0}}});
}
// The README's own example. A loose and a tight profile and one frame here, as it takes longest; the script has the others.
TEST_F(PerfectPort, OfThePuddleIsGreen) {
  expect_green("puddle/default.toml", {{"vulkan", {1.74, 0.2}}, {"cuda", {0.19, 0.19}}}, {"--at", "12", "--set", "environment.width=256"});
}

}  // namespace
}  // namespace rainref::cli
