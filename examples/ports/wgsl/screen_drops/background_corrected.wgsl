// screen_drops.background, corrected. The scene out of focus, without water. Once, before frame 0.
struct Tap {
  x : f32,          //   0  [1] From the pixel's place, in texture coordinates of the scene.
  y : f32,          //   4  [1] See x.
  padding_0 : f32,  //   8  padding
  padding_1 : f32,  //  12  padding
}
@group(0) @binding(2) var<storage, read> taps: array<Tap>;

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let at = (floor(place.xy) + 0.5) * u.scale + u.offset;
  var sum = vec3f(0.0);
  for (var k = 0; k < u.tap_count; k++) {
    sum += textureSampleLevel(scene, scene_sampler, at + vec2f(taps[k].x, taps[k].y), u.level).rgb;
  }
  return vec4f(u.weight * sum, 1.0);
}
