// screen_drops.background, as-published. The scene out of focus, without water. Once, before frame 0.
@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let at = (floor(place.xy) + 0.5) / u.resolution;
  return vec4f(textureSampleLevel(scene, scene_sampler, at, u.level).rgb, 1.0);
}
