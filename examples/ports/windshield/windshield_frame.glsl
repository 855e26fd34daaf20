// What both variants of windshield_frame share.
layout(local_size_x = 1) in;

layout(std140, binding = 0) uniform WindshieldFrameUniforms {
  vec2 heading;            //   0  [1] Cosine and sine of the car's heading, positive to the left.
  float yaw_rate;          //   8  [rad/s] Turn rate of the car, positive to the left.
  float yaw_acceleration;  //  12  [rad/s^2] Derivative of yaw_rate.
  vec3 world_wind;         //  16  [m/s] Velocity of the wind, world axes.
  float gravity;           //  28  [m/s^2] Acceleration of gravity.
  vec3 vehicle_velocity;   //  32  [m/s] Velocity of the car, world axes.
  float padding_0;         //  44  padding
  vec3 acceleration;       //  48  [m/s^2] Acceleration of the car's origin, car axes.
  float padding_1;         //  60  padding
  vec3 e_u;                //  64  [m] Edge of the glass along u, car axes.
  float padding_2;         //  76  padding
  vec3 e_v;                //  80  [m] Edge of the glass along v, car axes.
  float padding_3;         //  92  padding
  vec3 origin;             //  96  [m] corrected: corner (0, 0) of the glass, car axes.
  float padding_4;         // 108  padding
  vec3 inverse_metric;     // 112  [1/m^2] as-published: 1 / |e_u|^2, 0, 1 / |e_v|^2; corrected: uu, uv and vv of the metric's inverse.
  float padding_5;         // 124  padding
} u;
struct GlassFrame {
  vec2 gravity;       //   0  [1/s^2] as-published: gravity; corrected: specific force at (0, 0), the car's motion included.
  vec2 wind;          //   8  [1/s] Apparent wind.
  vec2 acceleration;  //  16  [1/s^2] as-published: of the vehicle; corrected: 0.
  uint id;            //  24  [1] 0.
  float padding_0;    //  28  padding
  vec4 spin;          //  32  [1/s^2] corrected: specific force per glass coordinate, rows u and v.
  vec4 coriolis;      //  48  [1/s] corrected: specific force per velocity, rows u and v.
};
layout(std430, binding = 1) writeonly buffer GlassFrameBuffer {
  uint count;
  uint padding[3];
  GlassFrame frame;
};

vec3 apparent_wind() {
  vec3 w = u.world_wind - u.vehicle_velocity;
  float c = u.heading.x, s = u.heading.y;
  return vec3(c * w.x + s * w.y, c * w.y - s * w.x, w.z);
}
void give(vec2 gravity, vec2 wind, vec2 acceleration, vec4 spin, vec4 coriolis) {
  count = 1u;
  frame = GlassFrame(gravity, wind, acceleration, 0u, 0.0, spin, coriolis);
}
