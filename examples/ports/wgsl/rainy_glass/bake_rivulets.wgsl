// rainy_glass.bake_rivulets, as-published and corrected. The rivulet map: normals of rivulets, and their flow. Once, before frame 0.
struct BakeRivuletsUniforms {
  inverse_size : vec2<f32>,  //   0  [1] 1 over the map's columns and rows.
  trail_count : i32,         //   8  [1] Rivulets in the list.
  normal_scale : f32,        //  12  [1] Slope of the water over the gradient of the height.
  neutral : f32,             //  16  [1] Stored value of 0.
  span : f32,                //  20  [1] Stored value of 1 less neutral.
  flow_cells : i32,          //  24  [1] Cells of the flow's coarser octave along a side.
  flow_gain : f32,           //  28  [1] Factor of the noise before it is held in [-1, 1].
}
@group(0) @binding(0) var<uniform> u: BakeRivuletsUniforms;
struct Trail {
  x : f32,               //   0  [1] Centre of the head, in tiles.
  y : f32,               //   4  [1] Centre of the head.
  half_width : f32,      //   8  [1] Of the head.
  inverse_length : f32,  //  12  [1] 1 over the length of the tail.
  height : f32,          //  16  [1] Of the head.
  wiggle : f32,          //  20  [1] Amplitude of the winding.
  wiggle_rate : f32,     //  24  [1] Turns of the winding in a tile.
  wiggle_phase : f32,    //  28  [1] At the head, in turns.
}
@group(0) @binding(1) var<storage, read> trails: array<Trail>;
@group(0) @binding(2) var lattice: texture_2d<f32>;

const two_pi = 6.28318530717959;

// Gradient noise for the flow across (xy) and along (zw) the glass.
fn gradient_noise(place: vec2f, cells: i32) -> vec2f {
  let x = place * f32(cells);
  let whole = floor(x);
  let f = x - whole;
  let low = vec2i(whole);
  let high = (low + 1) % cells;
  let a = textureLoad(lattice, low, 0);
  let b = textureLoad(lattice, vec2i(high.x, low.y), 0);
  let c = textureLoad(lattice, vec2i(low.x, high.y), 0);
  let d = textureLoad(lattice, high, 0);
  let fade = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  let na = vec2f(dot(a.xy, f), dot(a.zw, f));
  let nb = vec2f(dot(b.xy, f - vec2f(1.0, 0.0)), dot(b.zw, f - vec2f(1.0, 0.0)));
  let nc = vec2f(dot(c.xy, f - vec2f(0.0, 1.0)), dot(c.zw, f - vec2f(0.0, 1.0)));
  let nd = vec2f(dot(d.xy, f - vec2f(1.0, 1.0)), dot(d.zw, f - vec2f(1.0, 1.0)));
  return mix(mix(na, nb, fade.x), mix(nc, nd, fade.x), fade.y);
}

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let here = texel_centre(vec2i(place.xy));
  var gradient = vec2f(0.0);
  var height = 0.0;
  for (var k = 0; k < u.trail_count; k++) {
    let t = trails[k];
    let dy = fract(here.y - t.y + 0.125) - 0.125;
    let angle = two_pi * around(t.wiggle_rate * dy + t.wiggle_phase);
    let dx = around(here.x - t.x) - t.wiggle * sin(angle);
    let inverse_sq = 1.0 / (t.half_width * t.half_width);
    let tail = dy >= 0.0;
    let along = select(dy * dy * inverse_sq, dy * t.inverse_length, tail);
    let h = t.height * (1.0 - along - dx * dx * inverse_sq);
    if (h > height) {
      height = h;
      let across = -2.0 * t.height * inverse_sq * dx;
      let lengthwise = select(-2.0 * t.height * inverse_sq * dy, -t.height * t.inverse_length, tail);
      gradient = vec2f(across, lengthwise - across * two_pi * t.wiggle * t.wiggle_rate * cos(angle));
    }
  }
  let noise = gradient_noise(here, u.flow_cells) + 0.5 * gradient_noise(here, 2 * u.flow_cells);
  let flow = u.neutral + u.span * clamp(u.flow_gain * noise, vec2f(-1.0), vec2f(1.0));
  return vec4f(stored_normal(gradient), flow);
}
