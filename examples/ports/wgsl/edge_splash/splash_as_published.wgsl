// edge_splash.splash, as-published. Masks of edge, angle and noise, and the scene with drops blended over it.
struct PublishedSplashUniforms {
  drop_color : vec4<f32>,  //   0  [1] Linear RGB and opacity of the drops.
  width : i32,             //  16  [texel] Columns of the picture.
  height : i32,            //  20  [texel] Rows of the picture.
  noise_width : i32,       //  24  [texel] Columns of the noise map.
  noise_height : i32,      //  28  [texel] Rows of the noise map.
  edge_threshold : f32,    //  32  [1] Sobel sum of device depths that counts as an edge.
  rain_drop_scale : f32,   //  36  [1] Threshold of the noise.
  time : f32,              //  40  [s] Frame number over frame rate, rounded once.
  drop_speed : f32,        //  44  [texel/s] Speed of the noise in x and in y.
  thickness : i32,         //  48  [texel] Distance of the taps where the depth is 1.
  padding_0 : f32,         //  52  padding
  padding_1 : f32,         //  56  padding
  padding_2 : f32,         //  60  padding
}
@group(0) @binding(0) var<uniform> u: PublishedSplashUniforms;

// A load outside a texture gives any texel of it, or 0, in WGSL; it is 0 in HLSL.
fn load(image: texture_2d<f32>, at: vec2i) -> f32 {
  if (any(at < vec2i(0)) || any(at >= vec2i(textureDimensions(image)))) { return 0.0; }
  return textureLoad(image, at, 0).r;
}
// C's fmod, also where the quotient is rounded up.
fn remainder_of(x: f32, size: f32) -> i32 {
  var rest = x - size * trunc(x / size);
  if (x >= 0.0 && rest < 0.0) { rest += size; }
  if (x < 0.0 && rest > 0.0) { rest -= size; }
  return i32(rest);
}

@fragment
fn main(@builtin(position) place: vec4f) -> Outputs {
  let pixel = vec2i(place.xy);
  let below = textureLoad(scene, pixel, 0);
  let none = vec4f(0.0);
  if (any(pixel + u.thickness >= vec2i(u.width, u.height)) || any(pixel - u.thickness < vec2i(0))) {
    return Outputs(none, none, none, clamp(below, vec4f(0.0), vec4f(1.0)));
  }

  let d = load(depth, pixel);
  let shift = f32(u.thickness) * (d * d);
  let x = pixel.x;
  let y = i32(f32(pixel.y) - shift);
  let left = i32(f32(x) - shift);
  let right = i32(f32(x) + shift);
  let low = i32(f32(y) - shift);
  let high = i32(f32(y) + shift);
  let p0 = load(depth, vec2i(left, high));
  let p1 = load(depth, vec2i(x, y - u.thickness));
  let p2 = load(depth, vec2i(right, low));
  let p3 = load(depth, vec2i(left, y));
  let p5 = load(depth, vec2i(right, y));
  let p6 = load(depth, vec2i(left, high));
  let p7 = load(depth, vec2i(x, high));
  let p8 = load(depth, vec2i(right, high));
  let gx = -p0 - 2.0 * p3 - p6 + p2 + 2.0 * p5 + p8;
  let gy = -p0 - 2.0 * p1 - p2 + p6 + 2.0 * p7 + p8;

  let pi = 3.14159265;
  let strength = sqrt(gx * gx + gy * gy);
  let edge = step(u.edge_threshold, strength);
  let angle = step((atan2(gy, gx) + pi) / (2.0 * pi), 0.5);
  let scrolled = u.time * u.drop_speed;
  let at = vec2i(remainder_of(f32(x) + scrolled, f32(u.noise_width)), remainder_of(f32(pixel.y) + scrolled, f32(u.noise_height)));
  let noise = step(u.rain_drop_scale, load(noise_map, at));

  let mask = edge * angle * noise;
  let result = mix(below, u.drop_color, mask * u.drop_color.a);
  return Outputs(vec4f(edge), vec4f(angle), vec4f(noise), clamp(result, vec4f(0.0), vec4f(1.0)));
}
