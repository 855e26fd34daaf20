// edge_splash.splash, corrected. Masks of edge, angle and noise, and the scene with drops blended over it.
struct SplashUniforms {
  drop_color : vec4<f32>,    //   0  [1] Linear RGB and opacity of the drops.
  up : vec3<f32>,            //  16  [1] Unit vector that points up, camera axes: right, up, forward.
  reach : f32,               //  28  [texel] Texels that the band covers at 1 m.
  pixel : vec2<f32>,         //  32  [1] Extent of a pixel on the image plane at distance 1.
  half_size : vec2<f32>,     //  40  [1] Half the extent of the image plane at distance 1.
  depth_scale : f32,         //  48  [1/m] 1 / z = depth_scale d + depth_bias.
  depth_bias : f32,          //  52  [1/m] See depth_scale.
  reach_min : f32,           //  56  [texel] Smallest reach of the taps.
  reach_max : f32,           //  60  [texel] Largest reach of the taps; whole.
  step_low : f32,            //  64  [m] Sobel sum of distances at which an edge begins.
  step_high : f32,           //  68  [m] Sobel sum from which it is whole.
  bend_low : f32,            //  72  [1] Bend at which an edge begins.
  bend_high : f32,           //  76  [1] Bend from which it is whole.
  cosine_low : f32,          //  80  [1] Cosine between an edge's normal and up at which the mask begins.
  cosine_high : f32,         //  84  [1] Cosine from which it is whole.
  noise_low : f32,           //  88  [1] Noise at which a drop begins.
  noise_high : f32,          //  92  [1] Noise from which it is whole.
  noise_scale : vec2<f32>,   //  96  [1] Texture coordinates of the noise in a pixel.
  noise_offset : vec2<f32>,  // 104  [1] Texture coordinates that the noise has scrolled, in [0, 1).
}
@group(0) @binding(0) var<uniform> u: SplashUniforms;
@group(0) @binding(4) var layer: texture_2d<f32>;
@group(0) @binding(19) var noise_sampler: sampler;

fn inverse_distance(at: vec2i) -> f32 {
  let last = vec2i(textureDimensions(depth)) - 1;
  return textureLoad(depth, clamp(at, vec2i(0), last), 0).r * u.depth_scale + u.depth_bias;
}
fn ramp(low: f32, high: f32, x: f32) -> f32 {
  let t = clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

@fragment
fn main(@builtin(position) place: vec4f) -> Outputs {
  let pixel = vec2i(place.xy);
  let widest = i32(u.reach_max);
  let q = inverse_distance(pixel);
  let across = max(inverse_distance(pixel - vec2i(widest, 0)), inverse_distance(pixel + vec2i(widest, 0)));
  let along = max(inverse_distance(pixel - vec2i(0, widest)), inverse_distance(pixel + vec2i(0, widest)));
  let nearest = max(q, max(across, along));
  let wanted = u.reach * nearest;
  let r = i32(floor(clamp(wanted, u.reach_min, u.reach_max) + 0.5));

  var near: array<f32, 9>;
  var z: array<f32, 9>;
  for (var j = 0; j < 3; j++) {
    for (var i = 0; i < 3; i++) {
      near[3 * j + i] = inverse_distance(pixel + r * vec2i(i - 1, j - 1));
      z[3 * j + i] = 1.0 / near[3 * j + i];
    }
  }
  let g = vec2f(z[2] - z[0] + 2.0 * (z[5] - z[3]) + z[8] - z[6], z[6] - z[0] + 2.0 * (z[7] - z[1]) + z[8] - z[2]);
  let bend = max(abs(near[3] + near[5] - 2.0 * near[4]), abs(near[1] + near[7] - 2.0 * near[4])) /
             max(max(near[4], max(near[3], near[5])), max(near[1], near[7]));
  var edge = ramp(u.step_low, u.step_high, length(g));
  edge *= ramp(u.bend_low, u.bend_high, bend);

  let on_plane = (vec2f(pixel) + 0.5) * u.pixel - u.half_size;
  let up = u.up.xy - on_plane * u.up.z;
  let facing = dot(g, up) / max(length(g), u.step_low) / max(length(up), 1e-4);
  let angle = ramp(u.cosine_low, u.cosine_high, facing);

  let at = (vec2f(pixel) + 0.5) * u.noise_scale + u.noise_offset;
  let noise = ramp(u.noise_low, u.noise_high, textureSampleLevel(noise_map, noise_sampler, at, 0.0).r);

  let below = textureLoad(scene, pixel, 0);
  let weight = edge * angle * noise * textureLoad(layer, pixel, 0).r * u.drop_color.a;
  let result = mix(below.rgb, u.drop_color.rgb, weight);
  return Outputs(vec4f(edge), vec4f(angle), vec4f(noise), vec4f(result, below.a));
}
