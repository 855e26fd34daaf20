// Runs that are interrupted, killed, or two in one folder.
#include "cli/running.h"
#include "shipped_packs.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<std::string> endless{"run",     "published.toml", "-o",        "new/o",  "--frames", "1000000",
                                       "--image", "none",           "--capture", "passes", "--every",  "1"};

class Interrupted : public CommandLine {
 protected:
  /// A run that has begun to write its capture.
  std::unique_ptr<ChildProcess> start_endless() const {
    auto running = start_rainref(folder.path(), endless);
    await([&] {
      for (const std::string& name : names("new/o")) {
        if (name.ends_with(".tmp") && fs::exists(folder / ("new/o/" + name + "/puddle.shade/0000.0"))) return true;
      }
      return false;
    });
    return running;
  }
};

TEST_F(Interrupted, ARunLeavesNothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const auto running = start_endless();
    EXPECT_THAT(names("new/o"), Contains(".rainref-run.lock"));
    EXPECT_EQ(running->end(signal), -signal);
    EXPECT_EQ(folder.names(), before);
  }
}

TEST_F(Interrupted, APackLeavesNothing) {
  const auto running = start_rainref(folder.path(), {"pack", "published.toml", "-o", "p", "--at", "0,1000000"});
  await([&] { return folder.names().size() > before.size(); });
  EXPECT_EQ(running->end(SIGTERM), -SIGTERM);
  EXPECT_EQ(folder.names(), before);
}

TEST_F(Interrupted, WhatAKilledRunLeftGoesWithTheNext) {
  EXPECT_EQ(start_endless()->end(SIGKILL), -SIGKILL);
  EXPECT_EQ(names("new/o").size(), 2u);  // the lock and the hidden folder
  expect(rainref({"run", "published.toml", "-o", "new/o", "--image", "none"}), 0);
  EXPECT_THAT(names("new/o"), ElementsAre("summary.json"));
}

TEST_F(Interrupted, ASecondRunIntoOneFolderIsRefused) {
  const auto running = start_endless();
  const auto in_the_way = names("new/o");
  expect(rainref({"run", "published.toml", "-o", "new/o", "--image", "none"}), 4, testing::_,
         "rainref: new/o: another run writes to this folder\n");
  EXPECT_EQ(names("new/o"), in_the_way);
  EXPECT_EQ(rainref({"run", "published.toml", "-o", "new/other", "--image", "none"}).code, 0);
  EXPECT_EQ(running->end(SIGTERM), -SIGTERM);
  EXPECT_EQ(rainref({"run", "published.toml", "-o", "new/o", "--image", "none"}).code, 0);
}

TEST_F(Interrupted, AKilledRunShowsNoOlderSummary) {
  fs::create_directory(folder / "o");
  put(folder / "o/summary.json", "of an older run");
  const auto running = start_rainref(folder.path(), {"run", "published.toml", "-o", "o", "--frames", "1000000", "--every", "1"});
  await([&] { return fs::exists(folder / "o/puddle.0000.png"); });
  EXPECT_FALSE(fs::exists(folder / "o/summary.json"));
  EXPECT_EQ(running->end(SIGKILL), -SIGKILL);
  EXPECT_FALSE(fs::exists(folder / "o/summary.json"));
}

TEST_F(Interrupted, ARefusedRunKeepsTheOlderSummary) {
  fs::create_directory(folder / "o");
  put(folder / "o/summary.json", "of an older run");
  before = folder.names();
  expect_refusal({"run", "published.toml", "-o", "o", "--set", "environment.image=none.png"}, 4, HasSubstr("none.png"));
  EXPECT_EQ(contents(folder / "o/summary.json"), "of an older run");
}

TEST_F(Interrupted, APortsCommandEndsWithAllItStarted) {
  const std::string pack = rainref::test::pack_folder("puddle-corrected");
  const auto running = start_rainref(
      folder.path(), {"validate", pack, "--exec",
                      "echo {out} > where; setsid sh -c 'echo $$ > daemon; sleep 600' & echo $$ > shell; sleep 600", "--html", "r.html"});
  const auto number = [&](const std::string& file) { return std::atoi(contents(folder / file).c_str()); };
  await([&] { return number("daemon") > 0 && number("shell") > 0; });
  EXPECT_TRUE(is_running(number("daemon")) && is_running(number("shell")));
  std::string where = contents(folder / "where");
  where.pop_back();
  EXPECT_TRUE(fs::is_directory(where));
  EXPECT_EQ(running->end(SIGINT), -SIGINT);
  EXPECT_FALSE(is_running(number("daemon")));
  EXPECT_FALSE(is_running(number("shell")));
  EXPECT_FALSE(fs::exists(where));
  for (const std::string name : {"where", "daemon", "shell"}) fs::remove(folder / name);
  EXPECT_EQ(folder.names(), before);
}

// As with `| head`: rainref dies of the pipe as others do, but not before it has cleaned up.
TEST_F(Interrupted, AReaderThatGoesAwayIsNoError) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ::close(ends[0]);
  EXPECT_EQ(start_rainref(folder.path(), {"run", "published.toml", "-o", "o", "--image", "none", "--json"}, ends[1])->wait(), -SIGPIPE);
  ::close(ends[1]);
  EXPECT_THAT(names("o"), ElementsAre("summary.json"));
}

TEST_F(Interrupted, LinksStayAndWhatTheyNameIsWritten) {
  fs::create_directory(folder / "real");
  fs::create_directory_symlink("real", folder / "link");
  fs::create_directory_symlink("real/run", folder / "run");
  fs::create_directory_symlink("real/pack", folder / "pack");
  expect(rainref({"run", "published.toml", "-o", "run", "--image", "none"}), 0);
  EXPECT_EQ(rainref({"run", "published.toml", "-o", "link", "--image", "none"}).code, 0);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(rainref({"pack", "published.toml", "-o", "pack", "--at", "0", "--passes", "display"}).code, 0);
  for (const std::string name : {"link", "run", "pack"}) EXPECT_TRUE(fs::is_symlink(folder / name)) << name;
  EXPECT_THAT(names("real"), ElementsAre("pack", "run", "summary.json"));
  EXPECT_TRUE(fs::exists(folder / "real/run/summary.json"));
  EXPECT_TRUE(fs::exists(folder / "real/pack/manifest.json"));
  // A link in the middle that leads nowhere is in the way, and stays too.
  fs::create_directory_symlink("nowhere", folder / "dangling");
  before = folder.names();
  expect_refusal({"run", "published.toml", "-o", "dangling/sub"}, 4, HasSubstr("cannot make this folder"));
  expect_refusal({"pack", "published.toml", "-o", "dangling/sub"}, 4, HasSubstr("cannot write 'dangling/sub'"));
  EXPECT_TRUE(fs::is_symlink(folder / "dangling"));
}

}  // namespace
}  // namespace rainref::cli
