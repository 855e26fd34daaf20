#include "scene/binding_layout.h"

#include <algorithm>

#include <fmt/format.h>

namespace rainref::scene {
namespace {

// "count_thresholds" -> "CountThresholds"
std::string camel_case(const std::string& snake) {
  std::string out;
  for (std::size_t i = 0; i < snake.size(); ++i) {
    const bool is_first = i == 0 || snake[i - 1] == '_';
    if (snake[i] != '_') out += is_first ? static_cast<char>(snake[i] - 'a' + 'A') : snake[i];
  }
  return out;
}

bool is_uint(const ImageBinding& image) { return image.format == "r32ui"; }

std::string read_image(const ImageBinding& image, Language language) {
  const char* const whole = is_uint(image) ? "u" : "";
  const auto [binding, slot] = image.place;
  switch (language) {
    case Language::glsl:
      return fmt::format("layout(binding = {}) uniform {}sampler2D {};\n", binding, whole, image.name);
    case Language::glsl330:
    case Language::gdshader:
      return fmt::format("uniform {}sampler2D {};\n", whole, image.name);
    case Language::hlsl:
      return fmt::format("Texture2D<{0}> {1} : register(t{2});\nSamplerState {1}_sampler : register(s{2});\n",
                         is_uint(image) ? "uint" : "float4", image.name, slot);
    case Language::wgsl:
      return fmt::format("@group(0) @binding({0}) var {1} : texture_2d<{2}>;\n@group(0) @binding({3}) var {1}_sampler : sampler;\n",
                         binding, image.name, is_uint(image) ? "u32" : "f32", binding + 16);
    default:
      return "";
  }
}

/// The name of a format that WGSL stores to; "" for others.
std::string wgsl_storage(const std::string& format) {
  if (format == "rgba8") return "rgba8unorm";
  if (format == "r32ui") return "r32uint";
  for (const char* channels : {"r", "rg", "rgba"})
    if (format == fmt::format("{}32f", channels)) return fmt::format("{}32float", channels);
  return format == "rgba16f" ? "rgba16float" : "";
}

std::string written_image(const ImageBinding& image, int location, Language language) {
  const auto [binding, slot] = image.place;
  switch (language) {
    case Language::glsl:
      return fmt::format("layout(binding = {}) uniform writeonly {}image2D {};\n", binding, is_uint(image) ? "u" : "", image.name);
    case Language::hlsl:
      return fmt::format("RWTexture2D<{}> {} : register(u{});\n", is_uint(image) ? "uint" : "float4", image.name, slot);
    case Language::glsl330:
      return fmt::format("layout(location = {}) out {} {};\n", location, is_uint(image) ? "uvec4" : "vec4", image.name);
    case Language::gdshader:
      return fmt::format("// COLOR of a viewport of its own: {}\n", image.name);
    case Language::wgsl:
      if (const std::string format = wgsl_storage(image.format); !format.empty())
        return fmt::format("@group(0) @binding({}) var {} : texture_storage_2d<{}, write>;\n", binding, image.name, format);
      return fmt::format("// binding {}: {}, which core WGSL cannot store as {}\n", binding, image.name, image.format);
    default:
      return "";
  }
}

}  // namespace

std::string list_layout(const ListBinding& list, Language language) {
  const std::string camel = camel_case(list.name);
  const auto [binding, slot] = list.place;
  switch (language) {
    case Language::glsl:
      if (!list.is_written) {
        return fmt::format("layout(std430, binding = {}) readonly buffer {}Buffer {{ {} {}[]; }};\n", binding, camel, list.record,
                           list.name);
      }
      return fmt::format(
          "layout(std430, binding = {0}) buffer {1}Buffer {{\n  uint {3}_count;\n  uint {3}_padding[3];\n  {2} {3}[];\n}};\n", binding,
          camel, list.record, list.name);
    case Language::hlsl: {
      const std::string records = fmt::format("{}StructuredBuffer<{}> {} : register({}{});\n", list.is_written ? "RW" : "", list.record,
                                              list.name, list.is_written ? 'u' : 't', slot);
      if (!list.is_written) return records;
      return records + fmt::format("RWStructuredBuffer<uint> {}_count : register(u{});\n", list.name, list.counter);
    }
    case Language::wgsl:
      if (!list.is_written)
        return fmt::format("@group(0) @binding({}) var<storage, read> {} : array<{}>;\n", binding, list.name, list.record);
      return fmt::format(
          "struct {1}Buffer {{\n  count : u32,\n  padding_0 : u32,\n  padding_1 : u32,\n  padding_2 : u32,\n  records : array<{2}>,\n}}\n"
          "@group(0) @binding({0}) var<storage, read_write> {3} : {1}Buffer;\n",
          binding, camel, list.record, list.name);
    default:
      return "";
  }
}

std::string image_layout(const std::vector<ImageBinding>& images, const std::string& name, bool by_fragments, Language language) {
  std::string out, fields;
  int location = 0;
  for (const ImageBinding& image : images) {
    if (!image.is_written) {
      out += read_image(image, language);
    } else if (by_fragments && language == Language::wgsl) {
      fields += fmt::format("  @location({}) {} : vec4<{}>,\n", location++, image.name, is_uint(image) ? "u32" : "f32");
    } else {
      out += written_image(image, location++, language);
    }
  }
  if (!fields.empty())
    out += fmt::format("struct {}Outputs {{  // of a @fragment shader, one for each texel\n{}}}\n", camel_case(name), fields);
  return out;
}

std::string layout_preamble(Language language) {
  if (language != Language::glsl330) return "";
  return "#ifdef GL_ES\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\nprecision highp usampler2D;\n#endif\n\n";
}

}  // namespace rainref::scene
