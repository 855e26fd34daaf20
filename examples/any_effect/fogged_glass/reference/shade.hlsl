// Fogged glass, pass shade: what lies behind the pane, blurred and veiled by the fog, sharp and upside down in the drops.
[[vk::binding(0)]] cbuffer Shade {
  float blur;         //   0  [1] Mip level of the background behind full fog.
  float lens;         //   4  [1] How far the middle of a drop moves the place that is seen, in distances from the middle.
  float rim_light;    //   8  [1] Light on the beads of water at the rim of the fog.
  int drop_count;     //  12  [1] Drops in the list.
  float3 fog_colour;  //  16  [1] Light that the fog scatters, linear RGB.
  float veil;         //  28  [1] Share of the light that full fog replaces by its own.
};
struct Drop {
  float2 position;  //   0  [texel] Centre; texel centres lie at k + 1/2.
  float2 velocity;  //   8  [texel/s] Of the slide that led here.
  float radius;     //  16  [texel] 0: there is no drop.
  float strength;   //  20  [1] Share of the fog that the drop takes.
};
[[vk::binding(1)]] Texture2D<float> fog;
[[vk::binding(2)]] Texture2D<float4> background;
[[vk::binding(2)]] SamplerState background_sampler;  // one combined image sampler: DXC wants [[vk::combinedImageSampler]] at both
[[vk::binding(3)]] StructuredBuffer<Drop> drops;
[[vk::binding(4)]] [[spv::format_rgba8]] RWTexture2D<unorm float4> picture;

static const float2 spark_place = float2(-0.3, -0.4);  // of the lamp's reflection, in radii from a drop's middle
static const float spark_falloff = 18.0;

struct Water {
  float2 bend;  // [texel] from the texel to the place that is seen
  float cover;  // [1] how much of the texel a drop covers
  float spark;  // [1] light that drops reflect
};

// Each drop is a dome: its thickness is 1 in the middle and 0 at the rim.
Water water_at(float2 here) {
  Water water = {float2(0.0, 0.0), 0.0, 0.0};
  for (int i = 0; i < drop_count; ++i) {
    Drop drop = drops[i];
    if (drop.radius <= 0.0) continue;
    float2 offset = (here - drop.position) / drop.radius;
    float q = dot(offset, offset);
    if (q >= 1.0) continue;
    float thickness = sqrt(1.0 - q);
    float2 to_spark = offset - spark_place;
    water.bend -= lens * thickness * drop.radius * offset;
    water.cover = max(water.cover, 1.0 - smoothstep(0.6, 1.0, q));
    water.spark += thickness * exp(-spark_falloff * dot(to_spark, to_spark));
  }
  return water;
}

float fog_at(int2 texel, int2 last) { return fog.Load(int3(clamp(texel, int2(0, 0), last), 0)); }

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID) {
  uint2 size;
  picture.GetDimensions(size.x, size.y);
  if (id.x >= size.x || id.y >= size.y) return;

  int2 texel = int2(id.xy), last = int2(size) - 1;
  float2 here = float2(texel) + 0.5;
  Water water = water_at(here);
  float haze = fog_at(texel, last) * (1.0 - water.cover);
  float3 seen = background.SampleLevel(background_sampler, (here + water.bend) / float2(size), blur * haze).rgb;

  // Light from above and from the left stands in the beads where the fog begins.
  float2 slope = float2(fog_at(texel + int2(1, 0), last) - fog_at(texel - int2(1, 0), last),
                        fog_at(texel + int2(0, 1), last) - fog_at(texel - int2(0, 1), last));
  float rim = rim_light * max(0.5 * slope.x + slope.y, 0.0);

  float3 colour = lerp(seen, fog_colour, veil * haze) + rim + water.spark;
  picture[id.xy] = float4(sqrt(saturate(colour)), 1.0);
}
