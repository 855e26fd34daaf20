// What becomes of a shard's cells: made once, refused once, tried again so often; and nothing of it is lost to a kill.
#include "sweep/plans.h"

#include <map>

#include "base/child_process.h"
#include "sweep/cell_record.h"
#include "sweep/rubbish.h"
#include "sweep/table.h"

namespace rainref::sweep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Work : public Plans {
 protected:
  Work() : opened(plan("verb='run'\nscene='a.toml'\nframes=1\ntries=3\n[axes]\nseed={from=0,count=6}\n")) {}

  /// Makes cells of one file, as `act` wants it.
  Counts go(const std::function<void(int seed)>& act, WorkOptions options = {}) {
    return work(
        opened.cells, store, options,
        [&](const Cell& cell, Names& names) {
          const int seed = static_cast<int>(cell.rows[0]);
          calls.push_back(seed);
          act(seed);
          CellWriter writer(store.cell(cell.id));
          writer.write("a.txt", std::to_string(seed));
          Made made;
          made.was_first = writer.finish({{"cell", cell.id}}, names);
          return made;
        },
        [&](const Cell& cell, Outcome o, const std::string& s) {
          told[static_cast<int>(cell.rows[0])] = std::string(name(o)) + (s.empty() ? "" : ": " + s);
        });
  }
  const Cell& cell(int seed) const { return opened.cells.all()[static_cast<std::size_t>(seed)]; }

  OpenedPlan opened;
  std::vector<int> calls;
  std::map<int, std::string> told;
};

TEST_F(Work, TakesItsShardAndNothingTwice) {
  const Counts half = go([](int) {}, {{1, 2}, false});
  EXPECT_THAT(calls, ElementsAre(3, 4, 5));
  EXPECT_EQ(half[Outcome::made], 3);
  calls.clear();
  const Counts all = go([](int) {});
  EXPECT_THAT(calls, ElementsAre(0, 1, 2));
  EXPECT_EQ(all[Outcome::had], 3);
  EXPECT_EQ(all[Outcome::made], 3);
  EXPECT_TRUE(all.is_whole());
}

TEST_F(Work, ARefusedCellIsRecordedAndNeverTriedAgain) {
  const auto refuse = [](int seed) {
    if (seed == 2) throw Error(ExitCode::usage, "no such thing");
  };
  for (int round = 0; round < 2; ++round) {
    const Counts counts = go(refuse);
    EXPECT_EQ(counts[Outcome::refused], 1);
    EXPECT_FALSE(counts.is_whole());
    EXPECT_EQ(told[2], "refused: no such thing");
  }
  EXPECT_EQ(std::count(calls.begin(), calls.end(), 2), 1);
  EXPECT_EQ(store.failure(cell(2).id)->code, 2);
  EXPECT_TRUE(go([](int) {}, {{}, true}).is_whole());  // --again
  EXPECT_FALSE(store.failure(cell(2).id));
}

TEST_F(Work, OtherFailuresAreTriedAsOftenAsThePlanSays) {
  int failures = 0;
  const auto fail_twice = [&](int seed) {
    if (seed == 1 && failures++ < 2) throw Error(ExitCode::io, "the disk is full");
  };
  EXPECT_TRUE(go(fail_twice).is_whole());
  EXPECT_EQ(std::count(calls.begin(), calls.end(), 1), 3);
}

TEST_F(Work, AFailureIsRecordedAndTheNextRunTriesAgain) {
  const auto fail = [&](int seed) {
    if (seed == 1) throw Error(ExitCode::io, "the disk is full");
    if (seed == 4) throw std::runtime_error("a defect");
  };
  EXPECT_EQ(go(fail)[Outcome::failed], 2);
  EXPECT_EQ(std::count(calls.begin(), calls.end(), 1), 3);
  EXPECT_EQ(told[4], "failed: a defect");
  std::string sentence;
  EXPECT_EQ(state_of(cell(1), store, sentence), State::failed);
  EXPECT_EQ(sentence, "the disk is full");
  EXPECT_TRUE(go([](int) {}).is_whole());
  EXPECT_EQ(state_of(cell(1), store, sentence), State::done);
  EXPECT_FALSE(store.failure(cell(1).id));
}

