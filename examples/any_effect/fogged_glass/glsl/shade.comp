// fogged_glass.shade in GLSL: one drop after the other changes what is seen.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

layout(std140, binding = 0) uniform Shade {
  float blur;       //   0  [1] Mip level of the background behind full fog.
  float lens;       //   4  [1] How far the middle of a drop moves the place that is seen, in distances from the middle.
  float rim_light;  //   8  [1] Light on the beads of water at the rim of the fog.
  int drop_count;   //  12  [1] Drops in the list.
  vec3 fog_colour;  //  16  [1] Light that the fog scatters, linear RGB.
  float veil;       //  28  [1] Share of the light that full fog replaces by its own.
} u;
struct Drop {
  vec2 position;   //   0  [texel] Centre; texel centres lie at k + 1/2.
  vec2 velocity;   //   8  [texel/s] Of the slide that led here.
  float radius;    //  16  [texel] 0: there is no drop.
  float strength;  //  20  [1] Share of the fog that the drop takes.
};
layout(binding = 1) uniform sampler2D fog;
layout(binding = 2) uniform sampler2D background;
layout(std430, binding = 3) readonly buffer DropBuffer { Drop drops[]; };
layout(binding = 4, rgba8) uniform writeonly image2D picture;

const vec2 LAMP = vec2(0.3, 0.4);  // from the reflection of the lamp to the drop's middle, in radii

void look_through(Drop drop, vec2 place, inout vec2 seen_at, inout float dry, inout float shine) {
  vec2 arm = place - drop.position;
  vec2 unit = arm / drop.radius;
  float q = dot(unit, unit);
  if (q < 1.0) {
    float dome = sqrt(1.0 - q);
    seen_at -= arm * (u.lens * dome);
    dry = min(dry, smoothstep(0.6, 1.0, q));
    vec2 d = unit + LAMP;
    shine += exp(dot(d, d) * -18.0) * dome;
  }
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = textureSize(fog, 0);
  if (any(greaterThanEqual(texel, size))) return;

  vec2 place = vec2(texel) + 0.5, seen_at = place;
  float dry = 1.0, shine = 0.0;
  for (int i = 0; i < u.drop_count; ++i) {
    if (drops[i].radius > 0.0) look_through(drops[i], place, seen_at, dry, shine);
  }

  float mist = dry * texelFetch(fog, texel, 0).r;
  vec3 light = textureLod(background, seen_at / vec2(size), mist * u.blur).rgb;

  ivec2 low = max(texel - 1, 0), high = min(texel + 1, size - 1);
  float to_right = texelFetch(fog, ivec2(high.x, texel.y), 0).r - texelFetch(fog, ivec2(low.x, texel.y), 0).r;
  float downwards = texelFetch(fog, ivec2(texel.x, high.y), 0).r - texelFetch(fog, ivec2(texel.x, low.y), 0).r;
  float beads = max(downwards + 0.5 * to_right, 0.0) * u.rim_light;

  light = mix(light, u.fog_colour, u.veil * mist);
  light += beads + shine;
  imageStore(picture, texel, vec4(sqrt(clamp(light, 0.0, 1.0)), 1.0));
}
