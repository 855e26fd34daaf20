// Floating-point states that a caller of the public functions may be in, the whole of them: what std::fesetround sets, FTZ and DAZ,
// exceptions that end the process.
#pragma once

#include <cfenv>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/hostile_state.h"

namespace rainref::test {

struct CallerState {
  std::string name;
  std::function<void()> set;
};

/// What a guard has to put back, as far as a test can see it.
struct SeenState {
  std::uint64_t control;
  int rounding, flags, traps;
  unsigned x87 = 0;
  bool operator==(const SeenState&) const = default;
};
inline SeenState seen_state() {
  SeenState s{floating_point_control(), std::fegetround(), std::fetestexcept(FE_ALL_EXCEPT), 0};
#if defined(__GLIBC__)
  s.traps = ::fegetexcept();
#endif
#if defined(__x86_64__)
  std::uint16_t x87;
  asm volatile("fnstcw %0" : "=m"(x87));
  s.x87 = x87;
#endif
  return s;
}

inline CallerState toward_zero() {
  return {"fesetround toward zero", [] { std::fesetround(FE_TOWARDZERO); }};
}

/// The three rounding modes, FTZ and DAZ, and exceptions that end the process, where a processor has these. One by one.
inline std::vector<CallerState> decisive_states() {
  std::vector<CallerState> all{
      toward_zero(), {"fesetround up", [] { std::fesetround(FE_UPWARD); }}, {"fesetround down", [] { std::fesetround(FE_DOWNWARD); }}};
  for (const HostileState& h : hostile_states()) {
    // Aarch64 has one bit for both; on x86 the two stand for the state with both.
    const bool is_alone = h.flushes_results != h.flushes_operands || hostile_states().front().flushes_operands;
    if (h.rounds_to_nearest && is_alone) all.push_back({h.name, [control = h.control] { set_floating_point_control(control); }});
  }
#if defined(__GLIBC__) && defined(__x86_64__)
  // Aarch64 processors need not have such exceptions, and most have not.
  all.push_back({"exceptions unmasked, rounding up", [] {
                   std::fesetround(FE_UPWARD);
                   ::feenableexcept(FE_ALL_EXCEPT);
                 }});
#endif
  return all;
}

/// Those and more, for calls that take no time.
inline std::vector<CallerState> caller_states() {
  std::vector<CallerState> all = decisive_states();
  for (const HostileState& h : hostile_states())
    all.push_back({std::string("control ") + h.name, [control = h.control] { set_floating_point_control(control); }});
  all.push_back({"flags that are raised", [] { std::feraiseexcept(FE_OVERFLOW | FE_DIVBYZERO); }});
  return all;
}

/// Makes a call in this state; whether the caller's state was the same after it, an exception included, which is thrown on.
class CalledIn {
 public:
  explicit CalledIn(const CallerState& state) : state_(state) {}
  void operator()(const std::function<void()>& call) {
    std::fenv_t own;
    std::fegetenv(&own);
    state_.set();
    const SeenState before = seen_state();
    std::exception_ptr thrown;
    try {
      call();
    } catch (...) {
      thrown = std::current_exception();
    }
    const SeenState after = seen_state();
    std::fesetenv(&own);
    set_floating_point_control(pinned_floating_point_control);
    kept_ = kept_ && after == before;
    if (thrown) std::rethrow_exception(thrown);
  }
  bool kept() const { return kept_; }

 private:
  const CallerState& state_;
  bool kept_ = true;
};

}  // namespace rainref::test
