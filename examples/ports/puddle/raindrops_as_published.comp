// puddle.raindrops, as-published. The drops that fall in this step.
#version 450
// One workgroup draws all drops: record i is drop i.
layout(local_size_x = 64) in;

layout(std140, binding = 0) uniform RaindropsUniforms {
  float time;            //   0  [s] Frame number over frame rate, rounded once.
  float rain_speed;      //   4  [1/s] Pulses of each drop a second.
  float drop_intensity;  //   8  [1] Strength of an impact.
  float padding_0;       //  12  padding
  float width;           //  16  [texel] Columns of the wave.
  float height;          //  20  [texel] Rows of the wave.
  int drop_count;        //  24  [1] Drops in the list.
  float padding_1;       //  28  padding
} u;
struct Drop {
  float x;          //   0  [texel] Centre; texel centres lie at k + 1/2.
  float y;          //   4  [texel] Centre.
  float amplitude;  //   8  [1] as-published: strength times activation; corrected: stored height at the centre.
  float radius;     //  12  [texel] Nothing is added from this distance on.
};
layout(std430, binding = 1) buffer DropBuffer {
  uint count;
  uint padding[3];
  Drop drops[];
};

// q of both hashes.
vec3 spread(vec2 at, vec3 scale) {
  vec3 p = fract(at.xyx * scale);
  return p + dot(p, p.yzx + 33.33);
}
vec2 hash22(vec2 at) {
  vec3 q = spread(at, vec3(0.1031, 0.1030, 0.0973));
  return fract(vec2((q.x + q.y) * q.z, (q.x + q.z) * q.y));
}
float hash12(vec2 at) {
  vec3 q = spread(at, vec3(0.1031));
  return fract((q.x + q.y) * q.z);
}
// smoothstep with falling edges, which GLSL leaves undefined.
float falling(float from, float to, float x) {
  float t = clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

void main() {
  if (gl_LocalInvocationIndex == 0u) count = uint(u.drop_count);
  float t = u.time * u.rain_speed;
  for (int i = int(gl_LocalInvocationIndex); i < u.drop_count; i += int(gl_WorkGroupSize.x)) {
    float offset = float(i) * 0.3711;
    vec2 seed = vec2(floor(t) + offset, float(i) * 17.3), place = hash22(seed);
    float strength = u.drop_intensity * (0.5 + 0.5 * hash12(seed + 1.0)), pulse = fract(t + offset * 0.7);
    float activation = smoothstep(0.0, 0.15, pulse) * falling(0.35, 0.2, pulse);
    drops[i] = Drop(place.x * u.width, place.y * u.height, strength * activation, 4.0);
  }
}
