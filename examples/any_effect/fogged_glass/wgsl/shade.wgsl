// fogged_glass.shade in WGSL: the drop that counts most covers the fog, all of them bend the view.
struct Shade {
  blur : f32,          //   0  [1] Mip level of the background behind full fog.
  lens : f32,          //   4  [1] How far the middle of a drop moves the place that is seen, in distances from the middle.
  rim_light : f32,     //   8  [1] Light on the beads of water at the rim of the fog.
  drop_count : i32,    //  12  [1] Drops in the list.
  fog_colour : vec3f,  //  16  [1] Light that the fog scatters, linear RGB.
  veil : f32,          //  28  [1] Share of the light that full fog replaces by its own.
}
struct Drop {
  position : vec2f,  //   0  [texel] Centre; texel centres lie at k + 1/2.
  velocity : vec2f,  //   8  [texel/s] Of the slide that led here.
  radius : f32,      //  16  [texel] 0: there is no drop.
  strength : f32,    //  20  [1] Share of the fog that the drop takes.
}
@group(0) @binding(0) var<uniform> u: Shade;
@group(0) @binding(1) var fog: texture_2d<f32>;
@group(0) @binding(2) var street: texture_2d<f32>;
@group(0) @binding(18) var street_sampler: sampler;
@group(0) @binding(3) var<storage, read> drops: array<Drop>;
@group(0) @binding(4) var pane: texture_storage_2d<rgba8unorm, write>;

fn fogged(texel: vec2i) -> f32 {
  let last = vec2i(textureDimensions(fog)) - 1;
  return textureLoad(fog, clamp(texel, vec2i(0), last), 0).x;
}
// Light on the beads at the rim of the fog: four neighbours, with the weights of light from the upper left.
fn beads(texel: vec2i) -> f32 {
  let vertical = fogged(texel + vec2i(0, 1)) - fogged(texel + vec2i(0, -1));
  let horizontal = fogged(texel + vec2i(1, 0)) - fogged(texel + vec2i(-1, 0));
  return u.rim_light * max(vertical + horizontal / 2.0, 0.0);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
  let size = textureDimensions(pane);
  if (any(id.xy >= size)) { return; }
  let here = vec2f(id.xy) + 0.5;

  var moved = vec2f(0.0);
  var least_q = 1.0;  // of the drops here: the square of the distance to the middle, in radii
  var glitter = 0.0;
  for (var i = 0; i < u.drop_count; i++) {
    let radius = drops[i].radius;
    if (radius > 0.0) {
      let p = (here - drops[i].position) / radius;
      let q = p.x * p.x + p.y * p.y;
      if (q < 1.0) {
        let height = sqrt(1.0 - q);
        moved += p * (radius * u.lens * height);
        least_q = min(least_q, q);
        let lamp = p + vec2f(0.3, 0.4);
        glitter += height * exp(-18.0 * dot(lamp, lamp));
      }
    }
  }
  let haze = fogged(vec2i(id.xy)) * smoothstep(0.6, 1.0, least_q);

  let behind = textureSampleLevel(street, street_sampler, (here - moved) / vec2f(size), haze * u.blur);
  let veiled = mix(behind.rgb, u.fog_colour, haze * u.veil);
  let bright = veiled + (beads(vec2i(id.xy)) + glitter);
  textureStore(pane, id.xy, vec4f(sqrt(saturate(bright)), 1.0));
}
