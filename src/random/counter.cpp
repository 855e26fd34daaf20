#include "random/counter.h"

#include "math/constants.h"
#include "math/real64.h"

namespace rainref::random {

std::array<float, 2> in_disc(std::uint32_t u, std::uint32_t v) {
  const double radius = __builtin_sqrt(static_cast<double>(u >> 8) * 0x1p-24);
  const Real64 angle(static_cast<double>(v >> 8) * 0x1p-24 * (2 * pi));
  return {static_cast<float>(radius * cos_real(angle).v), static_cast<float>(radius * sin_real(angle).v)};
}

}  // namespace rainref::random
