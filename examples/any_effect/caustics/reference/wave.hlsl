// Caustics, pass wave: the next height and velocity of the water, and the hollows of the drops that fall into it.
[[vk::binding(0)]] cbuffer Wave {
  float pull;      //   0  [1] Share of the distance to its neighbours' mean that a texel gains as velocity in a step.
  float drag;      //   4  [1/s] Rate at which velocity is lost.
  float dt;        //   8  [s] Length of a step.
  int drop_count;  //  12  [1] Drops in the list.
};
struct Drop {
  float2 position;  //   0  [texel] Centre; texel centres lie at k + 1/2.
  float radius;     //   8  [texel] Nothing is moved from this distance on.
  float depth;      //  12  [texel] Of the hollow, in its middle.
};
[[vk::binding(1)]] Texture2D<float2> wave;  // height [texel], velocity [texel/step]
[[vk::binding(2)]] StructuredBuffer<Drop> drops;
[[vk::binding(3)]] [[spv::format_rg32f]] RWTexture2D<float2> next_wave;

float hollow(Drop drop, float2 here) {
  float away = length(here - drop.position);
  if (away >= drop.radius) return 0.0;
  return drop.depth * (1.0 - smoothstep(0.0, drop.radius, away));
}

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID) {
  uint2 size;
  next_wave.GetDimensions(size.x, size.y);
  if (any(id.xy >= size)) return;

  // Beyond the wall stands the same height as before it: waves come back.
  int2 here = int2(id.xy), last = int2(size) - 1;
  float left = wave.Load(int3(max(here.x - 1, 0), here.y, 0)).x;
  float right = wave.Load(int3(min(here.x + 1, last.x), here.y, 0)).x;
  float above = wave.Load(int3(here.x, max(here.y - 1, 0), 0)).x;
  float below = wave.Load(int3(here.x, min(here.y + 1, last.y), 0)).x;
  float2 water = wave.Load(int3(here, 0));
  float mean = (left + right + above + below) * 0.25;

  water.y += pull * (mean - water.x);
  water.y *= exp(-drag * dt);
  water.x += water.y;
  for (int i = 0; i < drop_count; ++i) water.x -= hollow(drops[i], float2(here) + 0.5);
  next_wave[id.xy] = water;
}
