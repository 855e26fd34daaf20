// Files, names and locks act alike on every system.
#include "base/system.h"

#include <cerrno>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file_lock.h"
#include "base/temporary_folder.h"

namespace rainref {
namespace {

using testing::AnyOf;
using testing::ElementsAre;
using testing::IsEmpty;

/// A descriptor that is closed at the end.
struct Opened {
  int descriptor;
  ~Opened() {
    if (descriptor >= 0) system::close(descriptor);
  }
};

TEST(System, OpensWhatItIsAskedFor) {
  const TemporaryFolder at;
  EXPECT_EQ(system::open(at / "none", system::reading), -1);
  EXPECT_EQ(errno, ENOENT);
  {
    const Opened made{system::open(at / "new", system::writing | system::new_only)};
    ASSERT_GE(made.descriptor, 0);
    EXPECT_EQ(system::write(made.descriptor, "rain", 4), 4);
  }
  EXPECT_EQ(system::open(at / "new", system::writing | system::new_only), -1);
  EXPECT_EQ(errno, EEXIST);
  const Opened file{system::open(at / "new", system::reading)};
  char bytes[8] = {};
  EXPECT_EQ(system::read(file.descriptor, bytes, sizeof bytes), 4);
  EXPECT_STREQ(bytes, "rain");
  EXPECT_EQ(system::read(file.descriptor, bytes, sizeof bytes), 0);
}

TEST(System, TellsWhatIsThere) {
  const TemporaryFolder at;
  put(at / "a", "1234");
  put(at / "b", "");
  EXPECT_EQ(system::found(at / "none", true).kind, system::Kind::nothing);
  EXPECT_EQ(errno, ENOENT);
  EXPECT_EQ(system::found(at.path(), true).kind, system::Kind::folder);
  const system::Found a = system::found(at / "a", true), b = system::found(at / "b", true);
  EXPECT_EQ(a.kind, system::Kind::file);
  EXPECT_EQ(a.bytes, 4u);
  EXPECT_TRUE(a.is_mine);
  EXPECT_NE(a.file, b.file);
  const Opened opened{system::open(at / "a", system::reading)};
  EXPECT_EQ(system::found(opened.descriptor).file, a.file);
  EXPECT_TRUE(is_still(opened.descriptor, at / "a"));
  EXPECT_FALSE(is_still(opened.descriptor, at / "b"));
}

TEST(System, AnOpenFileCanBeRenamedAndRemoved) {
  const TemporaryFolder at;
  put(at / "a", "new");
  put(at / "b", "old");
  {
    const Opened opened{system::open(at / "a", system::reading)};
    EXPECT_EQ(system::rename(at / "a", at / "b"), 0);
    EXPECT_EQ(contents(at / "b"), "new");
    EXPECT_TRUE(is_still(opened.descriptor, at / "b"));
    EXPECT_EQ(system::remove_file(at / "b"), 0);
  }
  EXPECT_THAT(at.names(), IsEmpty());
}

TEST(System, AFolderTakesThePlaceOfAnEmptyOneAlone) {
  const TemporaryFolder at;
  for (const char* name : {"new", "empty", "full"}) ASSERT_EQ(system::make_folder(at / name, false), 0);
  EXPECT_EQ(system::make_folder(at / "new", true), -1);
  EXPECT_EQ(errno, EEXIST);
  put(at / "new/inside", "new");
  put(at / "full/inside", "old");
  EXPECT_EQ(system::rename(at / "new", at / "full"), -1);
  EXPECT_THAT(errno, AnyOf(ENOTEMPTY, EEXIST));
  EXPECT_EQ(system::rename(at / "new", at / "empty"), 0);
  EXPECT_THAT(at.names(), ElementsAre("empty", "full"));
  EXPECT_EQ(contents(at / "empty/inside"), "new");
  EXPECT_EQ(contents(at / "full/inside"), "old");
  put(at / "file", "file");
  EXPECT_EQ(system::rename(at / "empty", at / "file"), -1);
  EXPECT_EQ(errno, ENOTDIR);
  EXPECT_EQ(contents(at / "file"), "file");
}

TEST(System, ALockEndsWithItsFile) {
  const TemporaryFolder at;
  put(at / "a", "x");
  const Opened second{system::open(at / "a", system::reading | system::writing)};
  {
    const Opened first{system::open(at / "a", system::reading | system::writing)};
    EXPECT_EQ(lock_file(first.descriptor), FileLock::mine);
    EXPECT_EQ(lock_file(second.descriptor), FileLock::taken);
    EXPECT_EQ(contents(at / "a"), "x") << "others may read it";
  }
  EXPECT_EQ(lock_file(second.descriptor), FileLock::mine);
}

TEST(System, AFolderIsLockedAndLeavesNothing) {
  const TemporaryFolder at;
  ASSERT_EQ(system::make_folder(at / "a", false), 0);
  {
    const Opened first{system::open_folder_lock(at / "a")}, second{system::open_folder_lock(at / "a")};
    EXPECT_EQ(lock_file(first.descriptor), FileLock::mine);
    EXPECT_EQ(lock_file(second.descriptor), FileLock::taken);
    EXPECT_TRUE(is_still(first.descriptor, at / "a"));
    put(at / "a/inside", "x");
    EXPECT_EQ(system::rename(at / "a", at / "b"), 0) << "a locked folder can get its name";
  }
  EXPECT_THAT(at.names(), ElementsAre("b"));
}

TEST(System, SaysReasonsAsTheStandardLibraryComparesThem) {
  try {
    throw_system_error(ENOENT);
  } catch (const std::system_error& e) {
    EXPECT_EQ(e.code(), std::errc::no_such_file_or_directory);
    EXPECT_EQ(e.code().message(), reason_of(ENOENT));
  }
  std::uint64_t a = 0, b = 0;
  ASSERT_EQ(system::random_bits(a), 0);
  ASSERT_EQ(system::random_bits(b), 0);
  EXPECT_NE(a, b);
}

}  // namespace
}  // namespace rainref
