// The floating-point environment that every result depends on: checked when compiling, pinned when running.
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

/// The control bits of the floating-point unit: MXCSR on x86, FPCR on aarch64, always 0 in WebAssembly, which has none to set.
std::uint64_t floating_point_control();
void set_floating_point_control(std::uint64_t bits);

/// The pinned state: round to nearest even, subnormals kept (no flush to zero, no denormals-are-zero), no traps.
extern const std::uint64_t pinned_floating_point_control;

/// Pins the state for a scope and puts the caller's back. Every tile body runs inside one, because a thread pool hands
/// its workers whatever state the caller had, and a task that dirties the state leaks it to the next.
class FloatingPointGuard {
 public:
  FloatingPointGuard();
  ~FloatingPointGuard();
  FloatingPointGuard(const FloatingPointGuard&) = delete;
  FloatingPointGuard& operator=(const FloatingPointGuard&) = delete;

 private:
  std::uint64_t saved_;
};

/// What the arithmetic of this build does, found by computing.
struct FloatingPointReport {
  bool contracts = false;         ///< a*b+c was fused
  bool flushes_results = false;   ///< a subnormal result became zero
  bool flushes_operands = false;  ///< a subnormal operand was taken as zero
  bool rounds_to_nearest = true;
  bool good() const { return !contracts && !flushes_results && !flushes_operands && rounds_to_nearest; }
};
/// Probes the plain scalar code of this build in the calling thread's current state.
FloatingPointReport probe_floating_point();

}  // namespace rainref
