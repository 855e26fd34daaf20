// rainy_glass.rain_on_glass, as-published. The scene seen through the wet glass: linear radiance.
@group(0) @binding(6) var probe: texture_2d<f32>;
@group(0) @binding(22) var probe_sampler: sampler;

// A place on a map that is turned by this cosine and sine.
fn turned(place: vec2f, turn: vec2f) -> vec2f {
  return vec2f(place.x * turn.x - place.y * turn.y, place.x * turn.y + place.y * turn.x);
}

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let pixel = vec2i(place.xy);
  let normal = textureLoad(orientation, pixel, 0);
  if (normal.w <= 0.5) { return vec4f(textureLoad(scene, pixel, 0).rgb, 1.0); }
  let glass = textureLoad(surface, pixel, 0).xy;
  let drop = raindrops_at(turned(glass, u.turn) * u.drop_tiles);
  let time_offset = select(drop.z, 2.0 * drop.z - 1.0, u.signed_offset != 0);
  let timer = fract(u.time * u.drop_rate + time_offset);
  let eroded = drop.w - (1.0 - u.rain_amount) - timer;
  let mask = select(0.0, 1.0, eroded > 0.0);

  let base = turned(glass, u.rivulet_turn) * u.rivulet_tiles + vec2f(0.0, u.scroll);
  let flow = u.flow_from + u.flow_span * rivulets_at(base).zw;
  let phase = flow_phases(u.time * u.flow_rate);
  let weight = select(phase.z, phase.z * phase.z, u.squared_weight != 0);
  let first = rivulets_at(base + u.flow_strength * phase.x * flow).xy;
  let second = rivulets_at(base + u.flow_strength * phase.y * flow).xy;
  let streak = mix(first, second, weight);
  let upright = u.rivulet_amount * min((1.0 - abs(normal.y)) * u.fade_rate, 1.0);
  let sum = mask * drop.xy + upright * streak;
  let each = mask * (2.0 * drop.xy - 1.0) + upright * (2.0 * streak - 1.0);
  let offset = u.distortion * select(2.0 * sum - 1.0, each, u.remap_first != 0);
  let screen = (vec2f(pixel) + 0.5) * u.pixel + offset;
  if (u.use_probe != 0) { return vec4f(u.tint * probe_at((2.0 * screen - 1.0) * vec2f(u.half_width, u.half_height)), 1.0); }
  return vec4f(u.tint * scene_at(screen), 1.0);
}
