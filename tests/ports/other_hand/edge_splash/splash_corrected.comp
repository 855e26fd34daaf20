// edge_splash.splash, corrected. Masks of the splashes, and the scene with splashes on it.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

layout(std140, binding = 0) uniform SplashUniforms {
  vec4 drop_color;    //   0  [1] Linear RGB and opacity of the drops.
  vec3 up;            //  16  [1] Unit vector that points up, camera axes: right, up, forward.
  float reach;        //  28  [texel] Texels that the band covers at 1 m.
  vec2 pixel;         //  32  [1] Extent of a pixel on the image plane at distance 1.
  vec2 half_size;     //  40  [1] Half the extent of the image plane at distance 1.
  float depth_scale;  //  48  [1/m] 1 / z = depth_scale d + depth_bias.
  float depth_bias;   //  52  [1/m] See depth_scale.
  float reach_min;    //  56  [texel] Smallest reach of the taps.
  float reach_max;    //  60  [texel] Largest reach of the taps; whole.
  float step_low;     //  64  [m] Sobel sum of distances at which an edge begins.
  float step_high;    //  68  [m] Sobel sum from which it is whole.
  float bend_low;     //  72  [1] Bend at which an edge begins.
  float bend_high;    //  76  [1] Bend from which it is whole.
  float cosine_low;   //  80  [1] Cosine between an edge's normal and up at which the mask begins.
  float cosine_high;  //  84  [1] Cosine from which it is whole.
  float noise_low;    //  88  [1] Noise at which a drop begins.
  float noise_high;   //  92  [1] Noise from which it is whole.
  vec2 noise_scale;   //  96  [1] Texture coordinates of the noise in a pixel.
  vec2 noise_offset;  // 104  [1] Texture coordinates that the noise has scrolled, in [0, 1).
} given;
layout(binding = 1) uniform sampler2D scene;
layout(binding = 2) uniform sampler2D depth;
layout(binding = 3) uniform sampler2D noise_map;
layout(binding = 4) uniform sampler2D layer;
layout(binding = 5) uniform writeonly image2D edge;
layout(binding = 6) uniform writeonly image2D angle;
layout(binding = 7) uniform writeonly image2D noise;
layout(binding = 8) uniform writeonly image2D colour;

ivec2 extent = textureSize(depth, 0);

// 1 / z of a place; beyond the picture that of the edge.
float nearness(ivec2 place) {
  float stored = texelFetch(depth, clamp(place, ivec2(0), extent - 1), 0).r;
  return given.depth_scale * stored + given.depth_bias;
}
float ramp(float low, float high, float x) {
  float t = clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(here, extent))) return;
  vec2 centre = vec2(here) + 0.5;
  float own = nearness(here);

  int wide = int(given.reach_max);
  float nearest = own;
  for (int k = -1; k <= 1; k += 2) nearest = max(nearest, max(nearness(here + ivec2(k * wide, 0)), nearness(here + ivec2(0, k * wide))));
  float reach = clamp(given.reach * nearest, given.reach_min, given.reach_max);
  int r = int(floor(reach + 0.5));

  // Sobel's sums, place by place; a place in the middle of a side counts twice.
  vec2 gradient = vec2(0.0);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      float z = 1.0 / nearness(here + r * ivec2(dx, dy));
      ivec2 weight = ivec2(dx * (2 - abs(dy)), dy * (2 - abs(dx)));
      gradient += z * vec2(weight);
    }
  }
  float steep = length(gradient);

  vec2 before = vec2(nearness(here - ivec2(r, 0)), nearness(here - ivec2(0, r)));
  vec2 after = vec2(nearness(here + ivec2(r, 0)), nearness(here + ivec2(0, r)));
  vec2 second = abs((before + after) - 2.0 * own);
  vec2 larger = max(before, after);
  float largest = max(max(larger.x, larger.y), own);
  float bend = max(second.x, second.y) / largest;
  float edge_here = ramp(given.step_low, given.step_high, steep) * ramp(given.bend_low, given.bend_high, bend);

  vec2 sight = centre * given.pixel - given.half_size;
  vec2 rain = given.up.xy - sight * given.up.z;
  float cosine = dot(gradient, rain) / max(steep, given.step_low) / max(length(rain), 1e-4);
  float angle_here = ramp(given.cosine_low, given.cosine_high, cosine);

  float grain = textureLod(noise_map, centre * given.noise_scale + given.noise_offset, 0.0).r;
  float noise_here = ramp(given.noise_low, given.noise_high, grain);

  vec4 behind = texelFetch(scene, here, 0);
  float paint = texelFetch(layer, here, 0).r * given.drop_color.a;
  float share = edge_here * angle_here * noise_here * paint;
  vec3 painted = mix(behind.rgb, given.drop_color.rgb, share);

  imageStore(edge, here, vec4(edge_here));
  imageStore(angle, here, vec4(angle_here));
  imageStore(noise, here, vec4(noise_here));
  imageStore(colour, here, vec4(painted, behind.a));
}
