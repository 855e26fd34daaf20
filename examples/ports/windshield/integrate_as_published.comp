// windshield.integrate, as-published. Forces, motion, evaporation and age of every drop.
#version 450
#extension GL_GOOGLE_include_directive : enable
#define DROPS_OUT 3
#include "drops.glsl"

layout(std140, binding = 0) uniform IntegrateUniforms {
  vec3 frame;              //   0  [m] corrected: x = frame.x u + frame.y v and y = frame.z v in the plane of the glass.
  float dt;                //  12  [s] The step.
  float inertia_coupling;  //  16  [1] as-published: share of the vehicle's acceleration.
  float wind_coupling;     //  20  [1/s] as-published: acceleration by a unit of wind.
  float drag;              //  24  [1/s] as-published: rate of slowing down; corrected: that times mass^(2/3).
  float wind_push;         //  28  [1/m] corrected: acceleration over wind speed squared, times mass^(1/3).
  float hold;              //  32  [m/s^2] corrected: acceleration that hysteresis holds, times mass^(2/3).
  float evaporation;       //  36  [1/s] corrected: mass units lost in a second over mass^(1/3).
  float margin;            //  40  [1] corrected: how far outside the glass a drop lives.
  float rest_speed;        //  44  [m/s] corrected: a held drop below this speed rests.
  float phase_rate;        //  48  [1] corrected: turns in 64 s of the phase that rounds losses.
  float padding_0;         //  52  padding
  float padding_1;         //  56  padding
  float padding_2;         //  60  padding
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
layout(std430, binding = 2) readonly buffer GlassFrameBuffer { GlassFrame frame; };

void main() {
  if (gl_LocalInvocationIndex == 0u) count = 0u;
  memoryBarrierBuffer();
  barrier();
  for (uint i = gl_LocalInvocationIndex; i < drops.length(); i += workers) {
    Drop d = drops[i];
    if (d.life <= 0.0) continue;
    vec2 inertia = frame.acceleration * u.inertia_coupling;
    vec2 a = frame.gravity * d.mass - inertia + frame.wind * u.wind_coupling - d.velocity * u.drag;
    d.velocity += a * u.dt;
    d.position += d.velocity * u.dt;
    d.life -= u.dt;
    if (d.life > 0.0) append(d);
  }
}
