#include "base/floating_point.h"
#include "base/floating_point_unit.h"

namespace rainref {

const std::uint64_t pinned_floating_point_control = 0;

std::uint64_t floating_point_control() {
  std::uint64_t bits;
  asm volatile("mrs %0, fpcr" : "=r"(bits));
  return bits;
}
void set_floating_point_control(std::uint64_t bits) { asm volatile("msr fpcr, %0" : : "r"(bits) : "memory"); }

namespace floating_point_unit {

std::uint64_t whole_state() {
  std::uint64_t flags;
  asm volatile("mrs %0, fpsr" : "=r"(flags));
  return floating_point_control() | flags << 32;
}
void pin() {
  if (floating_point_control() != pinned_floating_point_control) set_floating_point_control(pinned_floating_point_control);
}
void put_back(std::uint64_t state) {
  const std::uint64_t flags = state >> 32;
  asm volatile("msr fpsr, %0" : : "r"(flags) : "memory");
  set_floating_point_control(state & 0xffffffff);
}

}  // namespace floating_point_unit
}  // namespace rainref
