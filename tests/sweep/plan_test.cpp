// What a plan may say, and what is said of one that may not.
#include "sweep/plans.h"

namespace rainref::sweep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

using PlanText = Plans;

TEST_F(PlanText, IsTheProductOfItsAxesTheLastFastest) {
  const OpenedPlan p(plan("verb = 'run'\nscene = 'a.toml'\nframes = 2\n[axes]\n'rain.rate' = [1, 2.5]\nseed = {from = 3, count = 3}\n"));
  std::vector<std::string> words;
  for (const Cell& cell : p.cells.all()) words.push_back(p.cells.words(cell));
  EXPECT_THAT(words, ElementsAre("scene a.toml, rain.rate 1, seed 3", "scene a.toml, rain.rate 1, seed 4",
                                 "scene a.toml, rain.rate 1, seed 5", "scene a.toml, rain.rate 2.5, seed 3",
                                 "scene a.toml, rain.rate 2.5, seed 4", "scene a.toml, rain.rate 2.5, seed 5"));
  const scene::Config config = p.cells.config(p.cells.all()[4]);
  EXPECT_EQ(config.real("rain.rate"), 2.5);
  EXPECT_EQ(config.integer("seed"), 4);
  EXPECT_EQ(config.integer("run.frames"), 2);
}

TEST_F(PlanText, TakesCasesSeveralScenesAndTables) {
  put(folder / "b.toml", scene("puddle", "as-published"));
  put(folder / "cases.csv", "# pairs\r\nname,rain.rate, seed\r\n\"dry, clean\",0,7\r\n\r\nwet,9,8\r\n");
  const OpenedPlan p(plan("verb='run'\nscene=['a.toml']\nsize='31x17'\n[set.puddle]\ndamping = 0.97\n[axes]\ncases = 'cases.csv'\n"));
  ASSERT_EQ(p.cells.all().size(), 2u);
  EXPECT_EQ(p.cells.words(p.cells.all()[0]), "scene a.toml, name dry, clean, rain.rate 0, seed 7");
  const scene::Config config = p.cells.config(p.cells.all()[1]);
  EXPECT_EQ(config.real("rain.rate"), 9);
  EXPECT_EQ(config.real("puddle.damping"), 0.97);
  EXPECT_EQ(config.integer2("run.size"), (scene::Integer2{31, 17}));
  EXPECT_EQ(ids("verb='hash'\nscene=['a.toml', 'b.toml']\n[axes]\nseed=[1, 2]\n").size(), 4u);
}

