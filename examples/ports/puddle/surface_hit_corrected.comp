// puddle.surface_hit, corrected. Where each pixel's view ray meets the water, and the normal there.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "surface_hit.glsl"
#include "camera.glsl"

layout(binding = 2) uniform sampler2D bounds;
layout(binding = 3) uniform writeonly image2D hit_image;
layout(binding = 4) uniform writeonly image2D normal_image;

float height(vec2 place) {
  vec2 stored = WAVE(place, ivec2(0));
  return u.height_scale * stored.x + u.height_bias;
}

// Narrows [enter, leave] to where the ray lies between -half_side and half_side.
void slab(float origin, float direction, float half_side, inout float enter, inout float leave) {
  float inverse = 1.0 / (abs(direction) < 1e-8 ? 1e-8 : direction);
  float a = (-half_side - origin) * inverse, b = (half_side - origin) * inverse;
  enter = max(enter, min(a, b));
  leave = min(leave, max(a, b));
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(hit_image))) return;
  vec3 eye = u.camera_position, ray = view_ray(pixel);
  if (-ray.y <= 1e-4) {
    imageStore(hit_image, pixel, vec4(eye, 0.0));
    imageStore(normal_image, pixel, vec4(0.0, 1.0, 0.0, 0.0));
    return;
  }
  float fall = -ray.y, run = length(ray.xz), t_plane = eye.y / fall;
  vec2 start = eye.xz * u.inverse_size + 0.5, along = ray.xz * u.inverse_size;

  // Highest water and steepest slope that the ray can meet.
  vec2 crossing = start + t_plane * along;
  vec2 local = textureLod(bounds, crossing * u.bounds_scale, 0.0).xy;
  bool holds = local.x * run <= u.bounds_reach * fall &&
               all(greaterThanEqual(crossing, vec2(0.0))) && all(lessThanEqual(crossing, vec2(1.0)));
  float top = holds ? local.x : u.surface_top, slope = holds ? local.y : u.surface_slope;

  float enter = 0.0, leave = min((eye.y + top) / fall, 1e4);
  slab(eye.x, ray.x, u.half_size.x, enter, leave);
  slab(eye.z, ray.z, u.half_size.z, enter, leave);
  bool over_rectangle = enter <= t_plane;
  enter = max(enter, (eye.y - top) / fall);
  bool enters = enter < leave && over_rectangle;

  float climb = slope * run;
  float stride = 1.0 / (fall + climb), back = 1.0 / max(climb - fall, 1e-4), bold = 1.0 / (fall + 0.5 * climb);
  float t = enters ? enter : t_plane, gap = 0.0, move = 0.0, steps = 0.0;
  if (enters) {
    for (int i = 0; i < u.max_steps; ++i) {
      float next_t = t + move;
      float next_gap = eye.y + next_t * ray.y - height(start + next_t * along);
      float safe = gap * stride;
      bool proven = move <= safe + max(next_gap, 0.0) * back;
      steps = float(i);
      if (proven) {
        t = next_t;
        gap = next_gap;
        move = next_gap * bold;
        if (next_gap < u.epsilon || next_t >= leave) break;
      } else {
        move = safe;
      }
    }
  }

  bool on_water = enters && t < leave;
  if (!on_water) t = t_plane;
  vec3 normal = vec3(0.0, 1.0, 0.0);
  if (on_water) {
    // The neighbours of the nearest place between texel centres: beyond the outermost ones clamp alone would not do.
    vec2 place = clamp(start + t * along, 0.5 * u.texel, 1.0 - 0.5 * u.texel);
    float left = WAVE(place, ivec2(-1, 0)).x, right = WAVE(place, ivec2(1, 0)).x;
    float down = WAVE(place, ivec2(0, -1)).x, up = WAVE(place, ivec2(0, 1)).x;
    float gain = u.normal_gain * u.height_scale;
    vec2 tilt = gain * vec2(left - right, down - up);
    // One step of Newton's method, not along a flank and not where the ray entered under the water.
    float closing = fall - dot(tilt, ray.xz), least = 0.5 * fall;
    bool close = gap < u.epsilon && gap >= 0.0 && closing >= least;
    if (close) t += gap * min(1.0 / closing, 2.0 * stride);
    normal = normalize(vec3(tilt.x, 1.0, tilt.y));
  }
  vec3 position = eye + t * ray;
  imageStore(hit_image, pixel, vec4(position, steps));
  imageStore(normal_image, pixel, vec4(normal, 1.0));
}
