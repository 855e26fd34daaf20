// Caustics, pass floor: a tiled floor below the water, lit through it, as an eye far away sees it.
[[vk::binding(0)]] cbuffer Floor {
  float3 absorption;  //   0  [1/texel] Of the water, linear RGB.
  float depth;        //  12  [texel] Of still water.
  float2 view;        //  16  [texel] From a texel to what the eye sees below it through still water.
  float tile;         //  24  [texel] Side of a tile.
  float ambient;      //  28  [1] Light that comes from everywhere; the sun's is 1.
  float3 sky;         //  32  [1] What the water mirrors, linear RGB.
  int rounds;         //  44  [1] Steps of the search for the ray that lands on a place.
};
[[vk::binding(1)]] Texture2D<float4> rays;
[[vk::binding(1)]] SamplerState rays_sampler;
[[vk::binding(2)]] Texture2D<float> mirror;
[[vk::binding(3)]] Texture2D<float4> tiles;
[[vk::binding(3)]] SamplerState tiles_sampler;
[[vk::binding(4)]] [[spv::format_rgba8]] RWTexture2D<unorm float4> picture;

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID) {
  uint2 size;
  picture.GetDimensions(size.x, size.y);
  if (id.x >= size.x || id.y >= size.y) return;

  // The waves bend the eye's ray as they bend the sun's.
  float2 way = view + rays.Load(int3(id.xy, 0)).xy;
  float2 seen = float2(id.xy) + 0.5 + way;

  // The sun's ray that lands there comes from where its own shift leads to this place.
  float2 source = seen;
  for (int i = 0; i < rounds; ++i) source = seen - rays.SampleLevel(rays_sampler, source / float2(size), 0.0).xy;
  float4 ray = rays.SampleLevel(rays_sampler, source / float2(size), 0.0);

  float3 light = tiles.SampleLevel(tiles_sampler, seen / tile, 0.0).rgb * (ambient + ray.z * ray.w);
  light *= exp(-absorption * (depth + length(float3(way, depth))));
  light = lerp(light, sky, mirror.Load(int3(id.xy, 0)));
  picture[id.xy] = float4(sqrt(saturate(light)), 1.0);
}