TEST_F(PlanText, IsRefusedInOneSentence) {
  const std::string head = "verb = 'run'\nscene = 'a.toml'\n";
  EXPECT_EQ(refusal("verb = 'rnu'\n"),
            "2 plan.toml:1:8: verb: expected one of run, hash, pack, validate, mutate, found 'rnu'; did you mean 'run'?");
  EXPECT_EQ(refusal("scene = 'a.toml'\n"), "2 plan.toml: verb: missing; expected one of run, hash, pack, validate, mutate");
  EXPECT_EQ(refusal(head + "frmes = 3\n"), "2 plan.toml:3:1: frmes: unknown key of a plan; did you mean 'frames'?");
  EXPECT_EQ(refusal(head + "frames = 0\n"), "2 plan.toml:3:10: frames: expected a whole number from 1 to 1000000, found 0");
  EXPECT_EQ(refusal(head + "frames = '9..3'\n"),
            "2 plan.toml:3:10: frames: expected a number of frames from 1 to 1000000, or \"FIRST..LAST\", found \"9..3\"");
  EXPECT_EQ(refusal(head + "size = '640'\n"), "2 plan.toml:3:8: size: expected WxH such as \"640x360\", found \"640\"");
  EXPECT_EQ(refusal(head + "exec = 'x'\n"), "2 plan.toml:3:1: exec: not used by verb 'run', only by 'validate'");
  EXPECT_EQ(refusal(head + "keep = ['pictures']\n"),
            "2 plan.toml:3:9: keep: expected 'picture', 'exr', 'exr:CHANNEL', 'buffer:NAME', 'drops' or 'hash', with '@every=K' or "
            "'@all' behind it, found 'pictures'; did you mean 'picture'?");
  for (const std::string bad :
       {"picture@every=0", "picture@", "picture@each", "buffer:", "buffer", "picture:x", "hash@all", "exr@every=1x", "exr:", "drops:x"})
    EXPECT_THAT(refusal(head + "keep = ['" + bad + "']\n"), StartsWith("2 plan.toml:3:9: keep: expected")) << bad;
  EXPECT_THAT(refusal(head + "keep = ['buffer:wav']\n"),
              StartsWith("2 plan.toml:3:9: keep: expected a buffer of puddle corrected, one of "));
  EXPECT_THAT(refusal(head + "keep = ['buffer:wav']\n"), HasSubstr("found 'wav'; did you mean 'wave'?"));
  EXPECT_EQ(refusal(head + "[axes]\n'rain.rate' = 3\n"),
            "2 plan.toml:4:15: axes.rain.rate: expected a list, or from, to and count, found 3");
  EXPECT_EQ(refusal(head + "[axes]\n'rain.rate' = []\n"), "2 plan.toml:4:15: axes.rain.rate: expected a value or more, found []");
  EXPECT_EQ(refusal(head + "[axes]\nseed = {from = 1}\n"), "2 plan.toml:4:9: axes.seed: expected 'count' beside 'from', found none");
  EXPECT_EQ(refusal(head + "[axes]\nseed = {from = 1, count = 0}\n"),
            "2 plan.toml:4:27: axes.seed.count: expected a whole number from 1 to 1000000, found 0");
  EXPECT_EQ(refusal(head + "[axes]\nseed = {from = 1, to = 'x', count = 2}\n"),
            "2 plan.toml:4:24: axes.seed.to: expected a number, found \"x\"");
  EXPECT_EQ(refusal(head + "[axes]\nseed = {from = 1, to = 1e999, count = 2}\n").substr(0, 13), "2 plan.toml:4");
  EXPECT_EQ(refusal(head + "[axes]\nseed = [1, 2]\n'seed' = [3]\n").substr(0, 13), "2 plan.toml:5");
  EXPECT_EQ(refusal(head + "[set]\nseed = 3\n[axes]\nseed = [1]\n"), "2 plan.toml:4:1: seed: is an axis too");
  EXPECT_EQ(refusal("verb = 'validate'\npack = 'p'\n"),
            "2 plan.toml: exec: missing; expected a port's command, or port, the folder of its outputs");
  EXPECT_EQ(refusal("verb = 'mutate'\n"), "2 plan.toml: pack: missing; expected the folder of a pack, or a list of them");
  EXPECT_THAT(refusal("verb = 'mutate'\npack = 'p'\nprofile = 'vlukan'\n"), HasSubstr("plan.toml:3:11: profile: expected one of "));
  EXPECT_THAT(refusal("verb = 'mutate'\npack = 'p'\n"), StartsWith("4 plan.toml:2:8: pack: expected the folder of a pack, found no "));
  EXPECT_THAT(refusal("verb = 'run'\nscene = 'b.toml'\n"), StartsWith("4 plan.toml:2:9: scene: b.toml: cannot be read: "));
  EXPECT_EQ(refusal(head + "frames = '3..4'\n[set]\nrun.frames = 2\n"),
            "2 plan.toml: frames: expected a first frame before run.frames 2, found 3");
}

// Numbers that no integer holds were 0.
TEST_F(PlanText, NumbersThatAreTooLargeAreRefused) {
  const std::string head = "verb = 'run'\nscene = 'a.toml'\n";
  for (const std::string bad : {"0..99999999999999999999", "99999999999999999999..3", "3..", "..3", "0..1000000", "-1..3", "1..2..3"})
    EXPECT_EQ(refusal(head + "frames = '" + bad + "'\n"),
              "2 plan.toml:3:10: frames: expected a number of frames from 1 to 1000000, or \"FIRST..LAST\", found \"" + bad + "\"");
  for (const std::string bad : {"99999999999999999999x3", "3x99999999999999999999", "3x", "x3", "0x3"})
    EXPECT_THAT(refusal(head + "size = '" + bad + "'\n"), StartsWith("2 plan.toml:3:8: size: expected WxH")) << bad;
  EXPECT_THAT(refusal(head + "keep = ['exr@every=99999999999999999999']\n"), StartsWith("2 plan.toml:3:9: keep: expected"));
}

// Its tables would lie in the folder of all tables.
TEST_F(PlanText, ANameThatIsNoFolderIsRefused) {
  put(folder / "...toml", "verb = 'run'\nscene = 'a.toml'\n");
  EXPECT_THAT(error_of([&] { OpenedPlan{folder / "...toml"}; }),
              HasSubstr("expected a file whose name without .toml is that of a folder, found '..'"));
}

