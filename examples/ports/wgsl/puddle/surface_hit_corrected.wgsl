// puddle.surface_hit, corrected. Where each pixel's view ray meets the water, and the normal there.
@group(0) @binding(2) var bounds: texture_2d<f32>;
@group(0) @binding(18) var bounds_sampler: sampler;

fn height(place: vec2f) -> f32 {
  return u.height_scale * textureSampleLevel(wave, wave_sampler, place, 0.0).x + u.height_bias;
}

// Narrows `way`, from entry to exit, to where the ray lies between -half_side and half_side.
fn slab(origin: f32, direction: f32, half_side: f32, way: vec2f) -> vec2f {
  let inverse = 1.0 / select(direction, 1e-8, abs(direction) < 1e-8);
  let a = (-half_side - origin) * inverse;
  let b = (half_side - origin) * inverse;
  return vec2f(max(way.x, min(a, b)), min(way.y, max(a, b)));
}

@fragment
fn main(@builtin(position) place: vec4f) -> Outputs {
  let eye = u.camera_position;
  let ray = view_ray(vec2i(place.xy));
  if (-ray.y <= 1e-4) { return Outputs(vec4f(eye, 0.0), vec4f(0.0, 1.0, 0.0, 0.0)); }
  let fall = -ray.y;
  let run = length(ray.xz);
  let t_plane = eye.y / fall;
  let start = eye.xz * u.inverse_size + 0.5;
  let along = ray.xz * u.inverse_size;

  // Highest water and steepest slope that the ray can meet.
  let crossing = start + t_plane * along;
  let local = textureSampleLevel(bounds, bounds_sampler, crossing * u.bounds_scale, 0.0).xy;
  let holds = local.x * run <= u.bounds_reach * fall && all(crossing >= vec2f(0.0)) && all(crossing <= vec2f(1.0));
  let top = select(u.surface_top, local.x, holds);
  let slope = select(u.surface_slope, local.y, holds);

  var way = vec2f(0.0, min((eye.y + top) / fall, 1e4));
  way = slab(eye.x, ray.x, u.half_size.x, way);
  way = slab(eye.z, ray.z, u.half_size.z, way);
  let over_rectangle = way.x <= t_plane;
  let enter = max(way.x, (eye.y - top) / fall);
  let leave = way.y;
  let enters = enter < leave && over_rectangle;

  let climb = slope * run;
  let stride = 1.0 / (fall + climb);
  let back = 1.0 / max(climb - fall, 1e-4);
  let bold = 1.0 / (fall + 0.5 * climb);
  var t = select(t_plane, enter, enters);
  var gap = 0.0;
  var advance = 0.0;
  var steps = 0.0;
  if (enters) {
    for (var i = 0; i < u.max_steps; i++) {
      let next_t = t + advance;
      let next_gap = eye.y + next_t * ray.y - height(start + next_t * along);
      let safe = gap * stride;
      let proven = advance <= safe + max(next_gap, 0.0) * back;
      steps = f32(i);
      if (proven) {
        t = next_t;
        gap = next_gap;
        advance = next_gap * bold;
        if (next_gap < u.epsilon || next_t >= leave) { break; }
      } else {
        advance = safe;
      }
    }
  }

  let on_water = enters && t < leave;
  if (!on_water) { t = t_plane; }
  var normal = vec3f(0.0, 1.0, 0.0);
  if (on_water) {
    // The neighbours of the nearest place between texel centres: beyond the outermost ones clamp alone would not do.
    let at = clamp(start + t * along, 0.5 * u.texel, 1.0 - 0.5 * u.texel);
    let left = textureSampleLevel(wave, wave_sampler, at, 0.0, vec2i(-1, 0)).x;
    let right = textureSampleLevel(wave, wave_sampler, at, 0.0, vec2i(1, 0)).x;
    let down = textureSampleLevel(wave, wave_sampler, at, 0.0, vec2i(0, -1)).x;
    let up = textureSampleLevel(wave, wave_sampler, at, 0.0, vec2i(0, 1)).x;
    let gain = u.normal_gain * u.height_scale;
    let tilt = gain * vec2f(left - right, down - up);
    // One step of Newton's method, not along a flank and not where the ray entered under the water.
    let closing = fall - dot(tilt, ray.xz);
    let least = 0.5 * fall;
    if (gap < u.epsilon && gap >= 0.0 && closing >= least) { t += gap * min(1.0 / closing, 2.0 * stride); }
    normal = normalize(vec3f(tilt.x, 1.0, tilt.y));
  }
  return Outputs(vec4f(eye + t * ray, steps), vec4f(normal, 1.0));
}
