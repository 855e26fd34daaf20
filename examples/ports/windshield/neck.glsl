// A drop that is two still.
struct Neck {
  vec2 offset;      //   0  [1] From the larger drop's middle to the smaller one's, in plane axes, over the base radius of both.
  float share;      //   8  [1] Of the smaller one in the mass of both.
  float left;       //  12  [1] 1 when they became one, falling; not above 0: none.
  uint id;          //  16  [1] Of the drop that they are.
  float padding_0;  //  20  padding
  float padding_1;  //  24  padding
  float padding_2;  //  28  padding
};

// Radii of both footprints over that of their drop.
vec2 footprints(Neck neck) {
  float larger = pow(max(1.0 - neck.share, 0.125), 1.0 / 3.0), smaller = pow(max(neck.share, 0.0), 1.0 / 3.0);
  return vec2(larger, smaller) * mix(1.0 / larger, 1.0, neck.left);
}
