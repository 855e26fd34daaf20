// puddle.display, as-published. Vignette and display code.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "display.glsl"

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(picture))) return;
  vec3 radiance = texelFetch(colour, pixel, 0).rgb;
  float light = vignette(pixel);
  vec3 code = pow(light * radiance, vec3(0.4545));
  imageStore(picture, pixel, vec4(code, 1.0));
}
