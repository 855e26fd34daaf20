// Shards of a sweep take each cell once.
#include "sweep/shard.h"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error_of.h"

namespace rainref::sweep {
namespace {

using Variables = std::map<std::string, std::string>;
Shard shard(const std::string& text, const Variables& variables = {}) {
  return shard_from(text, [&](const char* name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    if (found == variables.end()) return {};
    return found->second;
  });
}
std::string text(const Shard& s) { return std::to_string(s.number) + "/" + std::to_string(s.count); }
std::string error(const std::string& t, const Variables& v = {}) {
  return error_of([&] { shard(t, v); });
}

TEST(Shard, TogetherTheyTakeEachCellOnce) {
  for (const std::int64_t cells : {1, 3, 7, 20, 1000000}) {
    std::map<int, std::int64_t> sizes;
    std::int64_t before = 0;
    for (std::int64_t cell = 0; cell < cells; ++cell) {
      int taken = 0;
      for (int k = 0; k < 7; ++k) {
        if (!Shard{k, 7}.takes(cell, cells)) continue;
        ++taken;
        ++sizes[k];
        EXPECT_GE(k, before);  // neighbours stay together
        before = k;
      }
      ASSERT_EQ(taken, 1) << cell << " of " << cells;
    }
    for (const auto& [k, size] : sizes) EXPECT_LE(std::abs(size - cells / 7.0), 1) << k;
  }
}

TEST(Shard, AutoReadsTheEngine) {
  const Variables slurm{
      {"SLURM_ARRAY_TASK_ID", "14"}, {"SLURM_ARRAY_TASK_MIN", "10"}, {"SLURM_ARRAY_TASK_STEP", "2"}, {"SLURM_ARRAY_TASK_COUNT", "5"}};
  EXPECT_EQ(text(shard("auto", slurm)), "2/5");
  const Variables sge{{"SGE_TASK_ID", "3"}, {"SGE_TASK_FIRST", "1"}, {"SGE_TASK_LAST", "8"}, {"SGE_TASK_STEPSIZE", "1"}};
  EXPECT_EQ(text(shard("auto", sge)), "2/8");
  EXPECT_EQ(text(shard("auto/4", {{"PBS_ARRAY_INDEX", "3"}})), "3/4");
  EXPECT_EQ(text(shard("auto/4", {{"JOB_COMPLETION_INDEX", "0"}})), "0/4");
  EXPECT_EQ(text(shard("auto", {{"OMPI_COMM_WORLD_RANK", "1"}, {"OMPI_COMM_WORLD_SIZE", "3"}})), "1/3");
  EXPECT_EQ(text(shard("auto", {{"PMI_RANK", "2"}, {"PMI_SIZE", "3"}})), "2/3");
  // Grid Engine says so of a job that is no array, which may yet be one of MPI.
  EXPECT_EQ(text(shard("auto", {{"SGE_TASK_ID", "undefined"}, {"OMPI_COMM_WORLD_RANK", "1"}, {"OMPI_COMM_WORLD_SIZE", "3"}})), "1/3");
}

TEST(Shard, IsRefusedInOneSentence) {
  for (const char* bad : {"", "1", "3/3", "-1/3", "1/0", "1/x", "a/2", "1/2/3", "auto/", "auto/0", "auto/x"})
    EXPECT_EQ(error(bad, {{"PMI_RANK", "0"}, {"PMI_SIZE", "1"}}),
              std::string("2 --shard: expected K/N with K from 0 to N - 1, auto, or auto/N, found '") + bad + "'");
  EXPECT_THAT(error("auto"), testing::HasSubstr("found none of their variables"));
  EXPECT_EQ(error("auto", {{"JOB_COMPLETION_INDEX", "0"}}),
            "2 --shard: expected auto/N, for Kubernetes does not say how many there are, found auto");
  EXPECT_EQ(error("auto/4", {{"PBS_ARRAY_INDEX", "4"}}), "2 --shard: expected PBS_ARRAY_INDEX from 0 to 3 by 1, found 4");
  EXPECT_EQ(error("auto/4", {{"PBS_ARRAY_INDEX", "x"}}), "2 --shard: expected a whole number in PBS's PBS_ARRAY_INDEX, found 'x'");
}

}  // namespace
}  // namespace rainref::sweep
