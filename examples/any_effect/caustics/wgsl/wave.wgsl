// caustics.wave in WGSL. Height and velocity are advanced together as one vector.
struct Wave {
  pull : f32,        //   0  [1] Share of the distance to its neighbours' mean that a texel gains as velocity in a step.
  drag : f32,        //   4  [1/s] Rate at which velocity is lost.
  dt : f32,          //   8  [s] Length of a step.
  drop_count : i32,  //  12  [1] Drops in the list.
}
struct Drop {
  position : vec2f,  //   0  [texel] Centre; texel centres lie at k + 1/2.
  radius : f32,      //   8  [texel] Nothing is moved from this distance on.
  depth : f32,       //  12  [texel] Of the hollow, in its middle.
}
@group(0) @binding(0) var<uniform> u: Wave;
@group(0) @binding(1) var water: texture_2d<f32>;
@group(0) @binding(2) var<storage, read> falling: array<Drop>;
@group(0) @binding(3) var moved: texture_storage_2d<rg32float, write>;

fn depth_of_hollow(drop: Drop, place: vec2f) -> f32 {
  let t = distance(place, drop.position) / drop.radius;
  if (t >= 1.0) { return 0.0; }
  return drop.depth * (1.0 - t * t * (3.0 - 2.0 * t));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let size = textureDimensions(water);
  if (id.x >= size.x || id.y >= size.y) { return; }
  let west = vec2u(max(id.x, 1u) - 1u, id.y);
  let east = vec2u(min(id.x + 1u, size.x - 1u), id.y);
  let north = vec2u(id.x, max(id.y, 1u) - 1u);
  let south = vec2u(id.x, min(id.y + 1u, size.y - 1u));
  let row = textureLoad(water, west, 0).x + textureLoad(water, east, 0).x;
  let column = textureLoad(water, north, 0).x + textureLoad(water, south, 0).x;

  let now = textureLoad(water, id.xy, 0).xy;
  let force = u.pull * ((row + column) / 4.0 - now.x);
  let velocity = (now.y + force) * exp(-u.drag * u.dt);
  var state = vec2f(now.x + velocity, velocity);
  for (var i = 0; i < u.drop_count; i++) { state.x -= depth_of_hollow(falling[i], vec2f(id.xy) + 0.5); }
  textureStore(moved, id.xy, vec4f(state, 0.0, 0.0));
}
