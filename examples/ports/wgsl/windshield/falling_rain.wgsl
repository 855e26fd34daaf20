// windshield.falling_rain, as-published and corrected. Streaks of the rain behind the glass over the fogged scene, in their order.
struct FallingRainUniforms {
  streak_count : i32,  //   0  [1] Streaks in the list.
  sharpness : f32,     //   4  [1/m] 1 over the depth in which what stands in the street hides a streak.
  padding_0 : f32,     //   8  padding
  padding_1 : f32,     //  12  padding
}
@group(0) @binding(0) var<uniform> u: FallingRainUniforms;
struct Streak {
  opened : vec2<f32>,    //   0  [texel] Its middle when the shutter opens: column and row of the scene's picture.
  closed : vec2<f32>,    //   8  [texel] The same when it closes.
  radius : f32,          //  16  [texel] Half its width, at least half a texel.
  depth : f32,           //  20  [m] Along the view axis.
  opacity : f32,         //  24  [1] Share of the exposure and of the width in which it covers a point of its way.
  padding_0 : f32,       //  28  padding
  radiance : vec3<f32>,  //  32  [1] Linear RGB.
  padding_1 : f32,       //  44  padding
}
@group(0) @binding(1) var blurred: texture_2d<f32>;
@group(0) @binding(2) var scene_depth: texture_2d<f32>;
@group(0) @binding(3) var<storage, read> streaks: array<Streak>;

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let texel = vec2i(place.xy);
  let centre = vec2f(texel) + 0.5;
  let depth = textureLoad(scene_depth, texel, 0).x;
  var colour = textureLoad(blurred, texel, 0).rgb;
  for (var i = 0; i < u.streak_count; i++) {
    let s = streaks[i];
    let covered = clamp(0.5 + (s.radius - segment_distance(centre, s.opened, s.closed)), 0.0, 1.0);
    let before = clamp((depth - s.depth) * u.sharpness, 0.0, 1.0);
    colour = mix(colour, s.radiance, s.opacity * covered * before);
  }
  return vec4f(colour, 1.0);
}
