// rainy_glass.rain_on_glass, corrected. The scene seen through the wet glass: linear radiance.
@group(0) @binding(6) var scene_depth: texture_2d<f32>;
@group(0) @binding(7) var near_depth: texture_2d<f32>;
@group(0) @binding(8) var probe: texture_2d<f32>;
@group(0) @binding(23) var near_depth_sampler: sampler;
@group(0) @binding(24) var probe_sampler: sampler;

fn slope_of(stored: vec2f, neutral: f32, scale: f32) -> vec2f {
  let n = (stored - neutral) * scale;
  return -n / sqrt(max(1.0 - n.x * n.x - n.y * n.y, 0.04));
}

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let pixel = vec2i(place.xy);
  let own = vec4f(textureLoad(scene, pixel, 0).rgb, 1.0);
  let normal = textureLoad(orientation, pixel, 0);
  let glass = textureLoad(surface, pixel, 0).xyz;
  let depth = textureLoad(scene_depth, pixel, 0).x;
  if (normal.w <= 0.5 || depth <= glass.z) { return own; }

  let amount = u.rain_amount * clamp(dot(normal.xyz, u.rain_to), 0.0, 1.0);
  let drop = raindrops_at(glass.xy * u.drop_tiles);
  let timer = fract(u.drop_phase + drop.z);
  let threshold = max(1.0 - timer / u.impact, (timer - u.impact) / (1.0 - u.impact));
  let excess = drop.w - (1.0 - amount) - threshold;
  let shown = clamp(excess * u.sharpness, 0.0, 1.0);

  let base = glass.xy * u.rivulet_tiles;
  let flow = (rivulets_at(base).zw - u.rivulet_neutral) * u.rivulet_scale * vec2f(u.flow_strength, u.run_strength);
  let phase = flow_phases(u.flow_phase);
  let scrolled = base + vec2f(0.0, u.scroll);
  let first = rivulets_at(scrolled + flow * (phase.x - 0.5)).xy;
  let second = rivulets_at(scrolled + flow * (phase.y - 0.5)).xy;
  let streak = slope_of(mix(first, second, phase.z), u.rivulet_neutral, u.rivulet_scale);
  let steep = length(normal.xz);
  let slope = shown * slope_of(drop.xy, u.drop_neutral, u.drop_scale) + u.rivulet_amount * steep * streak;
  if (dot(slope, slope) <= 1e-8) { return own; }

  let along_u = vec3f(normal.z, 0.0, -normal.x) / max(length(normal.xz), 0.05);
  let along_v = cross(normal.xyz, along_u);
  let rise = slope.x * along_u + slope.y * along_v;
  let moved = u.bend * vec2f(dot(rise, u.right), dot(rise, u.up));
  let screen = (vec2f(pixel) + 0.5) * u.pixel;
  let half_size = vec2f(u.half_width, u.half_height);
  if (u.use_probe != 0) { return vec4f(probe_at((2.0 * screen - 1.0) * half_size + moved), 1.0); }
  let beyond = clamp(1.0 - glass.z / max(depth, 1e-3), 0.0, 1.0);
  let at = screen + moved * beyond * 0.5 / half_size;
  if (textureSampleLevel(near_depth, near_depth_sampler, at, 0.0).x <= glass.z) { return own; }
  return vec4f(scene_at(at), 1.0);
}
