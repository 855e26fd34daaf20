// What both versions of integrate share.
struct IntegrateUniforms {
  frame : vec3<f32>,       //   0  [m] corrected: x = frame.x u + frame.y v and y = frame.z v in the plane of the glass.
  dt : f32,                //  12  [s] The step.
  inertia_coupling : f32,  //  16  [1] as-published: share of the vehicle's acceleration.
  wind_coupling : f32,     //  20  [1/s] as-published: acceleration by a unit of wind.
  drag : f32,              //  24  [1/s] as-published: rate of slowing down; corrected: that times mass^(2/3).
  wind_push : f32,         //  28  [1/m] corrected: acceleration over wind speed squared, times mass^(1/3).
  hold : f32,              //  32  [m/s^2] corrected: acceleration that hysteresis holds, times mass^(2/3).
  evaporation : f32,       //  36  [1/s] corrected: mass units lost in a second over mass^(1/3).
  margin : f32,            //  40  [1] corrected: how far outside the glass a drop lives.
  rest_speed : f32,        //  44  [m/s] corrected: a held drop below this speed rests.
  phase_rate : f32,        //  48  [1] corrected: turns in 64 s of the phase that rounds losses.
  padding_0 : f32,         //  52  padding
  padding_1 : f32,         //  56  padding
  padding_2 : f32,         //  60  padding
}
@group(0) @binding(0) var<uniform> u: IntegrateUniforms;
struct GlassFrame {
  gravity : vec2<f32>,       //   0  [1/s^2] as-published: gravity; corrected: specific force at (0, 0), the car's motion included.
  wind : vec2<f32>,          //   8  [1/s] Apparent wind.
  acceleration : vec2<f32>,  //  16  [1/s^2] as-published: of the vehicle; corrected: 0.
  id : u32,                  //  24  [1] 0.
  padding_0 : f32,           //  28  padding
  spin : vec4<f32>,          //  32  [1/s^2] corrected: specific force per glass coordinate, rows u and v.
  coriolis : vec4<f32>,      //  48  [1/s] corrected: specific force per velocity, rows u and v.
}
@group(0) @binding(2) var<storage, read> glass_frame: array<GlassFrame>;
@group(0) @binding(3) var<storage, read_write> drops_out: DropsOutBuffer;
