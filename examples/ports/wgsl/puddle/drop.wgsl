// A drop that falls into the water.
struct Drop {
  x : f32,          //   0  [texel] Centre; texel centres lie at k + 1/2.
  y : f32,          //   4  [texel] Centre.
  amplitude : f32,  //   8  [1] as-published: strength times activation; corrected: stored height at the centre.
  radius : f32,     //  12  [texel] Nothing is added from this distance on.
}
