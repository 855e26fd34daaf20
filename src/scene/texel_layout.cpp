// Lists of records as textures, for shaders without storage buffers.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/binding_layout.h"

namespace rainref::scene {
namespace {

constexpr std::size_t texel_bytes = 16;
std::size_t texels_of(const UniformBlock& record) { return (record.size + texel_bytes - 1) / texel_bytes; }

/// "xy": the channels of its texel that hold a member, which never lies across two.
std::string channels_of(const Member& m) {
  return std::string("xyzw").substr(m.offset % texel_bytes / 4, static_cast<std::size_t>(m.components));
}

/// The member's value from these channels, which are unsigned integers or, in Godot, floats.
std::string value_of(const Member& m, const std::string& channels, bool are_floats) {
  const std::string count = m.components == 1 ? "" : std::to_string(m.components);
  switch (m.scalar) {
    case Scalar::float32:
      return are_floats ? channels : fmt::format("uintBitsToFloat({})", channels);
    case Scalar::int32:
      return are_floats ? fmt::format("floatBitsToInt({})", channels)
                        : fmt::format("{}({})", count.empty() ? "int" : "ivec" + count, channels);
    case Scalar::uint32:
      return are_floats ? fmt::format("floatBitsToUint({})", channels) : channels;
  }
  return "";
}

std::string struct_loader(const ListBinding& list, const UniformBlock& record) {
  std::string text = fmt::format("{} {}_at(int i) {{\n", record.name, list.name);
  for (std::size_t k = 0; k < texels_of(record); ++k)
    text += fmt::format("  uvec4 texel_{} = texelFetch({}, ivec2({}, i), 0);\n", k, list.name, k);
  std::vector<std::string> values;
  for (const Member& m : with_padding(record))
    values.push_back(value_of(m, fmt::format("texel_{}.{}", m.offset / texel_bytes, channels_of(m)), false));
  return text + fmt::format("  return {}({});\n}}\n", record.name, fmt::join(values, ", "));
}

std::string member_loaders(const ListBinding& list, const UniformBlock& record) {
  std::string text;
  for (const Member& m : record.members) {
    const std::string channels = fmt::format("texelFetch({}, ivec2({}, i), 0).{}", list.name, m.offset / texel_bytes, channels_of(m));
    text += fmt::format("{} {}_{}(int i) {{ return {}; }}  // [{}] {}\n", type_name(m, Language::gdshader), list.name, m.name,
                        value_of(m, channels, true), m.unit, m.sentence);
  }
  return text;
}

}  // namespace

std::string list_in_texels(const ListBinding& list, const UniformBlock& record, Language language) {
  if (list.is_written) return fmt::format("// {}: a list of {}, which a fragment shader cannot write\n", list.name, record.name);
  const bool is_godot = language == Language::gdshader;
  const std::size_t texels = texels_of(record), padding = texels * texel_bytes - record.size;
  std::string text = fmt::format("// {}: row i of an {} texture of {} column{} is record i of {} bytes", list.name,
                                 is_godot ? "RGBAF" : "RGBA32UI", texels, texels == 1 ? "" : "s", record.size);
  if (padding > 0) text += fmt::format(" and {} of padding", padding);
  text += fmt::format("; an empty list is a row of zeros.\nuniform {}sampler2D {};\nint {}_rows() {{ return textureSize({}, 0).y; }}\n",
                      is_godot ? "" : "u", list.name, list.name, list.name);
  return text + (is_godot ? member_loaders(list, record) : struct_loader(list, record));
}

}  // namespace rainref::scene
