// Floating-point states that a host program may leave behind, as control bits to set on purpose.
#pragma once

#include <cstdint>
#include <vector>

#include "base/floating_point.h"

namespace rainref::test {

struct HostileState {
  const char* name;
  std::uint64_t control;
  bool flushes_results, flushes_operands, rounds_to_nearest;  ///< what a probe must say of it
};

/// Aarch64 has one bit (FZ) that flushes operands and results alike.
inline std::vector<HostileState> hostile_states() {
#if defined(__aarch64__)
  return {{"flush to zero", 1u << 24, true, true, true},
          {"rounding up", 1u << 22, false, false, false},
          {"rounding down", 2u << 22, false, false, false},
          {"rounding toward zero", 3u << 22, false, false, false}};
#else
  const std::uint64_t pinned = pinned_floating_point_control;
  return {{"flush to zero", pinned | 0x8000, true, false, true}, {"denormals are zero", pinned | 0x0040, false, true, true},
          {"both", pinned | 0x8040, true, true, true},           {"rounding down", pinned | 0x2000, false, false, false},
          {"rounding up", pinned | 0x4000, false, false, false}, {"rounding toward zero", pinned | 0x6000, false, false, false},
          {"everything", pinned | 0xe040, true, true, false}};
#endif
}

/// Puts the thread's state back when a test ends, however it ends.
class KeepFloatingPoint {
 public:
  KeepFloatingPoint() : saved_(floating_point_control()) {}
  ~KeepFloatingPoint() { set_floating_point_control(saved_); }

 private:
  std::uint64_t saved_;
};

}  // namespace rainref::test
