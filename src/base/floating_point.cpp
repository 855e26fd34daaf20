#include "base/floating_point.h"

#include <bit>

#include "base/floating_point_unit.h"

namespace rainref {

FloatingPointGuard::FloatingPointGuard() : saved_(floating_point_unit::whole_state()) { floating_point_unit::pin(); }

// Always written back: the scope may have changed the state itself.
FloatingPointGuard::~FloatingPointGuard() { floating_point_unit::put_back(saved_); }

FloatingPointReport probe_floating_point() {
  // Always restored, because the scope may have changed the state itself.
  volatile float va = 1.0f + 0x1p-12f, vc = -(1.0f + 0x1p-11f), smallest_normal = 0x1p-126f, half = 0.5f, subnormal = 0x1p-127f,
                 big = 0x1p20f, one = 1.0f, little = 0x1p-26f;
  FloatingPointReport report;
  const float a = va, c = vc;
  const float sum = a * a + c;  // exactly 2^-24 when fused, in every rounding; the product alone rounds to a multiple of 2^-23
  report.contracts = sum == 0x1p-24f;
  const float normal = smallest_normal;
  const float product = normal * half;
  // Compared by bits: with denormals-are-zero a comparison treats a subnormal as zero.
  report.flushes_results = std::bit_cast<std::uint32_t>(product) == 0;
  const float operand = subnormal;
  const float scaled = operand * big;
  report.flushes_operands = scaled == 0.0f;
  // Each rounding direction except nearest moves one of these away from 1.
  const float o = one, l = little;
  const float above = o + l, below = o - l;
  report.rounds_to_nearest = above == 1.0f && below == 1.0f;
  return report;
}

}  // namespace rainref
