// `rainref sweep` as a user runs it: what it prints and leaves, whoever is killed.
#include <map>

#include <nlohmann/json.hpp>

#include "cli/running.h"
#include "image_io/read.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

class Sweep : public CommandLine {
 protected:
  Sweep() {
    put(folder / "plan.toml",
        "verb = 'run'\nscene = 'published.toml'\nframes = 3\nkeep = ['picture', 'hash']\n[axes]\nseed = {from = 1, count = 8}\n");
    before = folder.names();
  }
  Outcome sweep(const std::vector<std::string>& arguments) const { return rainref(joined(joined({"sweep"}, arguments), {"-o", "out"})); }
  /// Every file of cells and tables, timings aside.
  std::map<std::string, std::string> results(const std::string& out) const {
    std::map<std::string, std::string> all;
    for (const char* part : {"cells", "plans"}) {
      for (const auto& entry : fs::recursive_directory_iterator(folder / (out + "/" + part)))
        if (entry.is_regular_file() && entry.path().filename() != "timings.csv")
          all[fs::relative(entry.path(), folder / out).string()] = contents(entry.path());
    }
    return all;
  }
  std::size_t cells(const std::string& out) const {
    std::size_t count = 0;
    std::error_code error;
    for (fs::recursive_directory_iterator i(folder / (out + "/cells"), error), end; !error && i != end; i.increment(error))
      count += i->path().filename() == "cell.json";
    return count;
  }
};

TEST_F(Sweep, FromPlanToTable) {
  EXPECT_EQ(sweep({"plan", "plan.toml"}).out,
            "8 cells of run: 8 missing\nbytes and time are unknown until a cell is made: --trial makes the first\n");
  EXPECT_EQ(folder.names(), before);
  const Outcome listed = sweep({"plan", "plan.toml", "--list"});
  EXPECT_THAT(lines_of(listed.out).at(7), MatchesRegex("7 [0-9a-f]{32} scene published.toml, seed 8"));
  EXPECT_THAT(sweep({"plan", "plan.toml", "--trial"}).out, HasSubstr("8 cells of run: 1 done, 7 missing\nby the 1 made so far: "));
  expect(sweep({"status", "plan.toml"}), 1, "8 cells: 1 done, 7 missing\n");
  expect(sweep({"run", "plan.toml", "--shard", "1/2"}), 0, MatchesRegex("shard 1/2: 4 cells, 4 made in .*\n"));
  EXPECT_THAT(sweep({"run", "plan.toml"}).out, MatchesRegex("shard 0/1: 8 cells, 5 had, 3 made in .*\n"));
  expect(sweep({"status", "plan.toml"}), 0, "8 cells: 8 done\n");
  expect(sweep({"collect", "plan.toml"}), 0,
         AllOf(StartsWith("8 cells: 8 done; table.csv, "), HasSubstr("sheet.png in "), EndsWith("out/plans/plan\n")));
  EXPECT_EQ(lines_of(contents(folder / "out/plans/plan/table.csv")).size(), 9u);
  EXPECT_EQ(lines_of(contents(folder / "out/plans/plan/timings.csv")).size(), 9u);
  // What rainref hash says of the fourth cell.
  const std::vector<std::string> hashed = hash({"published.toml", "--frames", "3", "--set", "seed=4"});
  EXPECT_THAT(lines_of(contents(folder / "out/plans/plan/films.csv")).at(4), EndsWith(",0,3," + hashed.back().substr(6)));
  EXPECT_THAT(sweep({"gc", "plan.toml"}).out, StartsWith("0 things"));
}

// The picture of a cell is that of `rainref run`.
TEST_F(Sweep, ACellIsARun) {
  ASSERT_EQ(sweep({"run", "plan.toml"}).code, 0);
  const std::string id = lines_of(sweep({"plan", "plan.toml", "--list"}).out).at(2).substr(2, 32);
  ASSERT_EQ(rainref({"run", "published.toml", "--frames", "3", "--set", "seed=3", "-o", "one"}).code, 0);
  const fs::path cell = folder / "out/cells" / id.substr(0, 2) / id;
  EXPECT_EQ(contents(cell / "picture.000002.png"), contents(folder / "one/puddle.0002.png"));
  const auto record = nlohmann::json::parse(contents(cell / "cell.json")),
             summary = nlohmann::json::parse(contents(folder / "one/summary.json"));
  EXPECT_EQ(record["last_frame"], summary["last_frame"]);
  EXPECT_EQ(record["golden_hash"], summary["golden_hash"]);
}

