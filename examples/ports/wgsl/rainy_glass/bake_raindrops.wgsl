// The raindrop map, both variants.
struct BakeRaindropsUniforms {
  inverse_size : vec2<f32>,  //   0  [1] 1 over the map's columns and rows.
  droplet_count : i32,       //   8  [1] Droplets in the list.
  normal_scale : f32,        //  12  [1] Slope of the water over the gradient of the height.
  neutral : f32,             //  16  [1] Stored value of a flat surface's normal.
  span : f32,                //  20  [1] Stored value of a unit less neutral.
  padding_0 : f32,           //  24  padding
  padding_1 : f32,           //  28  padding
}
@group(0) @binding(0) var<uniform> u: BakeRaindropsUniforms;
struct Droplet {
  x : f32,       //   0  [1] Centre, in tiles.
  y : f32,       //   4  [1] Centre.
  radius : f32,  //   8  [1] Of a disc that holds it, in tiles.
  height : f32,  //  12  [1] At the centre.
  m00 : f32,     //  16  [1] q = M d is 1 long at the rim.
  m01 : f32,     //  20  [1] M is symmetric.
  m11 : f32,     //  24  [1] See m00.
  offset : f32,  //  28  [1] Of its timer.
}
@group(0) @binding(1) var<storage, read> droplets: array<Droplet>;

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let here = texel_centre(vec2i(place.xy));
  var gradient = vec2f(0.0);
  var height = 0.0;
  var nearest = 4.0;
  var offset = 0.0;
  for (var k = 0; k < u.droplet_count; k++) {
    let d = droplets[k];
    let apart = vec2f(around(here.x - d.x), around(here.y - d.y));
    let q = vec2f(d.m00 * apart.x + d.m01 * apart.y, d.m01 * apart.x + d.m11 * apart.y);
    let h = d.height * (1.0 - dot(q, q));
    if (h > height) {
      height = h;
      gradient = -2.0 * d.height * vec2f(d.m00 * q.x + d.m01 * q.y, d.m01 * q.x + d.m11 * q.y);
    }
    let measure = cell_measure(dot(apart, apart), d.radius);
    if (measure < nearest) {
      nearest = measure;
      offset = d.offset;
    }
  }
  return vec4f(stored_normal(gradient), offset, height);
}
