// The corrected display in HLSL: exposure, a vignette that ends at black, sRGB.
[[vk::binding(0)]] cbuffer DisplayUniforms {
  float vignette;  //   0  [1] Loss at distance 1 from the centre.
  float exposure;  //   4  [1] corrected: factor of the radiance.
  float width;     //   8  [pixel] Columns of the picture.
  float height;    //  12  [pixel] Rows of the picture.
};
[[vk::binding(1)]] Texture2D<float4> colour;
// glslang takes the format from here; DXC has [[vk::image_format("rgba8")]].
[[vk::binding(2)]] [[spv::format_rgba8]] RWTexture2D<unorm float4> picture;

float3 encode_srgb(float3 radiance) {
  float3 curve = 1.055 * pow(radiance, 1.0 / 2.4) - 0.055;
  return lerp(curve, 12.92 * radiance, float3(radiance <= 0.0031308));
}

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID) {
  if (id.x >= uint(width) || id.y >= uint(height)) return;
  float2 offset = (float2(id.xy) + 0.5) / float2(width, height) - 0.5;
  float light = max(1.0 - vignette * length(offset), 0.0) * exposure;
  float3 radiance = saturate(light * colour.Load(int3(id.xy, 0)).rgb);
  picture[id.xy] = float4(encode_srgb(radiance), 1.0);
}
