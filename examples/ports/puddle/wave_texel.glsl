// A texel of the wave by the address rule of its boundary; (newest, previous).
vec2 wave_texel(ivec2 texel) {
  ivec2 size = textureSize(wave, 0);
  // Not by %: GLSL leaves it undefined for negative operands, and GPUs differ.
  if (ADDRESS == REPEAT) texel -= size * ivec2(floor(vec2(texel) / vec2(size)));
  if (ADDRESS == BORDER && (any(lessThan(texel, ivec2(0))) || outside(texel, size))) return vec2(u.rest);
  return texelFetch(wave, clamp(texel, ivec2(0), size - 1), 0).xy;
}
