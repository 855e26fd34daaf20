// The fuzzer's target without a fuzzer: packs as they are, what the fuzzer found, and programs of edits from a fixed seed.
#include "fuzz/pack_target.h"

#include <gtest/gtest.h>

#include "judge/support.h"
#include "source_folder.h"

namespace rainref::fuzz {
namespace {

bool run(const std::vector<std::uint8_t>& program) { return judge_pack(std::as_bytes(std::span(program))); }

// What the target makes of a pack without edits must be taken by every verb: or its edits would never reach the judge.
TEST(PackFuzz, UntouchedPacksReachAVerdict) {
  for (std::size_t b = 0; b < bases().size(); ++b)
    for (std::size_t k = 0; k < bases()[b].cases.size(); ++k)
      for (std::uint8_t verb : {0, 2})
        EXPECT_TRUE(run({static_cast<std::uint8_t>(b), verb, static_cast<std::uint8_t>(k)})) << bases()[b].cases[k].folder();
}

// Each crashed, hung or was judged from memory that is not the program's once.
TEST(PackFuzz, WhatWasFoundIsRefusedOrJudged) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(rainref::test::source_folder() + "/tests/fuzz/seeds/pack")) {
    const std::string bytes = contents(entry.path());
    judge_pack(std::as_bytes(std::span(bytes)));
    ++files;
  }
  EXPECT_GT(files, 0);
}

// RAINREF_PROGRAMS sets how many; scripts/full/samples runs more, scripts/full/fuzz goes on from what it reached.
TEST(PackFuzz, RandomPrograms) {
  const std::int64_t programs = judge::test::count_from("RAINREF_PROGRAMS", 100);
  judge::test::Words words(2026);
  int taken = 0, refused = 0;
  for (std::int64_t k = 0; k < programs; ++k) {
    std::vector<std::uint8_t> program(4 + words() % 40);
    for (std::uint8_t& byte : program) byte = static_cast<std::uint8_t>(words() >> 56);
    ++(run(program) ? taken : refused);
  }
  EXPECT_GT(taken, programs / 10);
  EXPECT_GT(refused, programs / 10);
}

}  // namespace
}  // namespace rainref::fuzz
