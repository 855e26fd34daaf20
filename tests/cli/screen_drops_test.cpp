// screen_drops from the command line: both variants run, pack, hash and differ; scenes from files; what is refused.
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "capture/pack_read.h"
#include "cli/picture_files.h"
#include "image_io/read.h"
#include "math/simd_target.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

class ScreenDropsFiles : public SceneFiles {
 protected:
  ScreenDropsFiles() {
    put(folder / "drops.toml", text("corrected", "[drops]\nlargest_radius = 12\n[flow]\nwarm_up = 1\nheight_size = [24, 16]\n"));
    put(folder / "printed.toml", text("as-published", "[drops]\ngrid = 0.1\n[noise]\nsize = 16\n"));
    before = folder.names();
  }
  static std::string text(const std::string& variant, const std::string& rest) {
    return fmt::format("effect = 'screen_drops'\nvariant = '{}'\n[run]\nframes = 2\nsize = [{}, {}]\n[scene]\nimage = 'colour.png'\n{}",
                       variant, width, height, rest);
  }
  Outcome good(const std::vector<std::string>& arguments) const {
    Circumstances c;
    c.is_copy = true;
    const Outcome o = rainref(arguments, c);
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(o.err, "");
    return o;
  }
  static std::vector<std::string> buffers(const std::vector<std::string>& lines, int frame) {
    std::vector<std::string> out;
    for (const std::string& line : lines) {
      if (line.starts_with(fmt::format("{} ", frame))) out.push_back(line.substr(2, line.rfind(' ') - 2));
    }
    return out;
  }
};

TEST_F(ScreenDropsFiles, BothVariantsRunWithTheirPasses) {
  const auto printed = hash({"printed.toml"}), drops = hash({"drops.toml"});
  EXPECT_THAT(buffers(printed, 0), ElementsAre("background background", "drops water", "drops colour", "display picture"));
  EXPECT_THAT(buffers(printed, 1), ElementsAre("drops water", "drops colour", "display picture"));
  EXPECT_THAT(buffers(drops, 1), AllOf(Contains("cells cells"), Contains("drops colour"), Contains("integrate drops")));
  // Of water standing still there is no flow.
  const auto still = hash({"drops.toml", "--set", "flow.on=false"});
  EXPECT_THAT(buffers(still, 1), ElementsAre("cells cells", "drops water", "drops colour", "display picture"));
  EXPECT_NE(still.back(), drops.back());

  for (const char* scene : {"printed.toml", "drops.toml"}) {
    const auto lines = hash({scene});
    EXPECT_EQ(hash({scene, "--threads", "1", "--simd", simd_targets().back()}), lines);
    EXPECT_NE(hash({scene, "--set", "seed=2"}), lines);
    EXPECT_NE(hash({scene, "--set", "drops.rounding=rtz"}), lines);
  }
}

TEST_F(ScreenDropsFiles, RunWritesPicturesAndTheEffectiveConfiguration) {
  good({"run", "drops.toml", "-o", "out", "--image", "both", "--set", "drops.share=0.25"});
  const image_io::Picture png = image_io::read(folder / "out/screen_drops.0001.png"),
                          exr = image_io::read(folder / "out/screen_drops.0001.exr");
  EXPECT_EQ(png.image.width(), width);
  EXPECT_EQ(exr.image.height(), height);
  EXPECT_THAT(exr.channel_names, testing::IsSupersetOf({"R", "G", "B", "background.R"}));
  const auto summary = nlohmann::json::parse(contents(folder / "out/summary.json"));
  EXPECT_THAT(summary.dump(), AllOf(HasSubstr("\"drops.share\":0.25"), HasSubstr("colour.png")));
}

TEST_F(ScreenDropsFiles, PacksHoldEveryPassAndDiffFindsTheFirstDifference) {
  for (const std::string scene : {"printed.toml", "drops.toml"}) {
    good({"pack", scene, "--at", "0,1", "-o", "a"});
    good({"pack", scene, "--at", "0,1", "-o", "b"});
    good({"diff", "a", "b"});
    const capture::Pack pack(folder / "a");
    EXPECT_EQ(pack.effect, "screen_drops");
    for (const char* pass : {"background", "drops", "display"}) {
      const auto is_case = [&](const capture::PackCase& c) { return c.pass == pass; };
      EXPECT_TRUE(std::any_of(pack.cases.begin(), pack.cases.end(), is_case)) << scene << " " << pass;
    }
    // Another exposure changes display alone, another seed what comes before it.
    good({"pack", scene, "--at", "0,1", "-o", "c", "--set", "display.exposure=2"});
    expect(rainref({"diff", "a", "c"}), 1, HasSubstr("pass display"));
    good({"pack", scene, "--at", "0,1", "-o", "d", "--set", "seed=9"});
    expect(rainref({"diff", "a", "d"}), 1, AllOf(HasSubstr("frame 0"), testing::Not(HasSubstr("pass display"))));
    for (const char* name : {"a", "b", "c", "d"}) std::filesystem::remove_all(folder / name);
  }
}

