// Uniform blocks of the windshield's passes, and the wiper record. Sizes are multiples of 16 bytes, no member crosses a 16-byte row, and
// every gap is a named padding member, so the bytes are valid in every GPU language.
#pragma once

#include <cstdint>

namespace rainref::windshield {

/// One blade over a step. Plane coordinates are metres in the glass, from the corner (0, 0).
struct Wiper {
  float previous_inner[2], previous_outer[2];
  float inner[2], outer[2];
  float pivot[2], inner_radius, outer_radius;
  float previous_axis[2], axis[2];
  float half_width, rate, direction, padding0;
};

/// A light that the water reflects.
struct Glint {
  float direction[3], padding0;
  float radiance[3], padding1;
};

/// A drop that falls behind the glass while the shutter is open. Positions in texels of the scene's picture: x of columns, y of rows.
struct Streak {
  float opened[2], closed[2];
  float radius, depth, opacity, padding0;
  float radiance[3], padding1;
};

struct CompositeUniforms {
  float u_row[3], glass_distance;
  float v_row[3], blur_lod;
  float w_row[3], wetness;
  float plane_x[3], visible_from;
  float plane_y[3], visible_to;
  float outward[3], refraction;
  float pixel[2], half_size[2];
  float scene_scale[2], shininess, glint_strength;
  float cabin[3];
  std::int32_t glint_count;
  float water_ior, inner, padding0, padding1;
};

static_assert(sizeof(Wiper) == 80 && sizeof(Glint) == 32 && sizeof(Streak) == 48 && sizeof(CompositeUniforms) == 160);

}  // namespace rainref::windshield
