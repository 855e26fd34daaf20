// What both displays share.
struct DisplayUniforms {
  vignette : f32,  //   0  [1] Loss at distance 1 from the centre.
  exposure : f32,  //   4  [1] corrected: factor of the radiance.
  width : f32,     //   8  [pixel] Columns of the picture.
  height : f32,    //  12  [pixel] Rows of the picture.
}
@group(0) @binding(0) var<uniform> u: DisplayUniforms;
@group(0) @binding(1) var colour: texture_2d<f32>;

fn vignette(pixel: vec2i) -> f32 {
  let place = (vec2f(pixel) + 0.5) / vec2f(u.width, u.height);
  return 1.0 - u.vignette * length(place - 0.5);
}
