// Links are followed to what they name, and folders that were made on the way go again unless they are used.
#include "base/folders.h"

#include <system_error>

#include <gmock/gmock.h>

#include "base/child_process.h"
#include "base/signals.h"
#include "base/temporary_folder.h"

namespace rainref {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

int error_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const std::system_error& e) {
    return e.code().value();
  }
  return 0;
}

TEST(Followed, LinksLeadToWhatTheyNameThereOrNot) {
  const TemporaryFolder at;
  fs::create_directory(at / "real");
  fs::create_symlink("real/", at / "link");
  fs::create_symlink("link", at / "link2");
  fs::create_symlink("nothing/yet", at / "dangling");
  fs::create_symlink(at / "nothing", at / "absolute");
  EXPECT_EQ(followed(at / "real"), at / "real");
  EXPECT_EQ(followed(at / "link2"), at / "real");
  EXPECT_EQ(followed((at / "link2").string() + "/"), at / "real");
  EXPECT_EQ(followed(at / "dangling"), at / "nothing/yet");
  EXPECT_EQ(followed(at / "absolute"), at / "nothing");
  EXPECT_EQ(followed("/"), "/");
  EXPECT_EQ(followed(""), "");
  fs::create_symlink("b", at / "a");
  fs::create_symlink("a", at / "b");
  EXPECT_EQ(error_of([&] { followed(at / "a"); }), ELOOP);
}

TEST(MadeFolders, GoAgainUnlessKeptOrUsed) {
  const TemporaryFolder at;
  { const MadeFolders made(at / "a/b/c"); }
  EXPECT_THAT(at.names(), IsEmpty());
  {
    const MadeFolders made(at / "a/b/c");
    EXPECT_THAT(made.made(), ElementsAre(at / "a/b/c", at / "a/b", at / "a"));
    put(at / "a/mine.txt", "mine");
  }
  EXPECT_FALSE(fs::exists(at / "a/b"));
  EXPECT_EQ(contents(at / "a/mine.txt"), "mine");
  MadeFolders made(at / "a/d");
  made.keep();
  EXPECT_TRUE(fs::is_directory(at / "a/d"));
  EXPECT_THAT(MadeFolders(at / "a").made(), IsEmpty());
  EXPECT_THAT(MadeFolders("").made(), IsEmpty());
}

// What is in the way stays: a file, and a link that leads nowhere.
TEST(MadeFolders, RemoveNothingOfOthers) {
  const TemporaryFolder at;
  put(at / "file", "mine");
  fs::create_symlink("nothing", at / "dangling");
  EXPECT_EQ(error_of([&] { MadeFolders(at / "file"); }), ENOTDIR);
  EXPECT_EQ(error_of([&] { MadeFolders(at / "file/a"); }), ENOTDIR);
  EXPECT_EQ(error_of([&] { MadeFolders(at / "dangling"); }), EEXIST);
  EXPECT_EQ(error_of([&] { MadeFolders(at / "dangling/a"); }), EEXIST);
  EXPECT_EQ(contents(at / "file"), "mine");
  EXPECT_TRUE(fs::is_symlink(at / "dangling"));
  EXPECT_THAT(at.names(), ElementsAre("dangling", "file"));
}

TEST(MadeFolders, GoOnAnInterruption) {
  const TemporaryFolder at;
  const Signpost ready;
  ChildProcess child([&] {
    undo_when_interrupted();
    const MadeFolders made(at / "a/b");
    ready.reach();
    return sleep_for_ever();
  });
  ready.await();
  EXPECT_THAT(at.names(), ElementsAre("a"));
  EXPECT_EQ(child.end(SIGTERM), -SIGTERM);
  EXPECT_THAT(at.names(), IsEmpty());
}

}  // namespace
}  // namespace rainref
