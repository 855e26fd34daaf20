// fogged_glass.fog in GLSL. It follows each drop back from where it is now.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

layout(std140, binding = 0) uniform Fog {
  float dt;             //   0  [s] Time since the last run.
  float regrow_time;    //   4  [s] After this time a wiped place lacks 1/e of its fog.
  float rim;            //   8  [texel] Width of the soft rim of what a drop wipes.
  int drop_count;       //  12  [1] Drops in the list.
  float fog_at_top;     //  16  [1] Share of the pane that is fogged at last, at its upper edge.
  float fog_at_bottom;  //  20  [1] The same at its lower edge.
  float trail;          //  24  [1] Radius of a trail where it begins, in radii of its drop.
  float padding_0;      //  28  padding
} u;
struct Drop {
  vec2 position;   //   0  [texel] Centre; texel centres lie at k + 1/2.
  vec2 velocity;   //   8  [texel/s] Of the slide that led here.
  float radius;    //  16  [texel] 0: there is no drop.
  float strength;  //  20  [1] Share of the fog that the drop takes.
};
layout(binding = 1) uniform sampler2D fog;
layout(std430, binding = 2) readonly buffer DropBuffer { Drop drops[]; };
layout(binding = 3, r32f) uniform writeonly image2D next_fog;

// How deep a place lies in what the drop wiped: 0 beyond its edge, 1 within the rim.
float wiped(Drop drop, vec2 place) {
  vec2 back = place - drop.position, slide = u.dt * drop.velocity;
  float slide_sq = dot(slide, slide);
  float age = slide_sq > 0.0 ? clamp(-dot(back, slide) / slide_sq, 0.0, 1.0) : 0.0;  // 0 now, 1 at the last run
  float reach = mix(drop.radius, u.trail * drop.radius, age);
  return 1.0 - smoothstep(reach - u.rim, reach, distance(back, -age * slide));
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(next_fog);
  if (texel.x >= size.x || texel.y >= size.y) return;
  vec2 place = vec2(texel) + 0.5;

  float left = 1.0;  // by all drops
  for (int i = 0; i < u.drop_count; ++i) {
    if (drops[i].radius > 0.0) left *= 1.0 - drops[i].strength * wiped(drops[i], place);
  }

  float full = mix(u.fog_at_top, u.fog_at_bottom, smoothstep(0.0, float(size.y), place.y));
  float before = texelFetch(fog, texel, 0).r;
  float grown = mix(full, before, exp(-(u.dt / u.regrow_time)));
  imageStore(next_fog, texel, vec4(grown * left));
}