TEST_F(Sweep, OtherPlansFindWhatIsThere) {
  ASSERT_EQ(sweep({"run", "plan.toml"}).code, 0);
  put(folder / "more.toml", "verb='run'\nscene='published.toml'\nkeep=['hash','picture']\n[set]\nrun.frames=3\n[axes]\nseed=[9, 2, 5]\n");
  EXPECT_THAT(sweep({"run", "more.toml"}).out, MatchesRegex("shard 0/1: 3 cells, 2 had, 1 made in .*\n"));
  const Outcome o = sweep({"gc", "more.toml"});
  EXPECT_THAT(o.out, HasSubstr("6 things"));
  EXPECT_EQ(cells("out"), 9u);
  EXPECT_THAT(sweep({"gc", "more.toml", "plan.toml"}).out, StartsWith("0 things"));
  EXPECT_THAT(sweep({"gc", "more.toml", "--remove"}).out, HasSubstr("6 things"));
  EXPECT_EQ(cells("out"), 3u);
  EXPECT_EQ(sweep({"status", "more.toml"}).code, 0);
}

TEST_F(Sweep, ADamagedCellIsFoundAndMadeAgain) {
  ASSERT_EQ(sweep({"run", "plan.toml"}).code, 0);
  ASSERT_EQ(sweep({"collect", "plan.toml"}).code, 0);
  const auto whole = results("out");
  const auto picture =
      std::find_if(whole.begin(), whole.end(), [](const auto& f) { return f.first.ends_with(".png") && f.first.starts_with("cells"); });
  put(folder / "out" / picture->first, picture->second.substr(1));
  expect(sweep({"collect", "plan.toml"}), 1, AllOf(StartsWith("damaged: "), HasSubstr(picture->first), HasSubstr("7 done, 1 damaged")));
  EXPECT_THAT(sweep({"gc", "plan.toml", "--damaged", "--remove"}).out, StartsWith("1 thing, "));
  EXPECT_THAT(sweep({"run", "plan.toml"}).out, HasSubstr("7 had, 1 made"));
  EXPECT_EQ(sweep({"collect", "plan.toml"}).code, 0);
  EXPECT_EQ(results("out"), whole);
}

// What a killed collect leaves, the next one takes away.
TEST_F(Sweep, CollectCleansItsOwnLeftovers) {
  ASSERT_EQ(sweep({"run", "plan.toml"}).code, 0);
  ASSERT_EQ(sweep({"collect", "plan.toml"}).code, 0);
  const fs::path left = folder / "out/plans/plan/.rainref-0123456789abcdef.tmp", mine = folder / "out/plans/plan/.rainref-mine.tmp";
  put(left, "x");
  put(mine, "x");
  ASSERT_EQ(sweep({"collect", "plan.toml"}).code, 0);
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(mine));
}

// Killed at any moment, by whichever signal, in worker and waiting process alike: what goes on comes to the same bytes.
TEST_F(Sweep, AnyKillLeavesWhatGoesOn) {
  ASSERT_EQ(rainref({"sweep", "run", "plan.toml", "-o", "whole"}).code, 0);
  ASSERT_EQ(rainref({"sweep", "collect", "plan.toml", "-o", "whole"}).code, 0);
  for (int round = 0; round < 6; ++round) {
    const auto running = start_rainref(folder.path(), {"sweep", "run", "plan.toml", "-o", "parts"});
    std::this_thread::sleep_for(std::chrono::milliseconds(60 + 90 * round));
    running->end(round % 2 == 0 ? SIGKILL : SIGTERM);
  }
  // The workers of killed processes end of their own; those that are left alone are waited for by the lock of their cells.
  expect(rainref({"sweep", "run", "plan.toml", "-o", "parts", "--again"}), 0);
  ASSERT_EQ(rainref({"sweep", "collect", "plan.toml", "-o", "parts"}).code, 0);
  EXPECT_EQ(results("parts"), results("whole"));
}

TEST_F(Sweep, ProcessesThatRaceLeaveOneWholeResult) {
  ASSERT_EQ(rainref({"sweep", "run", "plan.toml", "-o", "whole"}).code, 0);
  std::vector<std::unique_ptr<ChildProcess>> racers;
  for (int k = 0; k < 3; ++k) racers.push_back(start_rainref(folder.path(), {"sweep", "run", "plan.toml", "-o", "raced"}));
  for (const auto& racer : racers) EXPECT_EQ(racer->wait(), 0);
  for (const char* out : {"whole", "raced"}) ASSERT_EQ(rainref({"sweep", "collect", "plan.toml", "-o", out}).code, 0);
  EXPECT_EQ(results("raced"), results("whole"));
}

