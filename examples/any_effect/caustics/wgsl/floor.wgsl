// caustics.floor in WGSL.
struct Floor {
  absorption : vec3f,  //   0  [1/texel] Of the water, linear RGB.
  depth : f32,         //  12  [texel] Of still water.
  view : vec2f,        //  16  [texel] From a texel to what the eye sees below it through still water.
  tile : f32,          //  24  [texel] Side of a tile.
  ambient : f32,       //  28  [1] Light that comes from everywhere; the sun's is 1.
  sky : vec3f,         //  32  [1] What the water mirrors, linear RGB.
  rounds : i32,        //  44  [1] Steps of the search for the ray that lands on a place.
}
@group(0) @binding(0) var<uniform> u: Floor;
@group(0) @binding(1) var rays: texture_2d<f32>;
@group(0) @binding(17) var rays_sampler: sampler;
@group(0) @binding(2) var mirror: texture_2d<f32>;
@group(0) @binding(3) var tiles: texture_2d<f32>;
@group(0) @binding(19) var tiles_sampler: sampler;
@group(0) @binding(4) var picture: texture_storage_2d<rgba8unorm, write>;

// What is left of the light after its way down and up again.
fn clearness(sideways: vec2f) -> vec3f {
  let up = length(vec3f(u.depth, sideways));
  return exp(u.absorption * -(up + u.depth));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let size = textureDimensions(picture);
  if (any(id.xy >= size)) { return; }
  let extent = vec2f(size);

  let sideways = textureLoad(rays, id.xy, 0).xy + u.view;
  let target_point = vec2f(id.xy) + 0.5 + sideways;
  var from_point = target_point;
  var left = u.rounds;
  loop {
    if (left <= 0) { break; }
    let guess = textureSampleLevel(rays, rays_sampler, from_point / extent, 0.0);
    from_point = target_point - guess.xy;
    left--;
  }
  let sun = textureSampleLevel(rays, rays_sampler, from_point / extent, 0.0);

  let stone = textureSampleLevel(tiles, tiles_sampler, target_point / u.tile, 0.0).rgb;
  let below = stone * clearness(sideways) * (sun.z * sun.w + u.ambient);
  let share = textureLoad(mirror, id.xy, 0).x;
  textureStore(picture, id.xy, vec4f(sqrt(saturate(mix(below, u.sky, share))), 1.0));
}
