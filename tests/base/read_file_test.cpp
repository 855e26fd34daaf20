// A file is read whole or refused, before its memory is asked for.
#include "base/read_file.h"

#include <sys/stat.h>

#include <gmock/gmock.h>

#include "base/error_of.h"
#include "base/hash_of_file.h"
#include "base/temporary_folder.h"
#include "rainref/error.h"

namespace rainref {
namespace {

using ::testing::HasSubstr;

std::string refusal(const std::filesystem::path& path) {
  const std::string error = error_of([&] { read_file(path); });
  EXPECT_THAT(error, ::testing::AllOf(::testing::StartsWith("4 "), HasSubstr(path.string())));
  return error;
}

TEST(ReadFile, TheHashOfAFileIsThatOfItsBytes) {
  const TemporaryFolder folder;
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, (std::size_t{1} << 20) + 3, std::size_t{3} << 20}) {
    std::string all(size, 'a');
    for (std::size_t i = 0; i < size; i += 7) all[i] = static_cast<char>(i * 11);
    put(folder / "a", all);
    EXPECT_EQ(hash_of_file(folder / "a", {UINT64_MAX, ExitCode::io}), file_hash(read_file(folder / "a"))) << size;
  }
  EXPECT_THAT(error_of([&] { hash_of_file(folder / "a", {100, ExitCode::usage}); }), ::testing::StartsWith("2 "));
  EXPECT_THAT(error_of([&] { hash_of_file(folder.path(), {UINT64_MAX, ExitCode::io}); }), ::testing::StartsWith("4 "));
}
TEST(ReadFile, WholeFiles) {
  const TemporaryFolder folder;
  std::string all;
  for (int i = 0; i < 100000; ++i) all += static_cast<char>(i * 7);
  put(folder / "a", all);
  put(folder / "empty", "");
  const std::vector<std::byte> bytes = read_file(folder / "a");
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), all);
  EXPECT_TRUE(read_file(folder / "empty").empty());
}

TEST(ReadFile, WhatIsNoFile) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal(folder / "absent"), HasSubstr("No such file"));
  EXPECT_THAT(refusal(folder.path()), HasSubstr("Is a directory"));
  EXPECT_THAT(refusal("/dev/null"), HasSubstr("not a regular file"));
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(refusal(folder / "pipe"), HasSubstr("not a regular file"));  // and nobody waits for a writer
}

TEST(ReadFile, AHoleLargerThanMemory) {
  const TemporaryFolder folder;
  put(folder / "a", "");
  std::error_code error;
  std::filesystem::resize_file(folder / "a", std::uintmax_t{1} << 43, error);  // 8 TiB
  if (error) GTEST_SKIP() << "this file system has no such large files";
  EXPECT_THAT(refusal(folder / "a"), HasSubstr("are too many; this machine has"));
}

TEST(ReadFile, ALongerFileThanExpectedIsRefusedBeforeItIsRead) {
  const TemporaryFolder folder;
  put(folder / "x", "12345");
  EXPECT_EQ(read_file(folder / "x", {5, ExitCode::usage}).size(), 5u);
  EXPECT_EQ(error_of([&] {
              read_file(folder / "x", {4, ExitCode::usage});
            }),
            "2 '" + (folder / "x").string() + "': 5 bytes; expected at most 4");
}

}  // namespace
}  // namespace rainref
