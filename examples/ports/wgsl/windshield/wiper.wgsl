// One blade over a step.
struct Wiper {
  previous_inner : vec2<f32>,  //   0  [1] Inner end before the step, glass coordinates.
  previous_outer : vec2<f32>,  //   8  [1] Outer end before the step.
  inner : vec2<f32>,           //  16  [1] Inner end after it.
  outer : vec2<f32>,           //  24  [1] Outer end after it.
  pivot : vec2<f32>,           //  32  [m] Plane coordinates.
  inner_radius : f32,          //  40  [m] Of the inner end, from the pivot.
  outer_radius : f32,          //  44  [m] Of the outer end.
  previous_axis : vec2<f32>,   //  48  [1] Cosine and sine of the blade's angle before the step.
  axis : vec2<f32>,            //  56  [1] The same after it.
  half_width : f32,            //  64  [m] Half the width that the blade wipes.
  rate : f32,                  //  68  [rad/s] Turned angle over the time that the record stands for.
  direction : f32,             //  72  [1] Sign of rate; 0 at rest.
  padding_0 : f32,             //  76  padding
}
