// What both normals share.
struct NormalsUniforms {
  slope_x : f32,      //   0  [1/mm] Slope along x for 1 mm across two columns.
  slope_shear : f32,  //   4  [1/mm] Slope along y for 1 mm across two columns; 0 as published.
  slope_y : f32,      //   8  [1/mm] Slope along y for 1 mm across two rows.
  padding_0 : f32,    //  12  padding
}
@group(0) @binding(0) var<uniform> u: NormalsUniforms;
@group(0) @binding(1) var height: texture_2d<f32>;
@group(0) @binding(2) var mask: texture_2d<f32>;

fn held(at: vec2i) -> vec2i { return clamp(at, vec2i(0), vec2i(textureDimensions(height)) - 1); }
fn height_at(at: vec2i) -> f32 { return textureLoad(height, held(at), 0).x; }
fn dry_at(at: vec2i) -> f32 { return 1.0 - textureLoad(mask, held(at), 0).x; }

fn stored_normal(across: vec2f, kept: f32) -> vec4f {
  let slope = kept * vec2f(u.slope_x * across.x, u.slope_shear * across.x + u.slope_y * across.y);
  return vec4f(normalize(vec3f(-slope, 1.0)), 1.0);
}
