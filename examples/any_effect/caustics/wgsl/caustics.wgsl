// caustics.caustics in WGSL: landing places of the cross of five texels, as WGSL's refract gives them.
struct Caustics {
  eye : vec3f,       //   0  [1] Unit vector to the eye; z is up.
  depth : f32,       //  12  [texel] Of still water.
  ior : f32,         //  16  [1] Refractive index of the water.
  least_area : f32,  //  20  [1] Smaller areas count as this share of the area before.
  padding_0 : f32,   //  24  padding
  padding_1 : f32,   //  28  padding
}
@group(0) @binding(0) var<uniform> u: Caustics;
@group(0) @binding(1) var wave: texture_2d<f32>;
@group(0) @binding(2) var out_rays: texture_storage_2d<rgba16float, write>;
@group(0) @binding(3) var out_mirror: texture_storage_2d<r32float, write>;

const down = vec3f(0.0, 0.0, -1.0);

struct Surface {
  height : f32,
  up : vec3f,
}
fn surface(texel: vec2i) -> Surface {
  let end = vec2i(textureDimensions(wave)) - 1;
  let low = max(texel - 1, vec2i(0));
  let high = min(texel + 1, end);
  let slope_x = textureLoad(wave, vec2i(high.x, texel.y), 0).x - textureLoad(wave, vec2i(low.x, texel.y), 0).x;
  let slope_y = textureLoad(wave, vec2i(texel.x, high.y), 0).x - textureLoad(wave, vec2i(texel.x, low.y), 0).x;
  return Surface(textureLoad(wave, texel, 0).x, normalize(vec3f(-slope_x, -slope_y, 2.0)));
}
// How far to the side a ray gets on its way to the floor.
fn drift(at: Surface) -> vec2f {
  let ray = refract(down, at.up, 1.0 / u.ior);
  return -(at.height + u.depth) * (ray.xy / ray.z);
}
fn mirrored(cosine: f32) -> f32 {
  let r = (1.0 - u.ior) / (1.0 + u.ior);
  let x = saturate(1.0 - cosine);
  return r * r + (1.0 - r * r) * (x * x * (x * x) * x);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let size = vec2i(textureDimensions(out_mirror));
  let texel = vec2i(id.xy);
  if (any(texel >= size)) { return; }

  let first = max(texel - 1, vec2i(0));
  let second = min(texel + 1, size - 1);
  let step = vec2f(second - first);
  let u_side = drift(surface(vec2i(second.x, texel.y))) - drift(surface(vec2i(first.x, texel.y)));
  let v_side = drift(surface(vec2i(texel.x, second.y))) - drift(surface(vec2i(texel.x, first.y)));
  let area = (step.x + u_side.x) * (step.y + v_side.y) - u_side.y * v_side.x;
  let still = step.x * step.y;
  let gathered = still / max(abs(area), still * u.least_area);

  let here = surface(texel);
  textureStore(out_rays, texel, vec4f(drift(here), gathered, 1.0 - mirrored(here.up.z)));
  textureStore(out_mirror, texel, vec4f(mirrored(dot(here.up, u.eye)), 0.0, 0.0, 0.0));
}
