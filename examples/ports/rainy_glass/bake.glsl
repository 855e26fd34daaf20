// What both bakes share.
vec2 texel_centre(ivec2 texel) { return (vec2(texel) + 0.5) * u.inverse_size; }
// The short way round the tile.
float around(float difference) { return difference - floor(difference + 0.5); }
vec2 stored_normal(vec2 gradient) {
  vec2 slope = u.normal_scale * gradient;
  float inverse = inversesqrt(1.0 + dot(slope, slope));
  return u.neutral - u.span * slope * inverse;
}
