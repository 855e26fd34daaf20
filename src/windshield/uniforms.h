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

/// A light that the water mirrors.
struct Glint {
  float direction[3];  ///< unit, toward it, in camera axes
  float padding0;
  float radiance[3];
  float padding1;
};

/// A drop that falls behind the glass while the shutter is open. Places in texels of the scene's picture: x of columns, y of rows.
struct Streak {
  float opened[2], closed[2];  ///< its middle when the shutter opens and when it closes
  float radius;                ///< half its width, at least half a texel
  float depth;                 ///< along the view axis [m]
  float opacity;               ///< share of the exposure and of the width in which it covers a point of its way
  float padding0;
  float radiance[3];  ///< linear RGB
  float padding1;
};

struct CompositeUniforms {
  float u_row[3];        ///< u = u_row . (x, y, 1) / w_row . (x, y, 1) at pixel centre (x, y)
  float glass_distance;  ///< along the view axis: glass_distance / w_row . (x, y, 1) [m]
  float v_row[3];
  float blur_lod;  ///< mip level of the picture behind the film
  float w_row[3];
  float wetness;       ///< weight of the blurred picture where the glass was not wiped
  float plane_x[3];    ///< axes of the glass in camera axes: right, up, forward
  float visible_from;  ///< height at which water begins to show as a drop [mm]
  float plane_y[3];
  float visible_to;  ///< height from which it shows fully [mm]
  float outward[3];
  float refraction;      ///< as-published: screen widths and heights per unit of n.xy
  float pixel[2];        ///< extent of a pixel on the image plane at distance 1
  float half_size[2];    ///< of the image plane at distance 1
  float scene_scale[2];  ///< texture coordinates of the scene per unit of the image plane
  float shininess;
  float glint_strength;
  float cabin[3];  ///< radiance beside the glass
  std::int32_t glint_count;
  float water_ior;  ///< corrected
  float inner;      ///< corrected: share of the blurred scene that the water's surface mirrors
  float padding0, padding1;
};

static_assert(sizeof(Wiper) == 80 && sizeof(Glint) == 32 && sizeof(Streak) == 48 && sizeof(CompositeUniforms) == 160);

}  // namespace rainref::windshield
