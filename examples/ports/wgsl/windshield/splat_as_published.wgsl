// windshield.splat, as-published. The height of the water: every live drop, in slot order.
fn neck_of(id: u32) -> Neck { return no_neck(id); }

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  return vec4f(blended(vec2i(place.xy)), 0.0, 0.0, 0.0);
}
