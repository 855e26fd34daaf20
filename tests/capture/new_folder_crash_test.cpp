// What is there when a process dies while it gives a folder its name.
#include <stdlib.h>

#include <map>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/temporary_folder.h"
#include "base/traced_process.h"
#include "capture/new_folder.h"

namespace rainref::capture {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

std::span<const std::byte> bytes(const std::string& text) { return std::as_bytes(std::span(text)); }
const NewFolder::MayReplace always = [](const std::filesystem::path&) { return ""; };
const std::string all_names[] = {"a", "b/c"};

void make_pack(
    const std::filesystem::path& at, const std::string& text, const std::function<void()>& before_commit = [] {}) {
  NewFolder folder(at, always);
  for (const std::string& name : all_names) folder.write(name, bytes(text));
  before_commit();
  folder.commit();
}
/// The one text that all of a pack's files hold, or "" when it is not whole.
std::string text_of(const std::filesystem::path& pack) {
  const std::string text = contents(pack / all_names[0]);
  return contents(pack / all_names[1]) == text ? text : "";
}

/// In memory where there is such a place: each try waits for the disk several times.
class Memory {
 public:
  Memory() {
    const bool is_free = !::getenv("TEST_TMPDIR") && std::filesystem::is_directory("/dev/shm");
    if (is_free) ::setenv("TEST_TMPDIR", "/dev/shm/", 1);
    at_.emplace();
    if (is_free) ::unsetenv("TEST_TMPDIR");
  }
  const TemporaryFolder& folder() const { return *at_; }

 private:
  std::optional<TemporaryFolder> at_;
};

/// Kills the writer of a pack before each of its system calls in turn, from commit() to its end. `check` sees what is left.
/// Gives the number of calls.
int kill_everywhere(const TemporaryFolder& at, const std::function<bool()>& prepare, const std::function<void()>& check) {
  for (int last = 0;; ++last) {
    make_pack(at / "pack", "old");
    int calls = 0;
    const int end = traced(
        [&](const auto& begin) {
          if (!prepare()) ::_exit(77);
          make_pack(at / "pack", "new", begin);
        },
        [&](const SystemCall&) { return calls++ < last; });
    if (end < 0) return end;
    if (end == 1) return calls;
    SCOPED_TRACE("killed before system call " + std::to_string(last));
    check();
    if (testing::Test::HasFailure()) return last;
  }
}

TEST(NewFolderCrash, ThePackIsThereAtEveryMoment) {
  const Memory memory;
  const TemporaryFolder& at = memory.folder();
  std::map<std::string, int> seen;
  const int calls = kill_everywhere(
      at, [] { return true; },
      [&] {
        const std::string text = text_of(at / "pack");
        EXPECT_TRUE(text == "old" || text == "new") << text;
        ++seen[text];
        make_pack(at / "pack", "newer");  // and the next one cleans up
        EXPECT_THAT(at.names(), ElementsAre("pack"));
      });
  if (calls == -1) GTEST_SKIP() << "processes cannot be traced here";
  EXPECT_GT(calls, 10);
  EXPECT_GT(seen["old"], 0);
  EXPECT_GT(seen["new"], 0);
}

TEST(NewFolderCrash, WhereNamesCannotBeExchangedThePackIsPutBack) {
  const Memory memory;
  const TemporaryFolder& at = memory.folder();
  int gone = 0;
  const int calls = kill_everywhere(at, forbid_exchange, [&] {
    gone += std::filesystem::exists(at / "pack") ? 0 : 1;
    remove_leftovers(at.path());
    const std::string text = text_of(at / "pack");
    EXPECT_TRUE(text == "old" || text == "new") << text;
    EXPECT_THAT(at.names(), ElementsAre("pack"));
  });
  if (calls == -1) GTEST_SKIP() << "processes cannot be traced here";
  EXPECT_GT(calls, 10);
  EXPECT_EQ(gone, 1);  // between the two renames
}

TEST(NewFolderCrash, AllIsOnTheDiskBeforeItHasItsName) {
  const TemporaryFolder at;
  std::vector<std::string> synced;
  bool has_name = false;
  const int end = traced(
      [&](const auto& begin) {
        begin();
        make_pack(at / "deep/pack", "new");
      },
      [&](const SystemCall& call) {
        if (call.number != SYS_fsync) return true;
        has_name = has_name || std::filesystem::exists(at / "deep/pack");
        // Below the hidden folder, whose name is random.
        std::string name = std::filesystem::relative(call.file, at.path()).string();
        const std::size_t tmp = name.find(".tmp");
        if (tmp != std::string::npos) name = "hidden" + name.substr(tmp + 4);
        synced.push_back((has_name ? "after: " : "before: ") + name);
        return true;
      });
  if (end == -1) GTEST_SKIP() << "processes cannot be traced here";
  ASSERT_EQ(end, 1);
  EXPECT_THAT(synced, UnorderedElementsAre("before: hidden/a", "before: hidden/b/c", "before: hidden", "before: hidden/b", "after: deep",
                                           "after: ."));
}

}  // namespace
}  // namespace rainref::capture
