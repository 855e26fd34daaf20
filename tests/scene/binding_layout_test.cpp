// Images in each language, and lists as textures where a shader has no storage buffers.
#include "scene/binding_layout.h"

#include <gtest/gtest.h>

#include "scene/example_effect.h"

namespace rainref::scene {
namespace {

// 24 bytes: a texel and a half, with a gap within the first.
struct Ripple {
  float centre[2];
  std::int32_t kind;
  float padding0;
  float speed;
  std::uint32_t id;
};
UniformBlock ripple() {
  return record<Ripple>({
      member<&Ripple::centre>("texel", "Centre."),
      member<&Ripple::kind>("1", "Kind."),
      member<&Ripple::speed>("texel/s", "Speed."),
      member<&Ripple::id>("1", "Stable id."),
  });
}
const ListBinding read_list{"ripples", "Ripple"}, written_list{"ripples_out", "Ripple", true};

TEST(BindingLayout, AListInTexelsOfGlslLoadsTheStruct) {
  EXPECT_EQ(
      list_in_texels(read_list, ripple(), Language::glsl330),
      R"(// ripples: row i of an RGBA32UI texture of 2 columns is record i of 24 bytes and 8 of padding; an empty list is a row of zeros.
uniform usampler2D ripples;
int ripples_rows() { return textureSize(ripples, 0).y; }
Ripple ripples_at(int i) {
  uvec4 texel_0 = texelFetch(ripples, ivec2(0, i), 0);
  uvec4 texel_1 = texelFetch(ripples, ivec2(1, i), 0);
  return Ripple(uintBitsToFloat(texel_0.xy), int(texel_0.z), uintBitsToFloat(texel_0.w), uintBitsToFloat(texel_1.x), texel_1.y);
}
)");
}
TEST(BindingLayout, AListInTexelsOfGodotLoadsEachMember) {
  EXPECT_EQ(list_in_texels(read_list, ripple(), Language::gdshader),
            R"(// ripples: row i of an RGBAF texture of 2 columns is record i of 24 bytes and 8 of padding; an empty list is a row of zeros.
uniform sampler2D ripples;
int ripples_rows() { return textureSize(ripples, 0).y; }
vec2 ripples_centre(int i) { return texelFetch(ripples, ivec2(0, i), 0).xy; }  // [texel] Centre.
int ripples_kind(int i) { return floatBitsToInt(texelFetch(ripples, ivec2(0, i), 0).z); }  // [1] Kind.
float ripples_speed(int i) { return texelFetch(ripples, ivec2(1, i), 0).x; }  // [texel/s] Speed.
uint ripples_id(int i) { return floatBitsToUint(texelFetch(ripples, ivec2(1, i), 0).y); }  // [1] Stable id.
)");
}
TEST(BindingLayout, AListThatAFragmentShaderCannotWriteIsSaidToBe) {
  for (const Language language : {Language::glsl330, Language::gdshader})
    EXPECT_EQ(list_in_texels(written_list, ripple(), language), "// ripples_out: a list of Ripple, which a fragment shader cannot write\n");
}

TEST(BindingLayout, ImagesInEachLanguage) {
  const std::vector<ImageBinding> images{{"wave", "rg16f", false, {1, 0}},
                                         {"ids", "r32ui", false, {2, 1}},
                                         {"wave_out", "rg16f", true, {3, 0}},
                                         {"mask", "puddle.mask_storage", true, {4, 1}}};
  const auto text = [&](Language language, bool by_fragments = true) { return image_layout(images, "wave_step", by_fragments, language); };
  EXPECT_EQ(text(Language::glsl), R"(layout(binding = 1) uniform sampler2D wave;
layout(binding = 2) uniform usampler2D ids;
layout(binding = 3) uniform writeonly image2D wave_out;
layout(binding = 4) uniform writeonly image2D mask;
)");
  EXPECT_EQ(text(Language::hlsl), R"(Texture2D<float4> wave : register(t0);
SamplerState wave_sampler : register(s0);
Texture2D<uint> ids : register(t1);
SamplerState ids_sampler : register(s1);
RWTexture2D<float4> wave_out : register(u0);
RWTexture2D<float4> mask : register(u1);
)");
  EXPECT_EQ(text(Language::glsl330), R"(uniform sampler2D wave;
uniform usampler2D ids;
layout(location = 0) out vec4 wave_out;
layout(location = 1) out vec4 mask;
)");
  EXPECT_EQ(text(Language::gdshader), R"(uniform sampler2D wave;
uniform usampler2D ids;
// COLOR of a viewport of its own: wave_out
// COLOR of a viewport of its own: mask
)");
  EXPECT_EQ(text(Language::wgsl), R"(@group(0) @binding(1) var wave : texture_2d<f32>;
@group(0) @binding(17) var wave_sampler : sampler;
@group(0) @binding(2) var ids : texture_2d<u32>;
@group(0) @binding(18) var ids_sampler : sampler;
struct WaveStepOutputs {  // of a @fragment shader, one for each texel
  @location(0) wave_out : vec4<f32>,
  @location(1) mask : vec4<f32>,
}
)");
  // A compute shader stores what WGSL can store.
  const std::vector<ImageBinding> stored{{"film", "r32f", true, {1, 0}}, {"wave_out", "rg16f", true, {2, 1}}};
  EXPECT_EQ(image_layout(stored, "wipe_drops", false, Language::wgsl),
            R"(@group(0) @binding(1) var film : texture_storage_2d<r32float, write>;
// binding 2: wave_out, which core WGSL cannot store as rg16f
)");
  for (const Language language : {Language::c, Language::cuda}) EXPECT_EQ(text(language), "");
}

}  // namespace
}  // namespace rainref::scene
