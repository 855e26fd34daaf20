#include <xmmintrin.h>

#include "base/floating_point.h"
#include "base/floating_point_unit.h"

namespace rainref {

// All six exceptions masked, to nearest, no flush to zero, no denormals-are-zero.
const std::uint64_t pinned_floating_point_control = 0x1f80;

// The low six bits are sticky exception flags, not control.
std::uint64_t floating_point_control() { return _mm_getcsr() & ~0x3fu; }
void set_floating_point_control(std::uint64_t bits) { _mm_setcsr(static_cast<unsigned>(bits)); }

namespace floating_point_unit {

// A guard saves MXCSR and the control and status words of the x87 unit, which std::fesetround also sets and which the C library uses to
// round when it reads and prints numbers.
constexpr std::uint16_t pinned_x87 = 0x37f;  // all six exceptions masked, 64 bits, to nearest: the initial state of a process

std::uint64_t whole_state() {
  std::uint16_t control, status;
  asm volatile("fnstcw %0\n\tfnstsw %1" : "=m"(control), "=am"(status));
  return _mm_getcsr() | static_cast<std::uint64_t>(control) << 32 | static_cast<std::uint64_t>(status) << 48;
}
void pin() {
  if (floating_point_control() != pinned_floating_point_control) set_floating_point_control(pinned_floating_point_control);
  std::uint16_t control;
  asm volatile("fnstcw %0" : "=m"(control));
  if (control == pinned_x87) return;
  // Clears the flags first: a flag whose exception the caller has unmasked would raise a signal at the next x87 instruction.
  asm volatile("fnclex\n\tfldcw %0" : : "m"(pinned_x87) : "memory");
}
void put_back(std::uint64_t state) {
  const auto control = static_cast<std::uint16_t>(state >> 32), status = static_cast<std::uint16_t>(state >> 48);
  std::uint16_t now;
  asm volatile("fnstcw %0" : "=m"(now));
  if (now != control || control != pinned_x87) {
    struct {
      std::uint16_t control, unused0, status, unused1;
      std::uint32_t rest[5];
    } environment;
    constexpr std::uint16_t flags = 0x80ff;  // with the summary of the unmasked ones
    asm volatile("fnstenv %0" : "=m"(environment));
    environment.control = control;
    environment.status = static_cast<std::uint16_t>((environment.status & ~flags) | (status & flags));
    asm volatile("fldenv %0" : : "m"(environment) : "memory");
  }
  _mm_setcsr(static_cast<unsigned>(state));
}

}  // namespace floating_point_unit
}  // namespace rainref
