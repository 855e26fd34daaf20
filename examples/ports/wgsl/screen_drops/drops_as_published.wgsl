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
    let t = (s.x + s.y) * max(0.0, 1.0 - fract(u.time * (d.b + 0.1) + d.g) * 2.0);
    if (!(d.r < (u.keep_from - r) * u.keep && t > u.threshold)) { continue; }
    let z = mix(0.2, 2.0, t - 0.5);
    let v = -normalize(vec3f(cos(select(p, s, u.printed_normal != 0)), z));
    layer = r;
    light = textureSampleLevel(scene, scene_sampler, at - v.xy * u.refraction, 0.0).rgb;
  }
  return Outputs(vec4f(layer * u.water_step), vec4f(light, 1.0));
}
