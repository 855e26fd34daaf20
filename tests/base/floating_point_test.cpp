#include "base/floating_point.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

#include "base/hostile_state.h"

namespace rainref {
namespace {

using test::HostileState;
using test::hostile_states;
using test::KeepFloatingPoint;

TEST(FloatingPoint, ThePinnedBitsAreTheDefaultOfTheProcessor) {
#if defined(__aarch64__)
  EXPECT_EQ(pinned_floating_point_control, 0u);
#else
  // All six exceptions masked, round to nearest, no flush to zero, no denormals-are-zero.
  EXPECT_EQ(pinned_floating_point_control, 0x1f80u);
#endif
  EXPECT_EQ(floating_point_control(), pinned_floating_point_control);
}

TEST(FloatingPoint, TheProbeFindsNothingInThisBuild) {
  const FloatingPointReport report = probe_floating_point();
  EXPECT_FALSE(report.contracts);
  EXPECT_FALSE(report.flushes_results);
  EXPECT_FALSE(report.flushes_operands);
  EXPECT_TRUE(report.rounds_to_nearest);
  EXPECT_TRUE(report.good());
}

TEST(FloatingPoint, TheProbeFindsEveryHostileState) {
  for (const HostileState& state : hostile_states()) {
    FloatingPointReport report;
    {
      const KeepFloatingPoint keep;
      set_floating_point_control(state.control);
      report = probe_floating_point();
    }
    EXPECT_EQ(report.flushes_results, state.flushes_results) << state.name;
    EXPECT_EQ(report.flushes_operands, state.flushes_operands) << state.name;
    EXPECT_EQ(report.rounds_to_nearest, state.rounds_to_nearest) << state.name;
    EXPECT_FALSE(report.contracts) << state.name;
    EXPECT_FALSE(report.good()) << state.name;
  }
}

TEST(FloatingPoint, AReportIsGoodOnlyWhenNothingIsWrong) {
  EXPECT_TRUE(FloatingPointReport{}.good());
  EXPECT_FALSE((FloatingPointReport{.contracts = true}.good()));
  EXPECT_FALSE((FloatingPointReport{.flushes_results = true}.good()));
  EXPECT_FALSE((FloatingPointReport{.flushes_operands = true}.good()));
  EXPECT_FALSE((FloatingPointReport{.rounds_to_nearest = false}.good()));
}

TEST(FloatingPointGuard, PinsAndPutsBackEveryHostileState) {
  for (const HostileState& state : hostile_states()) {
    std::uint64_t inside = 0, after = 0;
    bool good = false;
    {
      const KeepFloatingPoint keep;
      set_floating_point_control(state.control);
      {
        const FloatingPointGuard guard;
        inside = floating_point_control();
        good = probe_floating_point().good();
      }
      after = floating_point_control();
    }
    EXPECT_EQ(inside, pinned_floating_point_control) << state.name;
    EXPECT_TRUE(good) << state.name;
    EXPECT_EQ(after, state.control) << state.name;
  }
}

TEST(FloatingPointGuard, PutsThePinnedStateBackWhenTheScopeItselfIsHostile) {
  for (const HostileState& state : hostile_states()) {
    const KeepFloatingPoint keep;
    {
      const FloatingPointGuard guard;
      set_floating_point_control(state.control);
    }
    EXPECT_EQ(floating_point_control(), pinned_floating_point_control) << state.name;
  }
}

TEST(FloatingPointGuard, PutsTheStateBackAfterAnException) {
  const KeepFloatingPoint keep;
  const std::uint64_t hostile = hostile_states().front().control;
  set_floating_point_control(hostile);
  try {
    const FloatingPointGuard guard;
    throw std::runtime_error("stop");
  } catch (const std::runtime_error&) {
    const std::uint64_t after = floating_point_control();
    set_floating_point_control(pinned_floating_point_control);
    EXPECT_EQ(after, hostile);
    return;
  }
  FAIL();
}

TEST(FloatingPointGuard, Nests) {
  const KeepFloatingPoint keep;
  const std::uint64_t hostile = hostile_states().front().control;
  const FloatingPointGuard outer;
  {
    set_floating_point_control(hostile);
    {
      const FloatingPointGuard inner;
      EXPECT_EQ(floating_point_control(), pinned_floating_point_control);
    }
    EXPECT_EQ(floating_point_control(), hostile);
  }
}

TEST(FloatingPoint, TheControlBitsLeaveOutTheStickyFlags) {
  const KeepFloatingPoint keep;
  volatile float one = 1, three = 3, third = one / three;  // raises "inexact"
  EXPECT_NE(third, 0.0f);
  EXPECT_EQ(floating_point_control(), pinned_floating_point_control);
}

TEST(FloatingPoint, AStateBelongsToOneThread) {
  const KeepFloatingPoint keep;
  std::uint64_t other = 0;
  std::thread([&] {
    set_floating_point_control(hostile_states().front().control);
    other = floating_point_control();
  }).join();
  EXPECT_NE(other, pinned_floating_point_control);
  EXPECT_EQ(floating_point_control(), pinned_floating_point_control);
}

}  // namespace
}  // namespace rainref
