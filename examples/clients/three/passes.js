// The puddle's wave_step and display (corrected) in GLSL ES 3.00. three.js puts its own lines before these. It has no uniform blocks in
// the way of a pack, so the members are uniforms of their own, as `rainref describe puddle --layout gdshader` lists them.
const waveStep = `
precision highp float; precision highp int; precision highp sampler2D; precision highp usampler2D;
struct Drop { float x, y, amplitude, radius; };
uniform float damping, courant_sq, rest, rim_damping, rim_inverse;
uniform int drop_count;
uniform vec2 size;
uniform sampler2D wave;
uniform usampler2D drops;
layout(location = 0) out vec4 wave_out;
Drop drops_at(int i) {
  uvec4 t = texelFetch(drops, ivec2(0, i), 0);
  return Drop(uintBitsToFloat(t.x), uintBitsToFloat(t.y), uintBitsToFloat(t.z), uintBitsToFloat(t.w));
}
// A texel of the wave; beyond its border, which WebGL has no address mode for, the water is level.
vec2 wave_texel(ivec2 at) {
  ivec2 whole = textureSize(wave, 0);
  if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, whole))) return vec2(rest);
  return texelFetch(wave, at, 0).xy;
}
float crater(Drop drop, vec2 here) {
  vec2 scaled = (here - vec2(drop.x, drop.y)) * (1.0 / drop.radius);
  float q2 = dot(scaled, scaled), rim = max(1.0 - q2, 0.0);
  return drop.amplitude * (rim * rim * (1.0 - 4.0 * q2));
}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec2 stored = wave_texel(at), here = vec2(at) + 0.5;
  float newest = stored.x, previous = stored.y, rim = 1.0, craters = 0.0;
  float around = wave_texel(at - ivec2(1, 0)).x + wave_texel(at + ivec2(1, 0)).x + wave_texel(at - ivec2(0, 1)).x + wave_texel(at + ivec2(0, 1)).x;
  if (rim_damping > 0.0) {
    vec2 edge = min(here, size - here);
    float depth = max(1.0 - rim_inverse * min(edge.x, edge.y), 0.0);
    rim = 1.0 - rim_damping * (depth * depth);
    previous = rest + rim * (previous - rest);
  }
  for (int i = 0; i < drop_count; ++i) craters += crater(drops_at(i), here);
  float level = newest + damping * (newest - previous) + courant_sq * (around - 4.0 * newest) + craters;
  if (rim_damping > 0.0) level = rest + rim * (level - rest);
  wave_out = vec4(level, newest + craters, 0.0, 0.0);
}`;
const display = `
precision highp float; precision highp int; precision highp sampler2D;
uniform float vignette, exposure, width, height;
uniform sampler2D colour;
layout(location = 0) out vec4 picture;
vec3 encode_srgb(vec3 linear) {
  vec3 curve = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
  return mix(curve, 12.92 * linear, vec3(lessThanEqual(linear, vec3(0.0031308))));
}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec2 offset = (vec2(at) + 0.5) / vec2(width, height) - 0.5;
  float light = max(1.0 - vignette * length(offset), 0.0) * exposure;
  picture = vec4(encode_srgb(clamp(light * texelFetch(colour, at, 0).rgb, 0.0, 1.0)), 1.0);
}`;

/// Of each pass: its shader, and a function that reads its uniforms from the block.
export const passes = {
  wave_step: {shader: waveStep, uniforms: block => ({
    damping: block.getFloat32(0, true), courant_sq: block.getFloat32(8, true), drop_count: block.getInt32(12, true), rest: block.getFloat32(16, true),
    rim_damping: block.getFloat32(20, true), rim_inverse: block.getFloat32(24, true), size: [block.getFloat32(32, true), block.getFloat32(36, true)],
  })},
  display: {shader: display, uniforms: block => ({
    vignette: block.getFloat32(0, true), exposure: block.getFloat32(4, true), width: block.getFloat32(8, true), height: block.getFloat32(12, true),
  })},
};
