// A pinhole camera, and its basis, which a pass takes as uniforms.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace rainref::scene {

/// Packed, and GLM_FORCE_PURE is set for every file: sums run from x to z, and nothing is fused or estimated.
using Vector3 = glm::dvec3;

/// Pinhole camera in the effect's world (right-handed, y up, metres unless the effect says otherwise).
struct Camera {
  Vector3 position{0, 0, 0};
  Vector3 target{0, 0, -1};
  Vector3 up{0, 1, 0};
  double vertical_fov_deg = 60;

  struct Basis {
    Vector3 right, up, forward;  ///< orthonormal; right = forward x up
  };
  /// The basis, computed in double. Throws Error(usage) if position and target coincide or `up` is parallel to the view.
  Basis basis() const;
  /// Half the height of the image plane at distance 1: tan(fov / 2), within 1e-15 relative. Throws Error(usage) unless
  /// the field of view is above 0 and below 180 degrees.
  double half_height() const;
  /// Adds the camera to a cache::Recipe.
  template <class Recipe>
  void add_to(Recipe& recipe) const {
    for (const Vector3* v : {&position, &target, &up}) recipe.add_read(*v);
    recipe.add_read(vertical_fov_deg);
  }
};

/// a / |a|, each component by one division (glm::normalize multiplies by a rounded reciprocal); a must not be zero.
Vector3 normalized(const Vector3& a);

}  // namespace rainref::scene
