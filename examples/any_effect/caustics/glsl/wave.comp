// caustics.wave in GLSL. The hollows of the drops come first, then the forces.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

layout(std140, binding = 0) uniform Wave {
  float pull;      //   0  [1] Share of the distance to its neighbours' mean that a texel gains as velocity in a step.
  float drag;      //   4  [1/s] Rate at which velocity is lost.
  float dt;        //   8  [s] Length of a step.
  int drop_count;  //  12  [1] Drops in the list.
} u;
struct Drop {
  vec2 position;  //   0  [texel] Centre; texel centres lie at k + 1/2.
  float radius;   //   8  [texel] Nothing is moved from this distance on.
  float depth;    //  12  [texel] Of the hollow, in its middle.
};
layout(binding = 1) uniform sampler2D wave;
layout(std430, binding = 2) readonly buffer DropBuffer { Drop drops[]; };
layout(binding = 3, rg32f) uniform writeonly image2D next_wave;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(next_wave);
  if (any(greaterThanEqual(texel, size))) return;

  float pushed = 0.0;
  for (int i = 0; i < u.drop_count; ++i) {
    float away = distance(vec2(texel) + 0.5, drops[i].position);
    if (away < drops[i].radius) pushed += drops[i].depth * (1.0 - smoothstep(0.0, drops[i].radius, away));
  }

  const ivec2 TO[4] = ivec2[4](ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1));
  float sum = 0.0;
  for (int k = 0; k < 4; ++k) sum += texelFetch(wave, clamp(texel + TO[k], ivec2(0), size - 1), 0).x;
  vec2 old = texelFetch(wave, texel, 0).xy;
  float velocity = exp(-(u.drag * u.dt)) * (old.y + u.pull * (0.25 * sum - old.x));
  imageStore(next_wave, texel, vec4(old.x + velocity - pushed, velocity, 0.0, 0.0));
}