// Refused when its pictures are opened, which planning does not do.
TEST_F(Sweep, ARefusedCellIsToldAndTheOthersAreMade) {
  put(folder / "plan.toml",
      "verb='run'\nscene='published.toml'\nframes=1\n[axes]\n'environment.image'=['sky.png','strip.png']\n'environment.layout'=['cube']\n");
  std::vector<std::string> rows(2);
  for (std::string& row : rows) row = std::string(3 * 12, 'x');
  put(folder / "strip.png", image_io::png(12, 2, 8, 2, rows));
  expect(sweep({"run", "plan.toml"}), 1,
         AllOf(HasSubstr("refused: scene published.toml, environment.image sky.png, environment.layout cube: "),
               HasSubstr("a cube needs six square faces"), HasSubstr("1 made, 1 refused")));
  EXPECT_THAT(sweep({"run", "plan.toml"}).out, HasSubstr("1 had, 1 refused"));
  EXPECT_EQ(sweep({"status", "plan.toml"}).code, 1);
  EXPECT_THAT(sweep({"status", "plan.toml"}).out, StartsWith("2 cells: 1 done, 1 refused\nrefused: "));
  EXPECT_EQ(sweep({"collect", "plan.toml"}).code, 1);
  EXPECT_THAT(contents(folder / "out/plans/plan/table.csv"), HasSubstr(",refused,"));
}

TEST_F(Sweep, AFullDiskLosesNothing) {
  Circumstances full;
  full.file_bytes = 300;  // no picture fits
  const Outcome o = rainref({"sweep", "run", "plan.toml", "-o", "out"}, full);
  EXPECT_TRUE(o.code == 1 || o.code == 4) << o.code << o.err;
  EXPECT_EQ(cells("out"), 0u);
  EXPECT_THAT(sweep({"run", "plan.toml"}).out, HasSubstr("8 made"));
}

TEST_F(Sweep, PacksAreMadeAndJudged) {
  put(folder / "packs.toml", "verb='pack'\nscene='corrected.toml'\nat=[0, 1]\npasses=['display']\n[axes]\nseed=[1, 2]\n");
  Outcome o = sweep({"run", "packs.toml"});
  ASSERT_EQ(o.code, 0) << o.out << o.err;
  const std::string id = lines_of(sweep({"plan", "packs.toml", "--list"}).out).at(0).substr(2, 32);
  const std::string pack = "out/cells/" + id.substr(0, 2) + "/" + id + "/pack";
  ASSERT_EQ(rainref({"pack", "corrected.toml", "--set", "seed=1", "--at", "0,1", "--passes", "display", "-o", "direct"}).code, 0);
  EXPECT_EQ(contents(folder / (pack + "/manifest.json")), contents(folder / "direct/manifest.json"));
  // A port that copies what is expected passes, one of zeros does not.
  put(folder / "judged.toml",
      fmt::format("verb='validate'\npack='{}'\nprofile=['ieee','vulkan']\nexec='cp -r {{pack}}/. {{out}}'\nlabel='copy'\n", pack));
  expect(sweep({"run", "judged.toml"}), 0);
  EXPECT_EQ(sweep({"collect", "judged.toml"}).code, 0);
  EXPECT_THAT(contents(folder / "out/plans/judged/table.csv"),
              AllOf(HasSubstr(",done,"), HasSubstr("/pack,ieee"), HasSubstr("/pack,vulkan")));
  // The port breaks: what was judged is another port's.
  put(folder / "port.sh", "cp -r \"$1\"/. \"$2\"\n");
  put(folder / "changing.toml",
      fmt::format("verb='validate'\npack='{}'\nexec='sh {} {{pack}} {{out}}'\n", pack, (folder / "port.sh").string()));
  EXPECT_THAT(sweep({"plan", "changing.toml"}).out, HasSubstr("exec: the content of " + (folder / "port.sh").string() + " counts; "));
  EXPECT_EQ(sweep({"run", "changing.toml"}).code, 0);
  EXPECT_EQ(sweep({"collect", "changing.toml"}).code, 0);
  put(folder / "port.sh", "exit 3\n");
  EXPECT_EQ(sweep({"collect", "changing.toml"}).code, 1);
  EXPECT_THAT(sweep({"run", "changing.toml"}).out, HasSubstr("1 made"));
  ASSERT_EQ(sweep({"collect", "changing.toml"}).code, 0);
  EXPECT_THAT(contents(folder / "out/plans/changing/table.csv"), HasSubstr(",done,fail,"));
  // What it calls itself nobody sees; --again judges anew.
  put(folder / "inner.sh", "exit 3\n");
  put(folder / "port.sh", fmt::format("sh \"$(dirname \"$0\")/inner.sh\" \"$@\"\n"));
  EXPECT_THAT(sweep({"run", "changing.toml"}).out, HasSubstr("1 made"));
  put(folder / "inner.sh", "cp -r \"$1\"/. \"$2\"\n");
  EXPECT_THAT(sweep({"run", "changing.toml"}).out, HasSubstr("1 had"));
  EXPECT_THAT(sweep({"run", "changing.toml", "--again"}).out, HasSubstr("1 made"));
  ASSERT_EQ(sweep({"collect", "changing.toml"}).code, 0);
  EXPECT_THAT(contents(folder / "out/plans/changing/table.csv"), HasSubstr(",done,pass,"));
  put(folder / "mutate.toml", fmt::format("verb='mutate'\npack='{}'\n", pack));
  expect(sweep({"run", "mutate.toml"}), 0, HasSubstr("1 made"));
}