TEST_F(Work, ACellThatKillsItsProcessIsGivenUp) {
  store.make();
  for (int death = 0; death < 4; ++death) {
    ChildProcess child([&] {
      go([](int seed) {
        if (seed == 3) ::raise(SIGKILL);
      });
      return 0;
    });
    EXPECT_EQ(child.wait(), death < 3 ? -SIGKILL : 0) << death;
  }
  EXPECT_EQ(store.failure(cell(3).id)->sentence, "3 processes died while they made this cell");
  std::string sentence;
  for (const int seed : {0, 1, 2, 4, 5}) EXPECT_EQ(state_of(cell(seed), store, sentence), State::done);
  EXPECT_TRUE(go([](int) {}, {{}, true}).is_whole());
  EXPECT_EQ(store.tries(cell(3).id).dead, 0);
}

// Another process may be first at any moment, also before this one has begun to write.
TEST_F(Work, WhatAnotherMadeMeanwhileIsNoFailure) {
  const Counts counts = go([&](int seed) {
    Names names;
    CellWriter(store.cell(cell(seed).id)).finish({{"cell", "of another"}}, names);
  });
  EXPECT_EQ(counts[Outcome::lost], 6);
  EXPECT_EQ(calls.size(), 6u);
}

// One that is being made is no death.
TEST_F(Work, WhoLivesHasNotDied) {
  store.make();
  const auto being_made = store.begin(cell(0).id);
  EXPECT_EQ(store.tries(cell(0).id).dead, 0);
  EXPECT_EQ(store.tries(cell(0).id).alive, 1);
  EXPECT_TRUE(rubbish_of(store, {}, false).empty());
  // Nor is there haste to make it here too.
  go([](int) {});
  EXPECT_THAT(calls, ElementsAre(1, 2, 3, 4, 5, 0));
}

TEST_F(Work, OfProcessesThatRaceOneGetsTheNameAndTheResultIsWhole) {
  store.make();
  for (int round = 0; round < 8; ++round) {
    const Cell& raced = cell(round % 6);
    const Signpost is_ready[4], go_on[4];
    std::vector<std::unique_ptr<ChildProcess>> racers;
    for (int k = 0; k < 4; ++k)
      racers.push_back(std::make_unique<ChildProcess>([&] {
        CellWriter writer(store.cell(raced.id));
        for (int i = 0; i < 20; ++i) writer.write("f" + std::to_string(i), std::string(1000, static_cast<char>('a' + i)));
        is_ready[k].reach();
        go_on[k].await();
        Names names;
        return writer.finish({{"cell", raced.id}}, names) ? 1 : 0;
      }));
    for (const Signpost& s : is_ready) s.await();
    for (const Signpost& s : go_on) s.reach();
    int winners = 0;
    for (const auto& racer : racers) {
      const int code = racer->wait();
      EXPECT_TRUE(code == 0 || code == 1) << code;
      winners += code == 1;
    }
    EXPECT_EQ(winners, 1);
    EXPECT_EQ(damage_of(store.cell(raced.id)), "");
    EXPECT_EQ(read_record(store.cell(raced.id)).files.size(), 20u);
    // Nothing hidden stays.
    for (const auto& entry : std::filesystem::directory_iterator(store.cell(raced.id).parent_path()))
      EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path();
    std::filesystem::remove_all(store.cell(raced.id));
  }
}

TEST_F(Work, AKillAtAnyMomentLeavesWholeCellsOrNone) {
  for (int round = 0; round < 12; ++round) {
    ChildProcess child([&] {
      go([](int) {});
      return 0;
    });
    ::usleep(static_cast<useconds_t>(1500 * round));
    child.end(SIGKILL);
    for (const Cell& c : opened.cells.all()) {
      if (std::filesystem::exists(store.cell(c.id))) {
        EXPECT_EQ(damage_of(store.cell(c.id)), "");
      }
    }
    if (round % 3 == 2) std::filesystem::remove_all(store.root());
  }
  WorkOptions again;
  again.again = true;  // deaths of before count, and are not what this is about
  EXPECT_TRUE(go([](int) {}, again).is_whole());
}

TEST_F(Work, AStoreThatCannotBeWrittenEndsIt) {
  put(folder / "out", "a file");
  EXPECT_THAT(error_of([&] { go([](int) {}); }), HasSubstr("4 "));
  EXPECT_TRUE(calls.empty());
}

