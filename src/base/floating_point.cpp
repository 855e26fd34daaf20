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

FloatingPointGuard::FloatingPointGuard() : saved_(floating_point_control()) {
  if (saved_ != pinned_floating_point_control) set_floating_point_control(pinned_floating_point_control);
}

// Always written back: the scope may have changed the state itself.
FloatingPointGuard::~FloatingPointGuard() { set_floating_point_control(saved_); }

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
