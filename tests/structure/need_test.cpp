// `need` of scripts/lib.sh installs what is missing, and waits where another program holds a lock of apt.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/shell.h"
#include "base/temporary_folder.h"

namespace rainref {
namespace {

using testing::HasSubstr;
using testing::Not;

class Need : public testing::Test {
 protected:
  /// A program that is found before the system's.
  void program(const std::string& name, const std::string& text) const {
    put(folder_ / name, "#!/bin/bash\n" + text + "\n");
    std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_all);
  }
  /// apt-get says this in its first two calls of `verb`, and fails with 100.
  void fail_twice(const std::string& verb, const std::string& saying) const {
    program("dpkg-query", "exit 1");
    program("sudo", "\"$@\"");
    program("sleep", "true");
    program("apt-get", "case \"$*\" in *" + verb + "*)\n  echo >>'" + calls() + "'\n  [ $(wc -l <'" + calls() + "') -gt 2 ] || { echo '" +
                           saying + "' >&2; exit 100; } ;;\nesac");
  }
  std::pair<std::string, int> need() const {
    return output_of("cd '" RAINREF_SOURCE_DIR "' && PATH='" + folder_.path().string() +
                     "':$PATH bash -c '. scripts/lib.sh && need frost-dev'");
  }
  std::string calls() const { return (folder_ / "calls").string(); }

 private:
  TemporaryFolder folder_;
};

TEST_F(Need, WaitsForTheLocksOfApt) {
  for (const auto& [verb, lock] : {std::pair{"install", "/var/lib/dpkg/lock-frontend"}, std::pair{"update", "/var/lib/apt/lists/lock"}}) {
    std::filesystem::remove(calls());
    fail_twice(verb, std::string("E: Could not get lock ") + lock + ". It is held by process 7 (apt-get)");
    const auto [said, result] = need();
    EXPECT_EQ(result, 0) << said;
    EXPECT_THAT(said, HasSubstr("Waiting for another program"));
    EXPECT_EQ(contents(calls()), "\n\n\n");
  }
}
TEST_F(Need, SaysAtOnceWhatWaitingDoesNotCure) {
  fail_twice("install", "E: Unable to locate package frost-dev");
  const auto [said, result] = need();
  EXPECT_NE(result, 0);
  EXPECT_THAT(said, HasSubstr("Unable to locate package frost-dev"));
  EXPECT_THAT(said, Not(HasSubstr("Waiting")));
  EXPECT_EQ(contents(calls()), "\n");
}

}  // namespace
}  // namespace rainref
