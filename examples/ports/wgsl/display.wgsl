// The puddle's pass display, both variants, in WGSL.
override CORRECTED: bool = true;

struct DisplayUniforms {
  vignette: f32,  //   0  [1] Loss at distance 1 from the centre.
  exposure: f32,  //   4  [1] corrected: factor of the radiance.
  width: f32,     //   8  [pixel] Columns of the picture.
  height: f32,    //  12  [pixel] Rows of the picture.
}
@group(0) @binding(0) var<uniform> u: DisplayUniforms;
@group(0) @binding(1) var colour: texture_2d<f32>;
@group(0) @binding(2) var picture: texture_storage_2d<rgba8unorm, write>;

fn encode_srgb(linear: vec3f) -> vec3f {
  let curve = 1.055 * pow(max(linear, vec3f(0.0031308)), vec3f(1.0 / 2.4)) - 0.055;
  return select(curve, 12.92 * linear, linear <= vec3f(0.0031308));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let size = textureDimensions(picture);
  if (any(id.xy >= size)) { return; }
  let place = vec2f(id.xy) + 0.5;
  let vignette = 1.0 - u.vignette * length(place / vec2f(u.width, u.height) - 0.5);
  let radiance = textureLoad(colour, id.xy, 0).rgb;
  var code: vec3f;
  if (CORRECTED) {
    code = encode_srgb(clamp(max(vignette, 0.0) * u.exposure * radiance, vec3f(0.0), vec3f(1.0)));
  } else {
    code = pow(vignette * radiance, vec3f(0.4545));
  }
  textureStore(picture, id.xy, vec4f(code, 1.0));
}