// An ffmpeg that keeps what it is given: the pictures of all chunks, in order.
TEST_F(Sweep, AFilmIsMadeOfAllPicturesInOrder) {
  put(folder / "plan.toml", "verb='run'\nscene='published.toml'\nframes=7\nchunk=3\nkeep=['picture@all']\n");
  ASSERT_EQ(sweep({"run", "plan.toml"}).code, 0);
  ASSERT_EQ(rainref({"run", "published.toml", "--frames", "7", "--every", "1", "-o", "one"}).code, 0);
  fs::create_directory(folder / "bin");
  put(folder / "bin/ffmpeg", "#!/bin/sh\nprintf '%s\\n' \"$@\" >asked\nfor last; do :; done\ncat >\"${last#file:}\"\n");
  fs::permissions(folder / "bin/ffmpeg", fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", ((folder / "bin").string() + ":" + path).c_str(), 1);
  const Outcome o = sweep({"collect", "plan.toml", "--film"});
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(o.code, 0);
  EXPECT_THAT(o.out, HasSubstr(", film.mp4 of 7 pictures in "));
  std::string all;
  for (int frame = 0; frame < 7; ++frame) {
    const Image image = image_io::read(folder / fmt::format("one/puddle.{:04}.png", frame)).image;
    for (int i = 0; i < image.width() * image.height(); ++i)
      all.append(reinterpret_cast<const char*>(image.row_bytes(i / image.width())) + 4 * (i % image.width()), 3);
  }
  EXPECT_TRUE(contents(folder / "out/plans/plan/film.mp4") == all);
  EXPECT_THAT(contents(folder / "asked"), HasSubstr("\n60/1\n"));
}

// What is kept of a run may be each K-th frame: the film is as slow as the scene. Without ffmpeg the tables are whole all the same.
TEST_F(Sweep, AFilmOfSomeFramesKeepsTheScenesSpeed) {
  put(folder / "plan.toml", "verb='run'\nscene='published.toml'\nframes=7\nkeep=['picture@every=3']\n");
  ASSERT_EQ(sweep({"run", "plan.toml"}).code, 0);
  fs::create_directory(folder / "bin");
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (folder / "bin").c_str(), 1);
  expect(sweep({"collect", "plan.toml", "--film"}), 0, HasSubstr("film.mp4': ffmpeg, which makes films, is in no folder of PATH"));
  EXPECT_FALSE(fs::exists(folder / "out/plans/plan/film.mp4"));
  put(folder / "bin/ffmpeg", "#!/bin/sh\nprintf '%s\\n' \"$@\" >asked\ncat >/dev/null\n");
  fs::permissions(folder / "bin/ffmpeg", fs::perms::owner_all);
  ::setenv("PATH", ((folder / "bin").string() + ":" + path).c_str(), 1);
  Outcome o = sweep({"collect", "plan.toml", "--film"});
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(o.out, HasSubstr(", film.mp4 of 3 pictures in "));
  EXPECT_THAT(contents(folder / "asked"), HasSubstr("\n60/3\n"));
}

