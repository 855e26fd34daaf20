#include "base/floating_point.h"

#include <bit>

#if defined(__x86_64__) || defined(_M_X64)
#include <xmmintrin.h>
#endif

namespace rainref {

#if defined(__aarch64__)
std::uint64_t floating_point_control() {
  std::uint64_t bits;
  asm volatile("mrs %0, fpcr" : "=r"(bits));
  return bits;
}
void set_floating_point_control(std::uint64_t bits) { asm volatile("msr fpcr, %0" : : "r"(bits) : "memory"); }
#elif defined(__x86_64__) || defined(_M_X64)
// The low six bits are sticky exception flags, not control.
std::uint64_t floating_point_control() { return _mm_getcsr() & ~0x3fu; }
void set_floating_point_control(std::uint64_t bits) { _mm_setcsr(static_cast<unsigned>(bits)); }
#else
#error "rainref knows the floating-point control register of x86-64 and aarch64 only"
#endif

namespace {

// What a guard keeps, in 64 bits: the control register with its sticky flags, and of x86 the x87 unit's control and status words,
// which std::fesetround sets as well and by which the C library rounds when it reads and prints numbers.
#if defined(__aarch64__)
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
#else
constexpr std::uint16_t pinned_x87 = 0x37f;  // all six exceptions masked, 64 bits, to nearest: what a process starts with

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
  // A flag whose exception the caller wants as a signal would raise it at the next instruction of the unit.
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
    constexpr std::uint16_t flags = 0x80ff;  // with the summary of those that are unmasked
    asm volatile("fnstenv %0" : "=m"(environment));
    environment.control = control;
    environment.status = static_cast<std::uint16_t>((environment.status & ~flags) | (status & flags));
    asm volatile("fldenv %0" : : "m"(environment) : "memory");
  }
  _mm_setcsr(static_cast<unsigned>(state));
}
#endif

}  // namespace

FloatingPointGuard::FloatingPointGuard() : saved_(whole_state()) { pin(); }

// Always written back: the scope may have changed the state itself.
FloatingPointGuard::~FloatingPointGuard() { put_back(saved_); }

FloatingPointReport probe_floating_point() {
  // volatile keeps the compiler from folding, not from fusing: the products and sums below are ordinary expressions.
  volatile float va = 1.0f + 0x1p-12f, vc = -(1.0f + 0x1p-11f), smallest_normal = 0x1p-126f, half = 0.5f, subnormal = 0x1p-127f,
                 big = 0x1p20f, one = 1.0f, little = 0x1p-26f;
  FloatingPointReport report;
  const float a = va, c = vc;
  const float sum = a * a + c;  // exactly 2^-24 when fused, in every rounding; the product alone rounds to a multiple of 2^-23
  report.contracts = sum == 0x1p-24f;
  const float normal = smallest_normal;
  const float product = normal * half;
  // By its bits: with denormals-are-zero a comparison takes a subnormal for zero.
  report.flushes_results = std::bit_cast<std::uint32_t>(product) == 0;
  const float operand = subnormal;
  const float scaled = operand * big;
  report.flushes_operands = scaled == 0.0f;
  // Each direction but the nearest moves one of these away from 1.
  const float o = one, l = little;
  const float above = o + l, below = o - l;
  report.rounds_to_nearest = above == 1.0f && below == 1.0f;
  return report;
}

}  // namespace rainref
