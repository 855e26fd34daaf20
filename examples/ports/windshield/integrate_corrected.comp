// windshield.integrate, corrected. Forces, motion, evaporation and age of every drop.
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

float length_on_glass(vec2 a) { return length(vec2(u.frame.x * a.x + u.frame.y * a.y, u.frame.z * a.y)); }
vec2 times(vec4 rows, vec2 a) { return vec2(rows.x * a.x + rows.y * a.y, rows.z * a.x + rows.w * a.y); }

// e^-x, and the shares of velocity and way: (1 - e^-x) / x and (1 - that) / x.
vec3 decay_of(float x) {
  float speed = exp(-x);
  if (x < 0.125) {
    float g = 0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x * (1.0 / 720.0))));
    return vec3(speed, 1.0 - x * g, g);
  }
  float mean = (1.0 - speed) / x;
  return vec3(speed, mean, (1.0 - mean) / x);
}

void main() {
  if (gl_LocalInvocationIndex == 0u) count = 0u;
  memoryBarrierBuffer();
  barrier();
  for (uint i = gl_LocalInvocationIndex; i < drops.length(); i += workers) {
    Drop d = drops[i];
    if (d.life <= 0.0) continue;
    float mass_3 = pow(max(d.mass, 1.0), 1.0 / 3.0), inverse = 1.0 / mass_3, inverse_sq = inverse * inverse;

    float push = u.wind_push * length_on_glass(frame.wind) * inverse;
    vec2 spin = times(frame.spin, d.position);
    vec2 coriolis = times(frame.coriolis, d.velocity);
    vec2 a = frame.gravity + spin + coriolis + push * frame.wind;
    float pull = max(length_on_glass(a), 1e-6);
    float share = max(1.0 - (u.hold * inverse_sq) / pull, 0.0);
    vec2 pushed = (a * share) * u.dt;
    vec3 decay = decay_of(u.drag * inverse_sq * u.dt);
    vec2 velocity = d.velocity * decay.x + pushed * decay.y;
    vec2 position = d.position + (d.velocity * decay.y + pushed * decay.z) * u.dt;
    bool rests = share <= 0.0 && length_on_glass(velocity) < u.rest_speed;

    float life = d.life - u.dt;
    float loss = u.evaporation * mass_3 * u.dt, phase = fract(fract(d.life / 64.0) * u.phase_rate);
    float mass = max(d.mass - floor(loss + phase), 0.0);
    bool inside = all(greaterThanEqual(position, vec2(-u.margin))) && all(lessThanEqual(position, vec2(1.0 + u.margin)));
    if (!(life > 0.0 && mass > 0.0 && inside)) continue;
    append(Drop(position, rests ? vec2(0.0) : velocity, mass, life, d.id, 0.0));
  }
}
