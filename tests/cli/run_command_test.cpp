// Commands in words that /bin/sh and cmd.exe share.
#include "cli/run_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/path_text.h"
#include "base/temporary_folder.h"

namespace rainref::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::chrono::seconds long_enough{60};

TEST(RunCommand, GivesWhatWasPrintedAndHowItEnded) {
  const CommandEnd good = run_command("echo rain", long_enough);
  EXPECT_EQ(good.failure, "");
  EXPECT_THAT(good.last_lines, ElementsAre("rain"));
  const CommandEnd bad = run_command("exit 3", long_enough);
  EXPECT_EQ(bad.failure, "the port's command ended with exit code 3");
  EXPECT_THAT(bad.last_lines, IsEmpty());
  EXPECT_THAT(run_command("rainref-no-such-program", long_enough).failure, HasSubstr("there is no such program"));
}

TEST(RunCommand, APathInACommandIsOneWord) {
  const TemporaryFolder at;
  const std::filesystem::path folder = at / "two words";
  std::filesystem::create_directory(folder);
  std::string told = plain_path(folder);
  if (told.empty()) told = link_to(folder, at / "link");
  const CommandEnd end = run_command("echo x> " + in_command("echo x> ", told + "/a.txt"), long_enough);
  EXPECT_EQ(end.failure, "") << told;
  EXPECT_TRUE(std::filesystem::exists(folder / "a.txt"));
}

TEST(RunCommand, APlainPathStaysAsItIs) {
  EXPECT_EQ(plain_path(utf8_path("")), "");
  EXPECT_EQ(plain_path(utf8_path("a.b-c_1")), "a.b-c_1");
  EXPECT_EQ(plain_path(utf8_path("no/such folder")), "");
  EXPECT_NE(temporary_folder(), std::filesystem::path());
}

TEST(RunCommand, AWordIsQuotedWhereTheShellWouldSplitIt) {
  EXPECT_EQ(shell_word("a/b-c_1.d"), "a/b-c_1.d");
  for (const std::string_view word : {"a b", "", "a&b", "a;b|c", "$x"}) {
    const CommandEnd end = run_command("echo " + shell_word(word) + "x", long_enough);
    EXPECT_EQ(end.failure, "") << word;
    ASSERT_EQ(end.last_lines.size(), 1u) << word;
    EXPECT_THAT(end.last_lines[0], HasSubstr(std::string(word))) << word;  // cmd.exe's echo prints the quotes, too
  }
}

}  // namespace
}  // namespace rainref::cli
