// What both variants of windshield_frame share.
struct WindshieldFrameUniforms {
  heading : vec2<f32>,           //   0  [1] Cosine and sine of the car's heading, positive to the left.
  yaw_rate : f32,                //   8  [rad/s] Turn rate of the car, positive to the left.
  yaw_acceleration : f32,        //  12  [rad/s^2] Derivative of yaw_rate.
  world_wind : vec3<f32>,        //  16  [m/s] Velocity of the wind, world axes.
  gravity : f32,                 //  28  [m/s^2] Acceleration of gravity.
  vehicle_velocity : vec3<f32>,  //  32  [m/s] Velocity of the car, world axes.
  padding_0 : f32,               //  44  padding
  acceleration : vec3<f32>,      //  48  [m/s^2] Acceleration of the car's origin, car axes.
  padding_1 : f32,               //  60  padding
  e_u : vec3<f32>,               //  64  [m] Edge of the glass along u, car axes.
  padding_2 : f32,               //  76  padding
  e_v : vec3<f32>,               //  80  [m] Edge of the glass along v, car axes.
  padding_3 : f32,               //  92  padding
  origin : vec3<f32>,            //  96  [m] corrected: corner (0, 0) of the glass, car axes.
  padding_4 : f32,               // 108  padding
  inverse_metric : vec3<f32>,    // 112  [1/m^2] as-published: 1 / |e_u|^2, 0, 1 / |e_v|^2; corrected: uu, uv and vv of the metric's inverse.
  padding_5 : f32,               // 124  padding
}
@group(0) @binding(0) var<uniform> u: WindshieldFrameUniforms;
struct GlassFrame {
  gravity : vec2<f32>,       //   0  [1/s^2] as-published: gravity; corrected: specific force at (0, 0), the car's motion included.
  wind : vec2<f32>,          //   8  [1/s] Apparent wind.
  acceleration : vec2<f32>,  //  16  [1/s^2] as-published: of the vehicle; corrected: 0.
  id : u32,                  //  24  [1] 0.
  padding_0 : f32,           //  28  padding
  spin : vec4<f32>,          //  32  [1/s^2] corrected: specific force per glass coordinate, rows u and v.
  coriolis : vec4<f32>,      //  48  [1/s] corrected: specific force per velocity, rows u and v.
}
struct GlassFrameBuffer {
  count : u32,
  padding_0 : u32,
  padding_1 : u32,
  padding_2 : u32,
  records : array<GlassFrame>,
}
@group(0) @binding(1) var<storage, read_write> glass_frame: GlassFrameBuffer;

fn apparent_wind() -> vec3f {
  let w = u.world_wind - u.vehicle_velocity;
  let c = u.heading.x;
  let s = u.heading.y;
  return vec3f(c * w.x + s * w.y, c * w.y - s * w.x, w.z);
}
fn give(gravity: vec2f, wind: vec2f, acceleration: vec2f, spin: vec4f, coriolis: vec4f) {
  glass_frame.count = 1u;
  glass_frame.records[0] = GlassFrame(gravity, wind, acceleration, 0u, 0.0, spin, coriolis);
}
