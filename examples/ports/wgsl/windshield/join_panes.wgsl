// windshield.join_panes, as-published and corrected. The picture so far, and on a further pane what the eye sees through it.
@group(0) @binding(1) var pane_colour: texture_2d<f32>;
@group(0) @binding(2) var colour: texture_2d<f32>;

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let pixel = vec2i(place.xy);
  let before = textureLoad(colour, pixel, 0).rgb;
  let through = textureLoad(pane_colour, pixel, 0).rgb;
  return vec4f(mix(before, through, glass_point(pixel).on_glass), 1.0);
}