// A cell that differs from the one before in one key is what it is by itself.
TEST_F(PlanText, ACellDoesNotHangOnTheOneBefore) {
  put(folder / "one.npy", contents(tiny_picture()));
  std::string other = contents(tiny_picture());
  other.back() ^= 1;
  put(folder / "two.npy", other);
  put(folder / "b.toml", scene("windshield", "corrected"));
  const std::string head = "verb='hash'\nscene='a.toml'\nframes=2\n";
  const std::vector<std::string> rates{"0.0", "30", "2.5"}, pictures{"one.npy", "two.npy"}, fps{"60", "30"};
  const auto all = ids(head + "[axes]\n'rain.rate'=[0.0, 30, 2.5]\n'environment.image'=['one.npy','two.npy']\n'run.fps'=[60, 30]\n");
  std::size_t at = 0;
  for (const std::string& rate : rates)
    for (const std::string& picture : pictures)
      for (const std::string& f : fps)
        EXPECT_EQ(ids(head + "[set]\n'rain.rate'=" + rate + "\n'environment.image'='" + picture + "'\n'run.fps'=" + f + "\n").at(0),
                  all.at(at++));
  EXPECT_EQ(at, all.size());
  // Effects and variants have keys of their own.
  const auto variants = ids("verb='hash'\nscene=['b.toml', 'a.toml']\n[set]\nrun.frames=2\n[axes]\nseed=[1, 2]\n");
  EXPECT_EQ(ids("verb='hash'\nscene='a.toml'\nframes=2\n[set]\nseed=2\n").at(0), variants.at(3));
  EXPECT_EQ(ids("verb='hash'\nscene='b.toml'\nframes=2\n[set]\nseed=2\n").at(0), variants.at(1));
  // A zero with a sign is zero.
  EXPECT_THAT(refusal("verb='hash'\nscene='b.toml'\n[axes]\n'world.wind'=[[0.0, 0.0, 0.0], [-0.0, 0.0, 0.0]]\n"),
              HasSubstr("two cells are the same"));
}

// What a scene refuses is said of the plan's line, before anything starts.
TEST_F(PlanText, EveryCellIsChecked) {
  const std::string head = "verb = 'run'\nscene = 'a.toml'\n";
  EXPECT_EQ(refusal(head + "[axes]\n'rain.rate' = [1, 2,\n  -3]\n"),
            "2 plan.toml:5:3: rain.rate: expected a number from 0 to 200 [mm/h], found -3");
  EXPECT_EQ(refusal(head + "[axes]\n'rain.rat' = [1]\n"), "2 plan.toml:4:15: rain.rat: unknown key; did you mean 'rain.rate'?");
  EXPECT_EQ(refusal(head + "[set]\n'puddle.shape' = 'basni'\n"),
            "2 plan.toml:4:18: puddle.shape: expected one of 'natural', 'basin', found \"basni\"; did you mean 'basin'?");
  put(folder / "cases.csv", "rain.rate,seed\n1,2\nx,3\n");
  EXPECT_EQ(refusal(head + "[axes]\ncases = 'cases.csv'\n"),
            "2 cases.csv:3: rain.rate: expected a number from 0 to 200 [mm/h], found \"x\"");
  put(folder / "cases.csv", "rain.rate,seed\n1\n");
  EXPECT_EQ(refusal(head + "[axes]\ncases = 'cases.csv'\n"), "2 cases.csv:2: expected 2 fields as the head has, found 1");
  put(folder / "cases.csv", "rain.rate,rain.rate\n");
  EXPECT_EQ(refusal(head + "[axes]\ncases = 'cases.csv'\n"), "2 cases.csv:1: rain.rate: is there twice");
  put(folder / "cases.csv", "");
  EXPECT_EQ(refusal(head + "[axes]\ncases = 'cases.csv'\n"), "2 cases.csv: expected a head and at least one case, found none");
  EXPECT_THAT(refusal(head + "[axes]\ncases = 'none.csv'\n"), StartsWith("4 "));
  EXPECT_EQ(refusal(head + "[axes]\n'rain.rate' = [1, 1.0]\n"),
            "2 plan.toml: two cells are the same: scene a.toml, rain.rate 1; and scene a.toml, rain.rate 1.0");
  EXPECT_THAT(refusal(head + "[axes]\nseed = {from = 1, count = 1000000}\n'rain.rate' = {from = 1, to = 2, count = 1000000}\n"),
              HasSubstr("plan.toml:5:16: axes: expected at most 1000000 cells, found 1000000000000"));
  put(folder / "cases.csv", "rain.rate\n1\n2\n3\n");
  EXPECT_THAT(refusal(head + "[axes]\nseed = {from = 1, count = 400000}\ncases = 'cases.csv'\n"),
              HasSubstr("cases.csv:4: expected at most 2 cases, for a plan has at most 1000000 cells, found more"));
  EXPECT_THAT(refusal(head + "[set]\n'environment.image' = 'none.png'\n"), StartsWith("4 plan.toml:4:1: environment.image: cannot read "));
}

}  // namespace
}  // namespace rainref::sweep