TEST_F(ScreenDropsFiles, EveryKindOfFileIsTheSameScene) {
  expect_colours_alike("drops.toml");
  expect_colours_alike("printed.toml");
}

TEST_F(ScreenDropsFiles, APanoramaIsSeenThroughTheCamera) {
  // Brighter toward +x (u = 1/2) than toward -x.
  put_npy(folder / "round.npy", 32, 16, 3, [](int x, int, int) { return x >= 8 && x < 24 ? 4.0f : 0.25f; });
  const std::vector<std::string> look{
      "drops.toml", "--set", "scene.image=", "--set", "scene.panorama=round.npy", "--set", "camera.position=[0,0,0]"};
  const auto toward = [&](const char* target) {
    std::vector<std::string> all = look;
    all.insert(all.end(), {"--set", target});
    return hash(all);
  };
  EXPECT_NE(toward("camera.target=[1,0,0]"), toward("camera.target=[-1,0,0]"));
  expect_refused("drops.toml", {"scene.panorama=round.npy"}, HasSubstr("scene.panorama: expected no scene.image beside it"));
}

TEST_F(ScreenDropsFiles, NoiseThatDoesNotTileIsAWarning) {
  put_npy(
      folder / "ramp.npy", 32, 32, 4, [](int x, int, int) { return static_cast<float>(8 * x); }, true);
  put_npy(
      folder / "white.npy", 16, 16, 4, [](int x, int y, int c) { return static_cast<float>((x * 97 + y * 57 + c * 131) * 167 % 251); },
      true);
  const auto with = [&](const char* noise) { return rainref({"hash", "printed.toml", "--set", fmt::format("noise.image={}", noise)}); };
  const Outcome ramp = with("ramp.npy"), white = with("white.npy");
  EXPECT_EQ(ramp.code, 0);
  EXPECT_THAT(ramp.err,
              AllOf(HasSubstr("rainref: warning: noise.image: ramp.npy does not tile"), HasSubstr("times the one between its texels")));
  EXPECT_EQ(white.err, "");
  EXPECT_NE(white.out, ramp.out);
}

TEST_F(ScreenDropsFiles, WhatIsWrongIsNamed) {
  expect_refused("drops.toml", {"scene.image=small.npy"}, HasSubstr("scene.image: expected 24x16 like the picture, found 8x8"));
  expect_refused("drops.toml", {"scene.image=holed.npy"}, HasSubstr("scene.image: 'holed.npy': NaN at x 3, y 2 (from the top)"));
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  expect_refused("drops.toml", {"scene.image=pipe"}, HasSubstr("--set scene.image: cannot read 'pipe'"), 4);  // and does not wait
  expect_refused("drops.toml", {"glass.height=0"}, HasSubstr("glass.height"));
  expect_refused("drops.toml", {"drops.largest_radius=0"}, HasSubstr("drops.largest_radius"));
  expect_refused("drops.toml", {"drops.shortest_cycle=40"},
                 HasSubstr("drops.shortest_cycle: expected at most drops.longest_cycle = 30 s, found 40"));
  expect_refused("drops.toml", {"camera.target=[0,0,0]", "camera.position=[0,0,0]"}, HasSubstr("camera"));
  expect_refused("drops.toml", {"drops.shre=1"}, HasSubstr("drops.share"));
  expect_refused("drops.toml", {"drops.grid=0.1"}, HasSubstr("drops.grid"));      // as-published has it
  expect_refused("printed.toml", {"glass.height=1"}, HasSubstr("glass.height"));  // corrected has it
  expect_refused("printed.toml", {"drops.grid=0"}, HasSubstr("drops.grid"));
}

}  // namespace
}  // namespace rainref::cli
