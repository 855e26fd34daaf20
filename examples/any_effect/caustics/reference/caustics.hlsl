// Caustics, pass caustics: where the vertical ray through each texel of the water lands, and how much denser the light is there: the area
// that the rays of its neighbours span on the water, over the area that they span on the floor.
[[vk::binding(0)]] cbuffer Caustics {
  float3 eye;        //   0  [1] Unit vector to the eye; z is up.
  float depth;       //  12  [texel] Of still water.
  float ior;         //  16  [1] Refractive index of the water.
  float least_area;  //  20  [1] Smaller areas count as this share of the area before.
  float padding_0;   //  24  padding
  float padding_1;   //  28  padding
};
[[vk::binding(1)]] Texture2D<float2> wave;                            // height [texel], velocity [texel/step]
[[vk::binding(2)]] [[spv::format_rgba16f]] RWTexture2D<float4> rays;  // shift to the floor [texel], density of light, share that enters
[[vk::binding(3)]] [[spv::format_r32f]] RWTexture2D<float> mirror;    // share of the light that the water reflects to the eye

static int2 last;  // texel

float height(int2 texel) { return wave.Load(int3(clamp(texel, int2(0, 0), last), 0)).x; }

float3 normal(int2 texel) {
  float left = height(texel - int2(1, 0)), right = height(texel + int2(1, 0));
  float above = height(texel - int2(0, 1)), below = height(texel + int2(0, 1));
  return normalize(float3(left - right, above - below, 2.0));
}

// From a texel to the place on the floor that its ray lands on, seen from above.
float2 shift(int2 texel) {
  float3 ray = refract(float3(0.0, 0.0, -1.0), normal(texel), 1.0 / ior);
  return ray.xy * ((depth + height(texel)) / -ray.z);
}
float2 landing(int2 texel) { return float2(texel) + shift(texel); }

// Schlick's approximation of the share that is reflected.
float reflected(float cosine) {
  float least = (ior - 1.0) / (ior + 1.0);
  float m = 1.0 - saturate(cosine);
  float m2 = m * m;
  return lerp(m2 * m2 * m, 1.0, least * least);
}

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID) {
  uint2 size;
  rays.GetDimensions(size.x, size.y);
  if (any(id.xy >= size)) return;
  last = int2(size) - 1;

  int2 here = int2(id.xy), low = max(here - 1, int2(0, 0)), high = min(here + 1, last);
  float2 across = landing(int2(high.x, here.y)) - landing(int2(low.x, here.y));
  float2 along = landing(int2(here.x, high.y)) - landing(int2(here.x, low.y));
  float before = float((high.x - low.x) * (high.y - low.y));
  float after = abs(across.x * along.y - across.y * along.x);
  float density = before / max(after, least_area * before);

  float3 up = normal(here);
  rays[id.xy] = float4(shift(here), density, 1.0 - reflected(up.z));
  mirror[id.xy] = reflected(dot(up, eye));
}
