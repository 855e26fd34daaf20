// fogged_glass.fog in WGSL. It sums up what the drops wipe before the fog grows.
struct Fog {
  dt : f32,             //   0  [s] Time since the last run.
  regrow_time : f32,    //   4  [s] After this time a wiped place lacks 1/e of its fog.
  rim : f32,            //   8  [texel] Width of the soft rim of what a drop wipes.
  drop_count : i32,     //  12  [1] Drops in the list.
  fog_at_top : f32,     //  16  [1] Share of the pane that is fogged at last, at its upper edge.
  fog_at_bottom : f32,  //  20  [1] The same at its lower edge.
  trail : f32,          //  24  [1] Radius of a trail where it begins, in radii of its drop.
  padding_0 : f32,      //  28  padding
}
struct Drop {
  position : vec2f,  //   0  [texel] Centre; texel centres lie at k + 1/2.
  velocity : vec2f,  //   8  [texel/s] Of the slide that led here.
  radius : f32,      //  16  [texel] 0: there is no drop.
  strength : f32,    //  20  [1] Share of the fog that the drop takes.
}
@group(0) @binding(0) var<uniform> u: Fog;
@group(0) @binding(1) var last_fog: texture_2d<f32>;
@group(0) @binding(2) var<storage, read> slides: array<Drop>;
@group(0) @binding(3) var new_fog: texture_storage_2d<r32float, write>;

// The place on a drop's way that is nearest: how far along it lies, and its distance.
struct Nearest {
  along : f32,
  away : f32,
}
fn nearest_on_way(drop: Drop, at: vec2f) -> Nearest {
  let end = drop.position - at;
  let way = drop.velocity * u.dt;
  let start = end - way;
  let square = dot(way, way);
  if (square == 0.0) { return Nearest(1.0, length(end)); }
  let along = clamp(-dot(start, way) / square, 0.0, 1.0);
  return Nearest(along, length(start + along * way));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let size = textureDimensions(new_fog);
  if (id.x >= size.x || id.y >= size.y) { return; }
  let at = vec2f(id.xy) + 0.5;

  var stays = 1.0;
  for (var i = 0; i < u.drop_count; i++) {
    let drop = slides[i];
    if (drop.radius <= 0.0) { continue; }
    let near = nearest_on_way(drop, at);
    let edge = drop.radius * mix(u.trail, 1.0, near.along);
    // smoothstep by hand: 0 in the middle of the way, 1 beyond its rim
    let t = saturate((near.away - (edge - u.rim)) / u.rim);
    let beyond = t * t * (3.0 - 2.0 * t);
    stays *= 1.0 - drop.strength + drop.strength * beyond;
  }

  let down = smoothstep(0.0, 1.0, at.y / f32(size.y));
  let cold = mix(u.fog_at_top, u.fog_at_bottom, down);
  let memory = exp(-u.dt / u.regrow_time);
  let old = textureLoad(last_fog, id.xy, 0).x;
  textureStore(new_fog, id.xy, vec4f(stays * mix(cold, old, memory), 0.0, 0.0, 0.0));
}
