// A cell's name says what its result depends on, and nothing else.
#include "sweep/plans.h"

#include <set>

#include "simulation/opened.h"
#include "sweep/command_files.h"

namespace rainref::sweep {
namespace {

using testing::Not;
using Identity = Plans;

TEST_F(Identity, DoesNotDependOnHowThePlanSaysIt) {
  const auto before = ids("verb='run'\nscene='a.toml'\nframes=2\nkeep=['hash','picture']\n[axes]\nseed=[1,2]\n");
  std::filesystem::create_directories(folder / "deep");
  std::filesystem::copy(folder / "a.toml", folder / "deep/other.toml");
  const auto after =
      ids("verb='run'\nscene='other.toml'\nkeep=['picture','hash','picture']\n[set]\nrun.frames=2\n[axes]\nseed={from=1,count=2}\n",
          "deep/x.toml");
  EXPECT_EQ(before, after);
  EXPECT_EQ(ids("verb='hash'\nscene='a.toml'\nframes=2\n"), ids("verb='run'\nscene='a.toml'\nframes=2\nkeep=['hash']\n"));
}

TEST_F(Identity, DependsOnAllThatCounts) {
  const std::string base = "verb='run'\nscene='a.toml'\nframes=4\n";
  std::set<std::string> all;
  for (const std::string more : {"", "keep=['hash']\n", "keep=['picture@all']\n", "keep=['exr']\n", "keep=['buffer:wave']\n",
                                 "size='31x17'\n", "[set]\nseed=9\n", "[set]\nrain.rate=9\n"})
    EXPECT_TRUE(all.insert(ids(base + more).at(0)).second) << more;
  EXPECT_TRUE(all.insert(ids("verb='run'\nscene='a.toml'\nframes=5\n").at(0)).second);
  EXPECT_TRUE(all.insert(ids("verb='run'\nscene='a.toml'\nframes='1..3'\n").at(0)).second);
  EXPECT_TRUE(all.insert(ids("verb='pack'\nscene='a.toml'\nframes=4\n").at(0)).second);
  EXPECT_TRUE(all.insert(ids("verb='pack'\nscene='a.toml'\nframes=4\nat=[1]\n").at(0)).second);
}

// Chunks of a longer film are those of a shorter one, but for the end, whose last frame is kept.
TEST_F(Identity, ChunksAreSharedByFilmsOfOtherLengths) {
  const auto shorter = ids("verb='run'\nscene='a.toml'\nframes=9\nchunk=3\nkeep=['picture@every=2','hash']\n");
  const auto longer = ids("verb='run'\nscene='a.toml'\nframes=12\nchunk=3\nkeep=['picture@every=2','hash']\n");
  ASSERT_EQ(shorter.size(), 3u);
  ASSERT_EQ(longer.size(), 4u);
  EXPECT_TRUE(std::equal(shorter.begin(), shorter.end(), longer.begin()));
  const auto last = ids("verb='run'\nscene='a.toml'\nframes=9\nchunk=3\n"),
             other_last = ids("verb='run'\nscene='a.toml'\nframes=12\nchunk=3\n");
  EXPECT_EQ(last[1], other_last[1]);
  EXPECT_NE(last[2], other_last[2]);
}

TEST_F(Identity, OfAFileCountsWhatItHolds) {
  const std::string named = "verb='run'\nscene='a.toml'\n[set]\n'environment.image'='";
  std::string picture = contents(tiny_picture());
  put(folder / "one.npy", picture);
  put(folder / "same.npy", picture);
  const auto one = ids(named + "one.npy'\n");
  EXPECT_EQ(ids(named + "same.npy'\n"), one);
  picture.back() ^= 1;
  put(folder / "other.npy", picture);
  EXPECT_NE(ids(named + "other.npy'\n"), one);
}

// No ffmpeg is asked: what a film shows depends on its bytes alone.
TEST_F(Identity, OfAFilmCountItsBytes) {
  put(folder / "window.toml", "effect = 'screen_drops'\nvariant = 'corrected'\n");
  for (const auto& [name, bytes] : {std::pair{"one.mp4", "a film"}, {"same.mp4", "a film"}, {"other.mp4", "a FILM"}})
    put(folder / name, bytes);
  const std::string named = "verb='run'\nscene='window.toml'\n[set]\n'scene.image'='";
  const auto one = ids(named + "one.mp4'\n");
  EXPECT_EQ(ids(named + "same.mp4'\n"), one);
  EXPECT_NE(ids(named + "other.mp4'\n"), one);
}

// A repaired port's verdict is not that of the broken one.
TEST_F(Identity, OfAPortsCommandCountsWhatTheFilesThatItNamesHold) {
  std::filesystem::create_directories(folder / "pack");
  put(folder / "pack/manifest.json", "{}");
  const std::string port = (folder / "port.sh").string(), shader = (folder / "a shader.glsl").string();
  for (const std::string& exec : std::vector<std::string>{port + " {pack} {out}", "cd . && '" + port + "' {pack}",
                                                          "sh -c \"" + port + " {pack}\"", "env PORT=" + port + " x", "x <" + port}) {
    const std::string text = "verb='validate'\npack='pack'\nexec='''" + exec + "'''\n";
    put(port, "one");
    const auto one = ids(text);
    EXPECT_EQ(ids(text), one) << exec;
    put(port, "two");
    EXPECT_NE(ids(text), one) << exec;
    put(port, "one");
    EXPECT_EQ(ids(text), one) << exec;
  }
  put(port, "#!/bin/sh\n");
  put(shader, "a");
  const std::string both = "cat x | " + port + " --shader='" + shader + "' && " + port;
  EXPECT_THAT(files_named_by(both), testing::ElementsAre(port, shader));
  EXPECT_THAT(files_named_by("cp -r {pack}/. {out}"), testing::IsEmpty()) << "a program of the machine";
  std::filesystem::create_directories(folder / "bin");
  put(folder / "bin/port_in_path", "x");
  std::filesystem::permissions(folder / "bin/port_in_path", std::filesystem::perms::owner_all);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", ((folder / "bin").string() + ":" + path).c_str(), 1);
  EXPECT_THAT(files_named_by("port_in_path {pack}"), testing::ElementsAre(folder / "bin/port_in_path"));
  ::setenv("PATH", path.c_str(), 1);
}

TEST_F(Identity, EveryTextThatNamesAFileIsKnownAsOne) {
  std::set<std::string> others;
  for (const scene::Effect& e : simulation::effect_table().effects)
    for (const scene::Parameter& p : e.parameters)
      if (p.type == scene::Type::text && !effect::names_files(p.key)) others.insert(p.key);
  EXPECT_THAT(others, testing::UnorderedElementsAre(
                          "compositor.embree_config", "windshield.panes", "world.wind_key_frames", "rain.key_frames", "vehicle.key_frames",
                          "wipers.key_frames", "pane_1_wipers.key_frames", "pane_2_wipers.key_frames", "puddle.objects", "rain.shelter"));
}

}  // namespace
}  // namespace rainref::sweep
