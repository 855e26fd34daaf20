// What is written under a hidden name goes with its object or gets its name; what a killed process left is removed.
#include "base/hidden.h"

#include <thread>

#include <gmock/gmock.h>

#include "base/child_process.h"
#include "base/file_lock.h"
#include "base/signals.h"
#include "base/temporary_folder.h"

namespace rainref {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::MatchesRegex;

TEST(Hidden, GoesWithTheObjectUnlessItGotItsName) {
  const TemporaryFolder at;
  {
    const Hidden file(at.path(), Hidden::Kind::file), folder(at.path(), Hidden::Kind::folder);
    EXPECT_THAT(file.path().filename(), MatchesRegex("\\.rainref-[0-9a-f]{16}\\.tmp"));
    put(folder.path() / "inside", "x");
    EXPECT_EQ(at.names().size(), 2u);
  }
  EXPECT_THAT(at.names(), IsEmpty());
  {
    Hidden file(at.path(), Hidden::Kind::file), folder(at.path(), Hidden::Kind::folder);
    put(folder.path() / "inside", "x");
    file.become(at / "file");
    folder.become(at / "folder");
  }
  EXPECT_THAT(at.names(), ElementsAre("file", "folder"));
  EXPECT_EQ(contents(at / "folder/inside"), "x");
}

// As when two containers number their processes alike: whatever names they draw, no two share an entry.
TEST(Hidden, ANameThatIsTakenIsPassedOver) {
  for (const Hidden::Kind kind : {Hidden::Kind::file, Hidden::Kind::folder, Hidden::Kind::private_folder}) {
    const TemporaryFolder at;
    std::vector<std::string> names{"c", "b", "a", "a"};
    const auto draw = [&] {
      const std::string name = names.back();
      names.pop_back();
      return name;
    };
    put(at / "b", "mine");
    const Hidden first(at.path(), kind, draw), second(at.path(), kind, draw);
    EXPECT_EQ(first.path(), at / "a");
    EXPECT_EQ(second.path(), at / "c");
    EXPECT_EQ(contents(at / "b"), "mine");
  }
}

TEST(Hidden, ReplacesAFolderAndRemovesTheOld) {
  const TemporaryFolder at;
  fs::create_directory(at / "pack");
  put(at / "pack/old", "old");
  {
    Hidden folder(at.path(), Hidden::Kind::folder);
    put(folder.path() / "new", "new");
    folder.replace(at / "pack");
    EXPECT_EQ(contents(at / "pack/new"), "new");
  }
  EXPECT_THAT(at.names(), ElementsAre("pack"));
  EXPECT_FALSE(fs::exists(at / "pack/old"));
}

TEST(Hidden, GoesOnAnInterruption) {
  const TemporaryFolder at;
  const Signpost ready;
  ChildProcess child([&] {
    undo_when_interrupted();
    const Hidden file(at.path(), Hidden::Kind::file), folder(at.path(), Hidden::Kind::folder);
    put(folder.path() / "inside", "x");
    const FolderLock lock(at.path());
    ready.reach();
    return sleep_for_ever();
  });
  ready.await();
  EXPECT_EQ(at.names().size(), 3u);
  EXPECT_EQ(child.end(SIGINT), -SIGINT);
  EXPECT_THAT(at.names(), IsEmpty());
}

// The owner may be writing at that moment: with no path its files would come into the current folder.
TEST(Hidden, KeepsItsPathWhenAnInterruptionRemovesIt) {
  const TemporaryFolder at;
  ChildProcess child([&] {
    const Hidden folder(at.path(), Hidden::Kind::folder);
    const fs::path before = folder.path();
    std::thread(undo_all).join();
    ::_exit(folder.path() == before && !fs::exists(before) ? 0 : 1);  // the end of the object would wait for ever
    return 2;
  });
  EXPECT_EQ(child.wait(), 0);
}

// A killed process cannot clean up. What a living one writes is never taken for left over.
TEST(Leftovers, OfAKilledProcessAreRemoved) {
  const TemporaryFolder at;
  const Signpost ready;
  ChildProcess child([&] {
    const Hidden file(at.path(), Hidden::Kind::file), folder(at.path(), Hidden::Kind::folder);
    put(folder.path() / "inside", "x");
    ready.reach();
    return sleep_for_ever();
  });
  ready.await();
  remove_leftovers(at.path());
  EXPECT_EQ(at.names().size(), 2u);
  EXPECT_EQ(child.end(SIGKILL), -SIGKILL);
  EXPECT_EQ(at.names().size(), 2u);
  remove_leftovers(at.path());
  EXPECT_THAT(at.names(), IsEmpty());
}

TEST(Leftovers, NothingElseIsRemoved) {
  const TemporaryFolder at;
  const std::string hidden = ".rainref-0123456789abcdef.tmp";
  fs::create_directory(at / "elsewhere");
  put(at / "elsewhere/mine", "mine");
  const std::vector<std::string> names{".rainref-0123456789abcdef.tmp2",
                                       ".rainref-0123456789abcde.tmp",
                                       ".rainref-0123456789abcdeg.tmp",
                                       ".rainref-1-0.tmp",
                                       ".rainref-run.lock",
                                       "rainref-0123456789abcdef.tmp"};
  for (const std::string& name : names) put(at / name, "mine");
  fs::create_symlink("elsewhere", at / hidden);
  const auto before = at.names();
  remove_leftovers(at.path());
  remove_leftovers(at / "none");
  EXPECT_EQ(at.names(), before);
  EXPECT_EQ(contents(at / "elsewhere/mine"), "mine");
}

// Where no file system step exchanges two names, a killed process may have left the old folder under neither.
TEST(Leftovers, AFolderThatWasBeingReplacedIsPutBack) {
  const TemporaryFolder at;
  for (const std::string name : {"lost", "replaced"})
    fs::create_directories(at / (".rainref-0123456789abcde" + std::string(name == "lost" ? "0" : "1") + ".old") / name);
  put(at / ".rainref-0123456789abcde0.old/lost/file", "old");
  put(at / ".rainref-0123456789abcde1.old/replaced/file", "old");
  fs::create_directory(at / "replaced");
  put(at / "replaced/file", "new");
  remove_leftovers(at.path());
  EXPECT_THAT(at.names(), ElementsAre("lost", "replaced"));
  EXPECT_EQ(contents(at / "lost/file"), "old");
  EXPECT_EQ(contents(at / "replaced/file"), "new");
}

TEST(FolderLock, KeepsASecondOneOut) {
  const TemporaryFolder at;
  const auto refused = [&] {
    try {
      const FolderLock lock(at.path());
    } catch (const std::system_error& e) {
      return e.code() == std::errc::operation_would_block;
    }
    return false;
  };
  {
    const FolderLock lock(at.path());
    EXPECT_TRUE(refused());
    EXPECT_TRUE(refused());
  }
  EXPECT_THAT(at.names(), IsEmpty());
  const Signpost ready;
  ChildProcess child([&] {
    const FolderLock lock(at.path());
    ready.reach();
    return sleep_for_ever();
  });
  ready.await();
  EXPECT_TRUE(refused());
  EXPECT_EQ(child.end(SIGKILL), -SIGKILL);
  EXPECT_EQ(at.names().size(), 1u);
  EXPECT_FALSE(refused());
  EXPECT_THAT(at.names(), IsEmpty());
}

}  // namespace
}  // namespace rainref
