// screen_drops.drops, corrected. The scene through the drops on the window: linear radiance, and where water is.
struct DropsUniforms {
  cells_per_pixel : vec4<f32>,  //   0  [cell/pixel] Of each layer.
  offset_x : vec4<f32>,         //  16  [cell] Place of the picture's corner in each layer.
  offset_y : vec4<f32>,         //  32  [cell] Place of the picture's corner in each layer.
  pixels_per_cell : vec4<f32>,  //  48  [pixel/cell] Of each layer.
  level : vec4<f32>,            //  64  [1] Mip level at which each layer's drops see the scene.
  first_row : vec4<i32>,        //  80  [texel] Row of cells where each layer begins.
  pixel : vec2<f32>,            //  96  [1] Extent of a pixel on the image plane at distance 1.
  half_size : vec2<f32>,        // 104  [1] Half the extent of the image plane at distance 1.
  scene_scale : vec2<f32>,      // 112  [1] Texture coordinates of the scene per unit of the image plane.
  sine : f32,                   // 120  [1] Of the contact angle.
  water_ior : f32,              // 124  [1] Refractive index of water.
  inner : f32,                  // 128  [1] Share of the background that the water's surface mirrors.
  has_flow : i32,               // 132  [1] 1: height counts.
  flow_slope : vec2<f32>,       // 136  [1/mm] Slope per difference of heights two texels apart.
  flow_pixel : vec2<f32>,       // 144  [1] 1 over the picture's columns and rows.
  visible_from : f32,           // 152  [mm] Height at which flowing water begins to show.
  visible_to : f32,             // 156  [mm] Height from which it shows fully.
  flow_level : f32,             // 160  [1] Mip level at which flowing water sees the scene.
  padding_0 : f32,              // 164  padding
  flow_texel : vec2<f32>,       // 168  [1] 1 over the columns and rows of height.
}
@group(0) @binding(0) var<uniform> u: DropsUniforms;
@group(0) @binding(1) var background: texture_2d<f32>;
@group(0) @binding(2) var scene: texture_2d<f32>;
@group(0) @binding(3) var cells: texture_2d<f32>;
@group(0) @binding(4) var height: texture_2d<f32>;
@group(0) @binding(18) var scene_sampler: sampler;
@group(0) @binding(20) var height_sampler: sampler;

struct Outputs {
  @location(0) water: vec4f,
  @location(1) colour: vec4f,
}

// Normal's x, y; coverage; mip level.
fn still_drops(at: vec2f) -> vec4f {
  var s = vec4f(0.0);
  for (var l = 3; l >= 0; l--) {
    let q = at * u.cells_per_pixel[l] + vec2f(u.offset_x[l], u.offset_y[l]);
    let last = vec2i(textureDimensions(cells)) - 1;
    let drop = textureLoad(cells, clamp(vec2i(floor(q)) + vec2i(0, u.first_row[l]), vec2i(0), last), 0);
    let d = fract(q) - drop.xy;
    let radius = drop.z;
    let pixels = u.pixels_per_cell[l];
    let cover = clamp((radius - length(d)) * pixels + 0.5, 0.0, 1.0) * min(2.0 * radius * pixels, 1.0);
    s = mix(s, vec4f(d * u.sine / max(radius, 1e-3), 1.0, u.level[l]), cover);
  }
  return s;
}
fn height_at(at: vec2f) -> f32 { return textureSampleLevel(height, height_sampler, at, 0.0).x; }
fn with_flow(s: vec4f, at: vec2f) -> vec4f {
  let place = at * u.flow_pixel;
  let dx = vec2f(u.flow_texel.x, 0.0);
  let dy = vec2f(0.0, u.flow_texel.y);
  let left = height_at(place - dx);
  let right = height_at(place + dx);
  let down = height_at(place - dy);
  let up = height_at(place + dy);
  let t = clamp((0.25 * (left + right + down + up) - u.visible_from) / (u.visible_to - u.visible_from), 0.0, 1.0);
  let cover = t * t * (3.0 - 2.0 * t);
  let slope = vec2f(right - left, up - down) * u.flow_slope;
  let inverse = inverseSqrt(1.0 + dot(slope, slope));
  return mix(s, vec4f(-slope * inverse, 1.0, u.flow_level), cover);
}

@fragment
fn main(@builtin(position) place: vec4f) -> Outputs {
  let pixel = vec2i(place.xy);
  let at = vec2f(pixel) + 0.5;
  let behind = textureLoad(background, pixel, 0).rgb;
  var s = still_drops(at);
  if (u.has_flow != 0) { s = with_flow(s, at); }
  if (s.z <= 0.0) { return Outputs(vec4f(s.z), vec4f(behind, 1.0)); }
  let ray = normalize(vec3f(at * u.pixel - u.half_size, 1.0));
  let normal = normalize(vec3f(s.xy, sqrt(max(1.0 - s.x * s.x - s.y * s.y, 0.04))));
  let bent = bend(bend(ray, vec3f(0.0, 0.0, -1.0), 1.0 / u.water_ior), -normal, u.water_ior);
  let reflected = fresnel(clamp(dot(bent, normal), 0.0, 1.0));
  let seen = 0.5 + bent.xy / max(bent.z, 0.05) * u.scene_scale;
  let light = mix(textureSampleLevel(scene, scene_sampler, seen, s.w).rgb, u.inner * behind, reflected);
  return Outputs(vec4f(s.z), vec4f(mix(behind, light, s.z), 1.0));
}
