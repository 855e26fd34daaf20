// The floating-point state is pinned where we compute and given back, whatever state a caller has.
#include "base/floating_point.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <stdexcept>
#include <thread>

#include "base/hostile_state.h"

namespace rainref {
namespace {

using test::hostile_states;
using test::HostileState;
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

#if defined(__x86_64__)
std::uint16_t x87_control() {
  std::uint16_t control;
  asm volatile("fnstcw %0" : "=m"(control));
  return control;
}
void set_x87_control(std::uint16_t control) { asm volatile("fldcw %0" : : "m"(control)); }

// The C library reads and prints numbers by the rounding of the x87 unit, which std::fesetround sets as well.
TEST(FloatingPointGuard, PinsTheX87UnitToo) {
  const std::uint16_t at_start = x87_control();
  EXPECT_EQ(at_start, 0x37f);
  std::uint16_t inside[3], after[3];
  for (int i = 0; i < 3; ++i) {
    set_x87_control(static_cast<std::uint16_t>(0x37f | (i + 1) << 10));
    {
      const FloatingPointGuard guard;
      inside[i] = x87_control();
    }
    after[i] = x87_control();
    set_x87_control(at_start);
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(inside[i], 0x37f);
    EXPECT_EQ(after[i], 0x37f | (i + 1) << 10);
  }
}

// Would end the process: neither unit may compute with the caller's exceptions, nor leave flags that raise them afterwards.
TEST(FloatingPointGuard, KeepsTheCallersExceptionsAway) {
  const KeepFloatingPoint keep;
  const std::uint16_t at_start = x87_control();
  set_floating_point_control(0);
  set_x87_control(0x340);
  std::uint64_t control;
  {
    const FloatingPointGuard guard;
    volatile double zero = 0, one = 1, quotient = one / zero;
    volatile long double longer = one;
    longer = longer / zero;
    static_cast<void>(quotient);
    control = floating_point_control();
  }
  asm volatile("fwait");  // raises what is pending
  const std::uint64_t after = floating_point_control();
  const std::uint16_t x87_after = x87_control();
  set_x87_control(at_start);
  set_floating_point_control(pinned_floating_point_control);
  EXPECT_EQ(control, pinned_floating_point_control);
  EXPECT_EQ(after, 0u);
  EXPECT_EQ(x87_after, 0x340);
}
#endif

TEST(FloatingPointGuard, LeavesTheCallersFlagsAsTheyWere) {
  std::feclearexcept(FE_ALL_EXCEPT);
  std::feraiseexcept(FE_DIVBYZERO);
  {
    const FloatingPointGuard guard;
    volatile double one = 1, three = 3, third = one / three;  // raises "inexact"
    static_cast<void>(third);
  }
  const int flags = std::fetestexcept(FE_ALL_EXCEPT);
  std::feclearexcept(FE_ALL_EXCEPT);
  EXPECT_EQ(flags, FE_DIVBYZERO);
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
