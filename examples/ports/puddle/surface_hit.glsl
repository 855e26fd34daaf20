// Uniforms and outputs of both versions of surface_hit.
layout(std140, binding = 0) uniform SurfaceHitUniforms {
  vec3 camera_position;       //   0  [m] Eye.
  float camera_pixel_scale;   //  12  [1] Height of a pixel on the image plane at distance 1.
  vec3 camera_right;          //  16  [1] Unit vector to the right of the picture.
  float camera_plane_left;    //  28  [1] Left edge of the image plane at distance 1.
  vec3 camera_up;             //  32  [1] Unit vector to the top of the picture.
  float camera_plane_bottom;  //  44  [1] Bottom edge of the image plane at distance 1.
  vec3 camera_forward;        //  48  [1] Unit vector into the picture.
  float padding_0;            //  60  padding
  vec3 half_size;             //  64  [m] Half the puddle's extent.
  float epsilon;              //  76  [m] Distance that counts as a hit.
  vec2 texel;                 //  80  [1] 1 over the wave's columns and rows.
  int max_steps;              //  88  [1] Most steps of the march.
  float normal_gain;          //  92  [1] Factor from a height difference to a slope.
  float height_scale;         //  96  [m] corrected: height = scale * stored + bias.
  float height_bias;          // 100  [m] corrected: see height_scale.
  float surface_top;          // 104  [m] corrected: no height lies above this, or below its negative.
  float surface_slope;        // 108  [1] corrected: no slope of the surface is above this.
  vec2 inverse_size;          // 112  [1/m] corrected: 1 over the puddle's extent in x and z.
  vec2 bounds_scale;          // 120  [1] corrected: texture coordinates of bounds to one of the water.
  float bounds_reach;         // 128  [m] corrected: a texel of bounds holds this far around its points.
  float padding_1;            // 132  padding
  float padding_2;            // 136  padding
  float padding_3;            // 140  padding
} u;
layout(binding = 1) uniform sampler2D wave;

// Filters need not be precise: a device may blend 8-bit storage in 8 bits. With this the shader blends texels itself.
layout(constant_id = 3) const bool BLEND_IN_SHADER = false;
layout(constant_id = 1) const int ADDRESS = CLAMP;

ivec2 hold(ivec2 texel, ivec2 size) {
  return ADDRESS == REPEAT ? texel - size * ivec2(floor(vec2(texel) / vec2(size))) : clamp(texel, ivec2(0), size - 1);
}
vec2 blend_wave(vec2 place, ivec2 offset) {
  ivec2 size = textureSize(wave, 0);
  vec2 x = (ADDRESS == REPEAT ? fract(place) : place) * vec2(size) - 0.5;
  if (ADDRESS != REPEAT) x = clamp(x, vec2(0.0), vec2(size) - 1.0);
  vec2 low = floor(x), f = x - low;
  ivec2 a = hold(ivec2(low) + offset, size), b = hold(ivec2(low) + offset + 1, size);
  vec2 bottom = mix(texelFetch(wave, a, 0).xy, texelFetch(wave, ivec2(b.x, a.y), 0).xy, f.x);
  vec2 top = mix(texelFetch(wave, ivec2(a.x, b.y), 0).xy, texelFetch(wave, b, 0).xy, f.x);
  return mix(bottom, top, f.y);
}
#define WAVE(place, offset) (BLEND_IN_SHADER ? blend_wave(place, offset) : textureLodOffset(wave, place, 0.0, offset).xy)
