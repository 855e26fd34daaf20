// A file appears whole under its name or not at all, whatever fails while it is written.
#include "base/atomic_file.h"

#include <signal.h>
#include <sys/resource.h>

#include <gmock/gmock.h>

#include "base/child_process.h"
#include "base/error_of.h"
#include "base/temporary_folder.h"

namespace rainref {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "a.txt");
  file.write("one ");
  file.write("two");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
  file.commit();
  EXPECT_EQ(contents(folder / "a.txt"), "one two");
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(AtomicFile, WithoutCommitLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder folder;
  put(folder / "a.txt", "old");
  {
    AtomicFile file(folder / "a.txt");
    file.write("new");
  }
  EXPECT_EQ(contents(folder / "a.txt"), "old");
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(AtomicFile, KeepsEveryByteAcrossItsBuffer) {
  const TemporaryFolder folder;
  std::string expected;
  AtomicFile file(folder / "a.bin");
  for (const std::size_t size : {1u, 65535u, 65536u, 1u, 65537u, 200000u, 0u, 7u, 40000u, 40000u}) {
    std::string part(size, '\0');
    for (std::size_t i = 0; i < size; ++i) part[i] = static_cast<char>((expected.size() + i) * 131 >> 3);
    file.write(part);
    expected += part;
  }
  file.commit();
  EXPECT_EQ(contents(folder / "a.bin"), expected);
}

TEST(AtomicFile, WritesAnEmptyFile) {
  const TemporaryFolder folder;
  write_file(folder / "empty", std::string_view());
  EXPECT_THAT(folder.names(), ElementsAre("empty"));
}

TEST(AtomicFile, TwoWritersOfOneNameDoNotMix) {
  const TemporaryFolder folder;
  AtomicFile first(folder / "a"), second(folder / "a");
  first.write("first");
  second.write("second");
  second.commit();
  first.commit();
  EXPECT_EQ(contents(folder / "a"), "first");
  EXPECT_THAT(folder.names(), ElementsAre("a"));
}

TEST(AtomicFile, ANameOfFullLengthFits) {
  const TemporaryFolder folder;
  const std::string name(255, 'n');
  write_file(folder / name, "x");
  EXPECT_THAT(folder.names(), ElementsAre(name));
}

// Also where the link leads nowhere yet, as a shell's ">" does.
TEST(AtomicFile, WritesThroughASymbolicLink) {
  for (const bool is_there : {true, false}) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "real");
    if (is_there) put(folder / "real/a", "old");
    std::filesystem::create_symlink("real/a", folder / "link");
    write_file(folder / "link", "new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(contents(folder / "real/a"), "new");
    EXPECT_THAT(folder.names(), ElementsAre("link", "real"));
  }
}

TEST(AtomicFile, WritesADeviceWithoutReplacingIt) {
  write_file("/dev/null", "x");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, AFullDiskIsAnIoErrorWithItsReason) {
  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full";
  EXPECT_EQ(error_of([] { write_file("/dev/full", "x"); }), "4 cannot write '/dev/full': No space left on device");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(AtomicFile, AFolderThatCannotHoldFilesIsAnIoError) {
  const TemporaryFolder folder;
  put(folder / "file", "x");
  EXPECT_EQ(error_of([&] { AtomicFile(folder / "file/a.txt"); }),
            "4 cannot write '" + (folder / "file/a.txt").string() + "': Not a directory");
  EXPECT_EQ(error_of([&] { AtomicFile(folder / "none/a.txt"); }),
            "4 cannot write '" + (folder / "none/a.txt").string() + "': No such file or directory");
  EXPECT_THAT(folder.names(), ElementsAre("file"));
}

TEST(AtomicFile, AFolderOrAnEmptyNameIsAnIoError) {
  const TemporaryFolder folder;
  for (const std::filesystem::path& path : {folder.path(), folder / "", folder / "new/", std::filesystem::path()})
    EXPECT_THAT(error_of([&] { write_file(path, "x"); }), StartsWith("4 ")) << path;
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(AtomicFile, RefusesUseAfterCommit) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "a");
  file.commit();
  EXPECT_THAT(error_of([&] { file.write("late"); }), StartsWith("5 "));
  EXPECT_THROW(file.commit(), Error);
}

/// Exit status of a child process that may write files of 100 000 bytes at most and runs f; 99 when f does not throw an
/// io error that says so.
template <class F>
int status_under_size_limit(F&& f) {
  ChildProcess child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100000, 100000};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) return 98;
    const std::string error = error_of(f);
    return error.starts_with("4 ") && error.ends_with("File too large") ? 0 : 99;
  });
  return child.wait();
}

TEST(AtomicFile, AShortWriteIsAnIoErrorAndLeavesNothing) {
  const TemporaryFolder folder;
  // One call that the kernel cuts short at the limit, and many small ones that reach it in a flush.
  EXPECT_EQ(status_under_size_limit([&] { write_file(folder / "a", std::string(150000, 'x')); }), 0);
  EXPECT_THAT(folder.names(), IsEmpty());
  put(folder / "a", "old");
  EXPECT_EQ(status_under_size_limit([&] {
              AtomicFile file(folder / "a");
              for (int i = 0; i < 150; ++i) file.write(std::string(1000, 'x'));
              file.commit();
            }),
            0);
  EXPECT_THAT(folder.names(), ElementsAre("a"));
  EXPECT_EQ(contents(folder / "a"), "old");
}

}  // namespace
}  // namespace rainref
