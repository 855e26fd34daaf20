// caustics.caustics in GLSL. Snell's law for a vertical ray, written out; areas from how the shifts of neighbours differ.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

layout(std140, binding = 0) uniform Caustics {
  vec3 eye;          //   0  [1] Unit vector to the eye; z is up.
  float depth;       //  12  [texel] Of still water.
  float ior;         //  16  [1] Refractive index of the water.
  float least_area;  //  20  [1] Smaller areas count as this share of the area before.
  float padding_0;   //  24  padding
  float padding_1;   //  28  padding
} u;
layout(binding = 1) uniform sampler2D wave;
layout(binding = 2, rgba16f) uniform writeonly image2D rays;
layout(binding = 3, r32f) uniform writeonly image2D mirror;

float level(ivec2 texel) { return texelFetch(wave, clamp(texel, ivec2(0), textureSize(wave, 0) - 1), 0).x; }

// The surface is z = level(x, y): twice its gradient downhill, and twice one.
vec3 upright(ivec2 t) {
  vec3 n = vec3(level(t - ivec2(1, 0)) - level(t + ivec2(1, 0)), level(t - ivec2(0, 1)) - level(t + ivec2(0, 1)), 2.0);
  return n / length(n);
}

vec2 bent(ivec2 t) {
  vec3 n = upright(t);
  float eta = 1.0 / u.ior;
  // The cosine to the ray that falls along -z is n.z; within the water it is inner.
  float inner = sqrt(1.0 - eta * eta * (1.0 - n.z * n.z));
  float turn = eta * n.z - inner;
  float drop = eta - turn * n.z;  // of the refracted ray, for one unit of length
  return n.xy * turn * (u.depth + level(t)) / drop;
}

float schlick(float cosine) {
  float root = (u.ior - 1.0) / (u.ior + 1.0), r0 = root * root;
  float grazing = 1.0 - clamp(cosine, 0.0, 1.0);
  float square = grazing * grazing;
  return mix(square * square * grazing, 1.0, r0);
}

void main() {
  ivec2 t = ivec2(gl_GlobalInvocationID.xy), size = textureSize(wave, 0);
  if (any(greaterThanEqual(t, size))) return;

  ivec2 a = max(t - 1, ivec2(0)), b = min(t + 1, size - 1), sides = b - a;
  vec2 dx = vec2(sides.x, 0) + (bent(ivec2(b.x, t.y)) - bent(ivec2(a.x, t.y)));
  vec2 dy = vec2(0, sides.y) + (bent(ivec2(t.x, b.y)) - bent(ivec2(t.x, a.y)));
  float old_area = float(sides.x) * float(sides.y);
  float new_area = abs(determinant(mat2(dx, dy)));

  vec3 n = upright(t);
  float density = old_area / max(new_area, u.least_area * old_area);
  imageStore(rays, t, vec4(bent(t), density, 1.0 - schlick(n.z)));
  imageStore(mirror, t, vec4(schlick(dot(u.eye, n))));
}