TEST_F(Work, EveryChangedByteIsFound) {
  go([](int) {});
  const std::filesystem::path at = store.cell(cell(0).id);
  for (const char* file : {"a.txt", "cell.json"}) {
    const std::string whole = contents(at / file);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      std::string changed = whole;
      changed[i] ^= 4;
      put(at / file, changed);
      EXPECT_NE(damage_of(at), "") << file << " byte " << i;
    }
    put(at / file, whole.substr(0, whole.size() / 2));
    EXPECT_NE(damage_of(at), "");
    put(at / file, "");
    EXPECT_NE(damage_of(at), "");
    std::filesystem::remove(at / file);
    EXPECT_NE(damage_of(at), "");
    put(at / file, whole);
    EXPECT_EQ(damage_of(at), "");
  }
}

// What is not rainref's stays, whatever the folder is called.
TEST_F(Work, RubbishBearsANameOfRainrefsInAMarkedFolder) {
  const Store wrong(folder / "project");
  for (const char* mine : {"project/states", "project/cells/a", "precious/b"}) std::filesystem::create_directories(folder / mine);
  put(folder / "project/states/menu.lua", "mine");
  EXPECT_THAT(error_of([&] { rubbish_of(wrong, {}, false); }), HasSubstr("project: expected a folder that `rainref sweep run` marked"));
  EXPECT_TRUE(rubbish_of(Store(folder / "none"), {}, false).empty());

  go([](int) {});
  const std::string id(32, '7');
  put(folder / "precious/thesis.tex", "mine");
  const std::filesystem::path root = store.root();
  for (const std::string& foreign :
       std::vector<std::string>{"cells/zz/a", "cells/77/77", "cells/77/" + id + "0", "cells/78/" + id, "states/menu", "plans/" + id})
    std::filesystem::create_directories(root / foreign);
  for (const std::string& foreign :
       std::vector<std::string>{"states/" + id, "failed/notes.json", "failed/" + id, "tries/mine.txt", "tries/" + id + ".txt"})
    put(root / foreign, "mine");
  std::filesystem::create_directory_symlink(folder / "precious", root / "cells/zy");
  std::filesystem::create_directory_symlink(folder / "precious", root / "cells/77" / ("77" + std::string(30, 'a')));
  std::filesystem::create_directory_symlink(folder / "precious", root / "states" / std::string(32, 'b'));
  std::vector<Cells> plans{opened.cells};
  EXPECT_TRUE(rubbish_of(store, plans, true).empty());
  std::filesystem::create_directories(root / "cells/77" / id);
  const auto found = rubbish_of(store, plans, true);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].path, root / "cells/77" / id);
  // A store of an older version is marked by the next run.
  std::filesystem::remove(root / "rainref-store");
  EXPECT_THAT(error_of([&] { rubbish_of(store, plans, true); }),
              HasSubstr("the next `sweep run` into a folder of an older version marks it"));
  go([](int) {});
  EXPECT_EQ(rubbish_of(store, plans, true).size(), 1u);
}

TEST_F(Work, RubbishIsWhatNoPlanNeeds) {
  go([](int) {});
  store.record("0123456789abcdef0123456789abcdef", "x", {2, "y"});
  std::vector<Cells> plans;
  const OpenedPlan fewer(plan("verb='run'\nscene='a.toml'\nframes=1\n[axes]\nseed={from=0,count=4}\n", "fewer.toml"));
  plans.push_back(fewer.cells);
  std::vector<std::filesystem::path> expected{store.cell(cell(4).id), store.cell(cell(5).id),
                                              store.root() / "failed/0123456789abcdef0123456789abcdef.json"};
  const auto paths = [&](bool damaged) {
    std::vector<std::filesystem::path> found;
    for (const Rubbish& r : rubbish_of(store, plans, damaged)) found.push_back(r.path);
    return found;
  };
  EXPECT_THAT(paths(true), testing::UnorderedElementsAreArray(expected));
  put(store.cell(cell(0).id) / "a.txt", "7");
  EXPECT_THAT(paths(false), testing::UnorderedElementsAreArray(expected));
  expected.push_back(store.cell(cell(0).id));
  EXPECT_THAT(paths(true), testing::UnorderedElementsAreArray(expected));
}

}  // namespace
}  // namespace rainref::sweep
