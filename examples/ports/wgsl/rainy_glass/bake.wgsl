// What both bakes share.
fn texel_centre(texel: vec2i) -> vec2f { return (vec2f(texel) + 0.5) * u.inverse_size; }
// The short way round the tile.
fn around(difference: f32) -> f32 { return difference - floor(difference + 0.5); }
fn stored_normal(gradient: vec2f) -> vec2f {
  let slope = u.normal_scale * gradient;
  let inverse = inverseSqrt(1.0 + dot(slope, slope));
  return u.neutral - u.span * slope * inverse;
}
