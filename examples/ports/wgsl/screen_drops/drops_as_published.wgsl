// screen_drops.drops, as-published. The scene through the drops on the window: linear radiance, and where water is.
struct PublishedDropsUniforms {
  resolution : vec2<f32>,  //   0  [pixel] Columns and rows of the picture.
  time : f32,              //   8  [s] Frame number over frame rate, rounded once.
  grid : f32,              //  12  [cell/pixel] Cells of layer 1 in a pixel.
  keep : f32,              //  16  [1] Times keep_from - layer: the noise below which a cell holds a drop.
  refraction : f32,        //  20  [1] Pictures per unit of the normal.
  printed_misprint : i32,  //  24  [1] 1: the displacement as the report prints it.
  noise_nearest : i32,     //  28  [1] 1: noise is looked up unfiltered, texel floor(fract(u) size).
  layers : i32,            //  32  [1] Grids of cells.
  water_step : f32,        //  36  [1] 1 over layers.
  cell_angle : f32,        //  40  [rad] Of the sine over a cell.
  noise_middle : f32,      //  44  [1] Noise that displaces nothing.
  displacement : f32,      //  48  [rad] Of the grid per unit of noise.
  keep_from : f32,         //  52  [1] Layer from which on no cell holds a drop.
  threshold : f32,         //  56  [1] Sum of the sines above which a drop is.
  printed_normal : i32,    //  60  [1] 1: the normal as the report prints it, of the cosine of a sine.
  level : f32,             //  64  [1] Mip level at which drops see the scene, without gradient_level.
  gradient_level : i32,    //  68  [1] 1: the level follows from the gradient of the drop's normal.
  padding_0 : f32,         //  72  padding
  padding_1 : f32,         //  76  padding
}
@group(0) @binding(0) var<uniform> u: PublishedDropsUniforms;
@group(0) @binding(1) var background: texture_2d<f32>;
@group(0) @binding(2) var scene: texture_2d<f32>;
@group(0) @binding(3) var noise: texture_2d<f32>;
@group(0) @binding(18) var scene_sampler: sampler;
@group(0) @binding(19) var noise_sampler: sampler;

struct Outputs {
  @location(0) water: vec4f,
  @location(1) colour: vec4f,
}

fn noise_at(at: vec2f) -> vec4f {
  if (u.noise_nearest == 0) { return textureSampleLevel(noise, noise_sampler, at, 0.0); }
  let size = vec2i(textureDimensions(noise));
  return textureLoad(noise, vec2i(floor(fract(at) * vec2f(size))) % size, 0);
}

// How far, squared, the lookup goes in the scene [texel] in a step of one pixel. w: the drop's normal, not normalized; turn: w's derivative.
fn squared_stride(w: vec3f, turn: vec3f, one_pixel: vec2f) -> f32 {
  let inverse = 1.0 / length(w);
  let v = w * inverse;
  let turned = (turn - v * dot(v, turn)) * inverse;
  let way = one_pixel + u.resolution * u.refraction * turned.xy;
  return dot(way, way);
}
// p: the drop's angles; fade: its share of the full size; layer: number of its grid.
fn level_of(w: vec3f, p: vec2f, fade: f32, layer: f32) -> f32 {
  if (u.gradient_level == 0) { return u.level; }
  let turn = select(sin(p), sin(sin(p)) * cos(p), u.printed_normal != 0);
  let rise = 1.8 * fade * cos(p);
  let per_pixel = u.cell_angle * (layer * u.grid);
  let across = squared_stride(w, vec3f(-turn.x, 0.0, rise.x) * per_pixel, vec2f(1.0, 0.0));
  let upward = squared_stride(w, vec3f(0.0, -turn.y, rise.y) * per_pixel, vec2f(0.0, 1.0));
  return log(max(max(across, upward), 1.0)) * 0.7213475;
}

@fragment
fn main(@builtin(position) place: vec4f) -> Outputs {
  let pixel = vec2i(place.xy);
  let at = (vec2f(pixel) + 0.5) / u.resolution;
  var shift = (noise_at(at * 0.1).rg - u.noise_middle) * u.displacement;
  if (u.printed_misprint != 0) { shift = vec2f((1.0 - u.noise_middle) * u.displacement); }
  var layer = 0.0;
  var light = textureLoad(background, pixel, 0).rgb;
  for (var k = u.layers; k > 0; k--) {
    let r = f32(k);
    let x = u.resolution * r * u.grid;
    let p = u.cell_angle * at * x + shift;
    let s = sin(p);
    let d = noise_at(floor(at * x - 0.25 + 0.5) / x).rgb;
    let fade = max(0.0, 1.0 - fract(u.time * (d.b + 0.1) + d.g) * 2.0);
    let t = (s.x + s.y) * fade;
    if (!(d.r < (u.keep_from - r) * u.keep && t > u.threshold)) { continue; }
    let z = mix(0.2, 2.0, t - 0.5);
    let w = vec3f(cos(select(p, s, u.printed_normal != 0)), z);
    let v = -normalize(w);
    layer = r;
    light = textureSampleLevel(scene, scene_sampler, at - v.xy * u.refraction, level_of(w, p, fade, r)).rgb;
  }
  return Outputs(vec4f(layer * u.water_step), vec4f(light, 1.0));
}
