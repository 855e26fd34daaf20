// rainy_glass.rain_on_glass, as-published. The scene seen through the wet glass: linear radiance.
@group(0) @binding(6) var probe: texture_2d<f32>;
@group(0) @binding(22) var probe_sampler: sampler;

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let pixel = vec2i(place.xy);
  let normal = textureLoad(orientation, pixel, 0);
  if (normal.w <= 0.5) { return vec4f(textureLoad(scene, pixel, 0).rgb, 1.0); }
  let glass = textureLoad(surface, pixel, 0).xy;
  let drop = raindrops_at(glass * u.drop_tiles);
  let timer = fract(u.time * u.drop_rate + drop.z);
  let eroded = drop.w - (1.0 - u.rain_amount) - timer;
  let mask = select(0.0, 1.0, eroded > 0.0);

  let base = glass * u.rivulet_tiles;
  let flow = rivulets_at(base).zw;
  let phase = flow_phases(u.time * u.flow_rate);
  let first = rivulets_at(base + u.flow_strength * phase.x * flow).xy;
  let second = rivulets_at(base + u.flow_strength * phase.y * flow).xy;
  let streak = mix(first, second, phase.z);
  let upright = 1.0 - abs(normal.y);
  let sum = mask * drop.xy + upright * streak;
  let offset = u.distortion * (2.0 * sum - 1.0);
  let screen = (vec2f(pixel) + 0.5) * u.pixel + offset;
  if (u.use_probe != 0) { return vec4f(probe_at((2.0 * screen - 1.0) * vec2f(u.half_width, u.half_height)), 1.0); }
  return vec4f(scene_at(screen), 1.0);
}
