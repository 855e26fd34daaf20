// puddle.display, corrected. Codes for a display.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

layout(std140, binding = 0) uniform DisplayUniforms {
  float vignette;  //   0  [1] Loss at distance 1 from the centre.
  float exposure;  //   4  [1] corrected: factor of the radiance.
  float width;     //   8  [pixel] Columns of the picture.
  float height;    //  12  [pixel] Rows of the picture.
} given;
layout(binding = 1) uniform sampler2D colour;
layout(binding = 2) uniform writeonly image2D picture;

// One channel, linear and in [0, 1], as a display takes it.
float code(float light) {
  if (light <= 0.0031308) return 12.92 * light;
  return 1.055 * pow(light, 1.0 / 2.4) - 0.055;
}

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = imageSize(picture);
  if (any(greaterThanEqual(here, size))) return;
  vec2 middle = (vec2(here) + 0.5) / vec2(size) - 0.5;
  float dark = given.vignette * length(middle);
  float gain = max(1.0 - dark, 0.0) * given.exposure;
  vec3 light = gain * texelFetch(colour, here, 0).rgb;
  light = clamp(light, vec3(0.0), vec3(1.0));
  imageStore(picture, here, vec4(code(light.r), code(light.g), code(light.b), 1.0));
}
