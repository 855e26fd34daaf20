// One blade over a step.
struct Wiper {
  vec2 previous_inner;  //   0  [1] Inner end before the step, glass coordinates.
  vec2 previous_outer;  //   8  [1] Outer end before the step.
  vec2 inner;           //  16  [1] Inner end after it.
  vec2 outer;           //  24  [1] Outer end after it.
  vec2 pivot;           //  32  [m] Plane coordinates.
  float inner_radius;   //  40  [m] Of the inner end, from the pivot.
  float outer_radius;   //  44  [m] Of the outer end.
  vec2 previous_axis;   //  48  [1] Cosine and sine of the blade's angle before the step.
  vec2 axis;            //  56  [1] The same after it.
  float half_width;     //  64  [m] Half the width that the blade wipes.
  float rate;           //  68  [rad/s] Turned angle over the time that the record stands for.
  float direction;      //  72  [1] Sign of rate; 0 at rest.
  float padding_0;      //  76  padding
};
