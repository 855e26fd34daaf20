// What both versions of shade share.
struct ShadeUniforms {
  camera_position : vec3<f32>,  //   0  [m] Eye.
  camera_pixel_scale : f32,     //  12  [1] Height of a pixel on the image plane at distance 1.
  camera_right : vec3<f32>,     //  16  [1] Unit vector to the right of the picture.
  camera_plane_left : f32,      //  28  [1] Left edge of the image plane at distance 1.
  camera_up : vec3<f32>,        //  32  [1] Unit vector to the top of the picture.
  camera_plane_bottom : f32,    //  44  [1] Bottom edge of the image plane at distance 1.
  camera_forward : vec3<f32>,   //  48  [1] Unit vector into the picture.
  padding_0 : f32,              //  60  padding
  tint : vec3<f32>,             //  64  [1] Colour of the water's body, linear RGB.
  reflectivity : f32,           //  76  [1] Weight of the reflection.
  rotation : vec2<f32>,         //  80  [1] Cosine and sine of env_rotation.
  ground_scale : f32,           //  88  [1/m] Tiles of the ground in a metre.
  water_turbidity : f32,        //  92  [1/m] Extinction of light in the water.
  puddle_depth : f32,           //  96  [m] as-published: depth of the ground under y = 0.
  fog_depth : f32,              // 100  [1/m] Extinction of the fog.
  use_checkerboard : i32,       // 104  [1] 1: checkerboard ground, 0: image.
  environment_is_cube : i32,    // 108  [1] 1: cube faces, 0: latitude/longitude.
  ambient : vec3<f32>,          // 112  [1] corrected: radiance of a white diffuse level ground.
  gloss_level : f32,            // 124  [1] corrected: mip level of the environment in wet ground.
  inverse_size : vec2<f32>,     // 128  [1/m] corrected: 1 over the puddle's extent in x and z.
  shore_width : f32,            // 136  [m] corrected: depth over which wet ground turns into water.
  ground_footprint : f32,       // 140  [1/m] corrected: texels of the ground under a pixel at distance 1.
  fog_colour : vec3<f32>,       // 144  [1] corrected: radiance of the fog.
  exact_fresnel : i32,          // 156  [1] corrected: 1: Fresnel's equations, 0: Schlick.
  wetness : f32,                // 160  [1] corrected: reflectance of the wet ground over that of water.
  background_level : f32,       // 164  [1] corrected: mip level of the environment behind the scene.
  mirror_level : f32,           // 168  [1] corrected: mip level of the environment in the water.
  ground_reach : f32,           // 172  [1] corrected: extents of the puddle over which the ground turns into the environment's; 0: never.
}
@group(0) @binding(0) var<uniform> u: ShadeUniforms;
@group(0) @binding(1) var hit_image: texture_2d<f32>;
@group(0) @binding(2) var normal_image: texture_2d<f32>;

const pi = 3.14159265358979;
const water_ior = 1.333;

fn schlick(cosine: f32) -> f32 {
  var f0 = (1.0 - water_ior) / (1.0 + water_ior);
  f0 *= f0;
  let m = 1.0 - cosine;
  let m2 = m * m;
  let m5 = m2 * m2 * m;
  return f0 + (1.0 - f0) * m5;
}
fn transmittance(extinction: f32, path: f32) -> f32 { return exp(-extinction * path); }

// By -env_rotation about y.
fn rotate(d: vec3f) -> vec3f {
  let c = u.rotation.x;
  let s = u.rotation.y;
  return vec3f(c * d.x + s * d.z, d.y, c * d.z - s * d.x);
}

fn latlong_place(d: vec3f) -> vec2f {
  let azimuth = atan2(d.z, d.x);
  let elevation = atan2(d.y, length(d.xz));
  return vec2f(0.5 + azimuth / (2.0 * pi), 0.5 + elevation / pi);
}

// Six square faces in one column; nothing is filtered over an edge, and the level is the nearest one.
fn cube(d: vec3f, lod: f32) -> vec3f {
  let a = abs(d);
  var face: f32;
  var major: f32;
  var place: vec2f;
  if (a.x >= a.y && a.x >= a.z) {
    face = select(0.0, 1.0, d.x < 0.0);
    place = vec2f(select(-d.z, d.z, d.x < 0.0), -d.y);
    major = a.x;
  } else if (a.y >= a.z) {
    face = select(2.0, 3.0, d.y < 0.0);
    place = vec2f(d.x, select(d.z, -d.z, d.y < 0.0));
    major = a.y;
  } else {
    face = select(4.0, 5.0, d.z < 0.0);
    place = vec2f(select(d.x, -d.x, d.z < 0.0), -d.y);
    major = a.z;
  }
  let level = floor(clamp(lod, 0.0, f32(textureNumLevels(environment) - 1u)) + 0.5);
  let edge = 0.5 / f32(max(textureDimensions(environment).x >> u32(level), 1u));
  place = clamp(0.5 * place / major + 0.5, vec2f(edge), vec2f(1.0 - edge));
  return textureSampleLevel(environment, environment_sampler, vec2f(place.x, (face + place.y) / 6.0), level).rgb;
}
fn sample_environment(direction: vec3f, lod: f32) -> vec3f {
  let d = rotate(direction);
  if (u.environment_is_cube != 0) { return cube(d, lod); }
  return textureSampleLevel(environment, environment_sampler, latlong_place(d), lod).rgb;
}

fn checkerboard(place: vec2f) -> vec3f {
  let sum = floor(place.x * u.ground_scale) + floor(place.y * u.ground_scale);
  let parity = sum - 2.0 * floor(0.5 * sum);
  return mix(vec3f(0.15, 0.12, 0.10), vec3f(0.25, 0.22, 0.20), parity);
}
