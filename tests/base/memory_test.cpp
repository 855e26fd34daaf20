// The memory that a run may take is the least of the machine's, the control groups' and the process's own limits.
#include "base/memory.h"

#include <sys/resource.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/child_process.h"
#include "base/error_of.h"
#include "base/temporary_folder.h"

namespace rainref {
namespace {

constexpr std::size_t mib = std::size_t{1} << 20;

TEST(Memory, IsWrittenInTheUnitThatSuitsIt) {
  EXPECT_EQ(memory_text(0), "0.0 MiB");
  EXPECT_EQ(memory_text(12u << 20), "12.0 MiB");
  EXPECT_EQ(memory_text((1023u << 20) + (1u << 19)), "1023.5 MiB");
  EXPECT_EQ(memory_text(1u << 30), "1.0 GiB");
  EXPECT_EQ(memory_text(std::size_t{3} << 29), "1.5 GiB");
}

TEST(Memory, ThisMachineHasSome) {
  EXPECT_GT(memory_limit().bytes, std::size_t{1} << 26);
  EXPECT_LT(memory_limit().bytes, std::size_t{1} << 50);
  EXPECT_GT(resident_memory(), std::size_t{1} << 18);
  EXPECT_LE(resident_memory(), memory_limit().bytes);
}

TEST(Memory, ThePeakIsThatOfTheOrderInWhichItIsTaken) {
  MemoryPeak m;
  m.hold(10);
  m.pass(5);
  m.hold(2);
  EXPECT_EQ(m.held(), 12u);
  EXPECT_EQ(m.peak(), 15u);
  m.release(4);
  MemoryPeak later;
  later.hold(1);
  later.pass(20);
  m.then(later);
  EXPECT_EQ(m.held(), 9u);
  EXPECT_EQ(m.peak(), 29u);
}

/// A machine whose /proc and /sys say what a test wants.
class Cgroups : public testing::Test {
 protected:
  void groups(const std::string& lines) { put("proc/self/cgroup", lines); }
  void put(const std::string& file, const std::string& text) {
    std::filesystem::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
  }
  MemoryLimit limit() const { return memory_limit(folder_.path()); }
  void expect(std::size_t bytes, const std::string& owner) const {
    EXPECT_EQ(limit().bytes, bytes);
    EXPECT_EQ(limit().owner, owner);
  }
  void expect_the_machine() const { expect(memory_limit("/no/such/root").bytes, "this machine has"); }

 private:
  TemporaryFolder folder_;
};

TEST_F(Cgroups, AreNotNeeded) { expect_the_machine(); }

TEST_F(Cgroups, VersionTwoLimitsTheGroupAndAllBelow) {
  groups("0::/jobs/7/task\n");
  put("sys/fs/cgroup/jobs/7/task/memory.max", "max\n");
  expect_the_machine();
  put("sys/fs/cgroup/jobs/memory.max", "33554432\n");
  expect(32 * mib, "the cgroup /jobs allows");
  put("sys/fs/cgroup/jobs/7/task/memory.max", "16777216\n");
  expect(16 * mib, "the cgroup /jobs/7/task allows");
  put("sys/fs/cgroup/jobs/7/memory.max", "8388608\n");
  expect(8 * mib, "the cgroup /jobs/7 allows");
}

TEST_F(Cgroups, OfOtherProcessesDoNotCount) {
  groups("0::/jobs/7\n");
  put("sys/fs/cgroup/jobs/8/memory.max", "8388608\n");
  put("sys/fs/cgroup/jobs/7/below/memory.max", "8388608\n");
  expect_the_machine();
}

TEST_F(Cgroups, InAContainerTheMountIsTheGroup) {
  groups("0::/\n");
  put("sys/fs/cgroup/memory.max", "8388608\n");
  expect(8 * mib, "the cgroup / allows");
  groups("0::/../../outside/group\n");  // of a process that another namespace started
  expect(8 * mib, "the cgroup / allows");
}

TEST_F(Cgroups, VersionOneHasAFolderForEachController) {
  groups("9:name=systemd:/a\n4:cpu,memory:/a/b\n2:cpuset:/a\n0::/\n");
  put("sys/fs/cgroup/memory/a/b/memory.limit_in_bytes", "9223372036854771712\n");  // none
  expect_the_machine();
  put("sys/fs/cgroup/memory/a/memory.limit_in_bytes", "8388608\n");
  expect(8 * mib, "the cgroup /a allows");
  put("sys/fs/cgroup/memory/memory.limit_in_bytes", "4194304\n");
  expect(4 * mib, "the cgroup / allows");
}

TEST_F(Cgroups, BothVersionsTogether) {
  groups("4:memory:/a\n0::/b\n");
  put("sys/fs/cgroup/memory/a/memory.limit_in_bytes", "8388608\n");
  put("sys/fs/cgroup/unified/b/memory.max", "4194304\n");
  expect(4 * mib, "the cgroup /b allows");
}

TEST_F(Cgroups, DamageIsNoLimit) {
  groups("0\n::\n0:memory\n0::relative\n");
  put("sys/fs/cgroup/memory.max", "8388608\n");
  expect_the_machine();
  groups("0::/\n");
  put("sys/fs/cgroup/memory.max", "much\n");
  expect_the_machine();
}

TEST(Memory, TheProcesssOwnLimitsCount) {
  const auto with_limit = [](auto resource, std::size_t bytes, const char* owner) {
    ChildProcess child([=] {  // the limits of this process stay
      const rlimit limit{bytes, RLIM_INFINITY};
      if (::setrlimit(resource, &limit) != 0) return 1;
      const MemoryLimit found = memory_limit("/no/such/root");
      if (found.owner != owner) return 2;
      return found.bytes <= bytes && found.bytes + (std::size_t{1} << 31) > bytes ? 0 : 3;  // less what is reserved
    });
    return child.wait();
  };
  const std::size_t half = memory_limit("/no/such/root").bytes / 2;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which reserve terabytes, and count their own as data
  EXPECT_EQ(with_limit(RLIMIT_DATA, half, "the limit RLIMIT_DATA (ulimit -d) allows"), 0);
  EXPECT_EQ(with_limit(RLIMIT_AS, half, "the limit RLIMIT_AS (ulimit -v) allows"), 0);
#else
  EXPECT_NE(with_limit(RLIMIT_DATA, half, "the limit RLIMIT_DATA (ulimit -d) allows"), 2);
#endif
}

TEST(Memory, WhatDoesNotFitIsRefusedWithBothNumbers) {
  EXPECT_NO_THROW(require_memory("a small scene", mib));
  EXPECT_THAT(error_of([] { require_memory("run.size 9x9", std::size_t{1} << 50); }),
              testing::MatchesRegex("2 run\\.size 9x9 needs 10485[0-9]+\\.[0-9] GiB of memory; .* [0-9.]+ [GM]iB"));
}

}  // namespace
}  // namespace rainref