// A data set: made of a plan's whole result alone, never over another one, and said in figures.
TEST_F(Sweep, ADataSetIsMadeOnce) {
  put(folder / "cases.csv", "name,rain.rate\nclean,0\nrainy,80\n");
  put(folder / "plan.toml",
      "verb = 'run'\nscene = 'corrected.toml'\nframes = 20\n[axes]\nseed = {from = 1, count = 4}\ncases = 'cases.csv'\n");
  const std::vector<std::string> collect{"collect", "plan.toml", "--pairs", "clean,rainy", "--split", "0.5"};
  ASSERT_EQ(sweep({"run", "plan.toml", "--shard", "0/2"}).code, 0);
  expect(sweep(collect), 1, HasSubstr("4 done, 4 missing; "));
  EXPECT_FALSE(fs::exists(folder / "out/plans/plan/pairs"));
  ASSERT_EQ(sweep({"run", "plan.toml"}).code, 0);
  const Outcome made = sweep(collect);
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, AllOf(HasSubstr("4 pairs: "), HasSubstr("\nPSNR of rainy against clean [dB]: mean "), Not(HasSubstr("mask"))));
  EXPECT_EQ(lines_of(contents(folder / "out/plans/plan/pairs/table.csv")).size(), 5u);
  const std::string first = lines_of(contents(folder / "out/plans/plan/table.csv")).at(1);
  EXPECT_THAT(first, MatchesRegex("0,([0-9a-f]+),done,.*,cells/[0-9a-f][0-9a-f]/[0-9a-f]+,picture.000019.png"));
  // It stays as it is.
  put(folder / "out/plans/plan/pairs/mine.txt", "mine");
  const auto whole = results("out");
  expect(sweep(collect), 4, "",
         HasSubstr("out/plans/plan/pairs': the folder is not empty, and a data set replaces none: --to names another"));
  EXPECT_EQ(results("out"), whole);
  EXPECT_EQ(sweep(joined(collect, {"--to", "other"})).code, 0);
  EXPECT_EQ(contents(folder / "other/table.csv"), contents(folder / "out/plans/plan/pairs/table.csv"));
  // A pair of its own label, numbers and options.
  const auto refused = [&](const std::vector<std::string>& more, const std::string& words) {
    expect(sweep(joined({"collect", "plan.toml"}, more)), 2, "", HasSubstr(words));
  };
  refused({"--pairs", "clean"}, "--pairs: expected two labels such as clean,rainy, found 'clean'");
  refused({"--pairs", "clean,rainny"}, "found 'rainny'; did you mean 'rainy'?");
  refused({"--pairs", "clean,rainy", "--split", "1.5"}, "--split: expected a number from 0 to 1, found '1.5'");
  refused({"--pairs", "clean,rainy", "--mask", "drops.A"}, "--mask: expected 'exr:drops.A' in keep of plan.toml, found none");
  refused({"--split", "0.5"}, "--split: needs --pairs");
  EXPECT_EQ(results("out"), whole);
}

TEST_F(Sweep, ScriptsAndShards) {
  EXPECT_THAT(sweep({"script", "plan.toml", "--engine", "slurm", "--shards", "4"}).out,
              AllOf(HasSubstr("--array=0-3"), HasSubstr(RAINREF_PROGRAM)));
  expect_refusal({"sweep", "script", "plan.toml", "--engine", "slrum"}, 2,
                 "--engine: expected one of slurm, parallel, sge, kubernetes, found 'slrum'; did you mean 'slurm'?");
}

TEST_F(Sweep, SlipsAreNamed) {
  expect_refusal({"sweep"}, 2, HasSubstr("required"));
  expect_refusal({"sweep", "rnu", "plan.toml"}, 2,
                 "expected one of plan, run, status, collect, gc, script, found 'rnu'; did you mean 'run'?");
  expect_refusal({"sweep", "plan", "plan.toml", "--lst"}, 2, "--lst: unknown option of 'plan'; did you mean '--list'?");
  expect_refusal({"sweep", "plan", "none.toml"}, 4, HasSubstr("none.toml: cannot be read"));
  put(folder / "bad.toml", "verb='run'\nscene='published.toml'\n[axes]\n'puddle.dampng'=[1]\n");
  before = folder.names();
  expect_refusal({"sweep", "plan", "bad.toml"}, 2, "bad.toml:4:18: puddle.dampng: unknown key; did you mean 'puddle.damping'?");
  for (const char* action : {"plan", "run", "status", "collect", "gc", "script"})
    EXPECT_THAT(rainref({"help", "sweep", action}).out, HasSubstr("Example: rainref sweep ")) << action;
}

}  // namespace
}  // namespace rainref::cli
