// Display code of linear light in [0, 1].
fn encode_srgb(linear: vec3f) -> vec3f {
  let curve = 1.055 * pow(max(linear, vec3f(0.0031308)), vec3f(1.0 / 2.4)) - 0.055;
  return select(curve, 12.92 * linear, linear <= vec3f(0.0031308));
}
