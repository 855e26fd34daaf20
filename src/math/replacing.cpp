#include <array>
#include <cmath>

#include <fmt/format.h>

#include "math/constants.h"
#include "math/perturbed.h"

namespace rainref::perturbed {

Behaviour replacing(float constant, float by) {
  Behaviour b;
  b.fault = Fault::constant;
  b.constant = constant;
  b.replacement = by;
  constexpr std::array made_of{
      +[](float n) { return 1 / n; },
      +[](float n) { return n * n; },
      +[](float n) { return 1 / (n * n); },
      +[](float n) { return reflectance_straight_on(n); },
      +[](float n) { return 1 - reflectance_straight_on(n); },
  };
  const auto digits = [](float x) { return fmt::format("{}", x).size(); };
  for (std::size_t k = 0; k < made_of.size(); ++k)
    if (const float made = made_of[k](constant); std::isfinite(made) && digits(made) > digits(constant) + 2)
      b.derived[k] = {made, made_of[k](by)};
  return b;
}

}  // namespace rainref::perturbed
