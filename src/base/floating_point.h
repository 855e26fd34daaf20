// The floating-point environment that every result depends on: checked at compile time, set at run time.
#pragma once

#include <cfloat>
#include <cstdint>

#ifdef __FAST_MATH__
#error "rainref cannot be built with -ffast-math (or -Ofast): it changes the bits of every result"
#endif
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0
#error "rainref needs FLT_EVAL_METHOD 0 (float arithmetic in float); build for SSE2, not x87"
#endif

namespace rainref {

/// The control bits of the floating-point unit: MXCSR on x86, FPCR on aarch64, always 0 in WebAssembly, which has none.
std::uint64_t floating_point_control();
void set_floating_point_control(std::uint64_t bits);

/// The required state: round to nearest even, subnormals kept (no flush to zero, no denormals-are-zero), no traps.
extern const std::uint64_t pinned_floating_point_control;

/// Sets that state for a scope and then restores the caller's. Every tile body runs inside one, because a thread pool passes the caller's
/// state to its workers, and a task that changes the state would pass it on to the next.
class FloatingPointGuard {
 public:
  FloatingPointGuard();
  ~FloatingPointGuard();
  FloatingPointGuard(const FloatingPointGuard&) = delete;
  FloatingPointGuard& operator=(const FloatingPointGuard&) = delete;

 private:
  std::uint64_t saved_;
};

/// Properties of this build's arithmetic, measured by computing.
struct FloatingPointReport {
  bool contracts = false;         ///< a*b+c was fused
  bool flushes_results = false;   ///< a subnormal result became zero
  bool flushes_operands = false;  ///< a subnormal operand was treated as zero
  bool rounds_to_nearest = true;
  bool good() const { return !contracts && !flushes_results && !flushes_operands && rounds_to_nearest; }
};
/// Probes the plain scalar code of this build in the calling thread's current state.
FloatingPointReport probe_floating_point();

}  // namespace rainref
