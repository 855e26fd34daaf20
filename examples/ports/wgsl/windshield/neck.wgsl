// A drop that is two still.
struct Neck {
  offset : vec2<f32>,  //   0  [1] From the larger drop's middle to the smaller one's, in plane axes, over the base radius of both.
  share : f32,         //   8  [1] Of the smaller one in the mass of both.
  left : f32,          //  12  [1] 1 when they became one, falling; not above 0: none.
  id : u32,            //  16  [1] Of the drop that they are.
  padding_0 : f32,     //  20  padding
  padding_1 : f32,     //  24  padding
  padding_2 : f32,     //  28  padding
}

// Radii of both footprints over that of their drop.
fn footprints(neck: Neck) -> vec2f {
  let larger = pow(max(1.0 - neck.share, 0.125), 1.0 / 3.0);
  let smaller = pow(max(neck.share, 0.0), 1.0 / 3.0);
  return vec2f(larger, smaller) * mix(1.0 / larger, 1.0, neck.left);
}
fn no_neck(id: u32) -> Neck { return Neck(vec2f(0.0), 0.0, 0.0, id, 0.0, 0.0, 0.0); }
