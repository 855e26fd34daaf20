// windshield.splat, corrected. The height of the water: every live drop, in slot order, on the film.
@group(0) @binding(2) var film: texture_2d<f32>;
@group(0) @binding(3) var<storage, read> necks: array<Neck>;

// A list without records is bound as one of zeros, of which nothing is left.
fn neck_of(id: u32) -> Neck {
  for (var i = 0u; i < arrayLength(&necks); i++) {
    if (necks[i].id == id) { return necks[i]; }
  }
  return no_neck(id);
}

fn quanta(at: vec2i) -> f32 {
  let last = vec2i(textureDimensions(film)) - 1;
  return textureLoad(film, clamp(at, vec2i(0), last), 0).x;
}
fn tent(before: f32, here: f32, after: f32) -> f32 { return 0.5 * here + 0.25 * (before + after); }
fn row(at: vec2i) -> f32 { return tent(quanta(at - vec2i(1, 0)), quanta(at), quanta(at + vec2i(1, 0))); }

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let texel = vec2i(place.xy);
  let height = u.film_scale * tent(row(texel - vec2i(0, 1)), row(texel), row(texel + vec2i(0, 1)));
  return vec4f(height + blended(texel), 0.0, 0.0, 0.0);
}
