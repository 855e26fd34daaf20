// The puddle's ground as an opaque surface, above and under the water.
#pragma once

#include "compositor/heightfield.h"
#include "compositor/scene.h"
#include "image/texture.h"
#include "puddle/uniforms.h"
#include "truth/tracer_names.h"

namespace rainref::truth {

/// Inputs of the ground's finish, from shade.
struct GroundLook {
  puddle::ShadeUniforms uniforms;  ///< of shade, corrected
  const Texture* ground;           ///< tile with mips, linear albedo
  const Texture* relief;           ///< slopes of the tile with mips
  double water_ior;
  double sample_scale = 1;  ///< side of a sample relative to the side of a pixel
};

/// Diffuse ground under ambient light, seen through the water above it by Beer's law. Out of the water it has a film that reflects with the
/// relief's normals, blurred, and thickens over the last shore_width metres above the water.
class PuddleGround : public Opaque {
 public:
  /// `sheet` gives the slopes of the bed; null if it is level. Textures and sheet must outlive this.
  PuddleGround(const GroundLook& look, const Heightfield* sheet) : look_(look), sheet_(sheet) {}
  void finish(const Places& places, const Finishes& finishes) const override;

 private:
  GroundLook look_;
  const Heightfield* sheet_;
};

/// PuddleGround::finish. `slopes` are the normals of the ground under the places; null if it is level. Arrays are padded to whole lanes.
void finish_ground(const GroundLook& look, const Places& places, const VecArrays* slopes, const Finishes& finishes);

}  // namespace rainref::truth
