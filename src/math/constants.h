// Constants of mathematics and physics that several rooms use.
#pragma once

namespace rainref {

constexpr double pi = 0x1.921fb54442d18p+1;
constexpr double degree = pi / 180;  ///< [rad]
/// Standard gravity [m/s^2]: 3rd CGPM, 1901.
constexpr double standard_gravity = 9.80665;
/// Refractive index of water for visible light at 20 degrees Celsius.
constexpr double water_refractive_index = 1.333;

/// Reflectance of a smooth surface at normal incidence: ((1 - n) / (1 + n))^2.
constexpr float reflectance_straight_on(float refractive_index) {
  const float amplitude = (1.0f - refractive_index) / (1.0f + refractive_index);
  return amplitude * amplitude;
}

}  // namespace rainref
