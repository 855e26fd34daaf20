// What the windshield's passes take besides images: uniform blocks and the wiper record. Sizes are multiples of 16 bytes,
// nothing straddles a 16-byte row, and every gap is a named padding member, so the bytes serve every GPU language.
#pragma once

#include <cstdint>

namespace rainref::windshield {

/// One blade over a step. Plane coordinates are metres in the glass, from the corner (0, 0).
struct Wiper {
  float previous_inner[2], previous_outer[2];  ///< ends of the blade before the step (u, v)
  float inner[2], outer[2];                    ///< and after it
  float pivot[2];                              ///< plane [m]
  float inner_radius, outer_radius;            ///< of the blade's ends [m]
  float previous_axis[2], axis[2];             ///< cosine and sine of its angle in the plane, before and after
  float half_width;                            ///< [m]
  float rate;                                  ///< (angle - previous angle) / dt [rad/s]
  float direction;                             ///< sign of rate; 0 at rest
  float padding0;
};

static_assert(sizeof(Wiper) == 80);

}  // namespace rainref::windshield
