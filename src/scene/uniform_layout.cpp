#include "scene/uniform_layout.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rainref/error.h"

namespace rainref::scene {
namespace {

constexpr std::array<const char*, 7> language_names{"c", "glsl", "hlsl", "wgsl", "cuda", "glsl330", "gdshader"};

// "WaveStepUniforms" -> "wave_step_uniforms"
std::string snake_case(const std::string& camel) {
  std::string out;
  for (const char c : camel) {
    const bool is_upper = c >= 'A' && c <= 'Z';
    if (is_upper && !out.empty()) out += '_';
    out += is_upper ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return out;
}

// C has no vectors. They are structs of scalars, guarded because several layouts may be pasted into one file.
std::string c_vector_types(const UniformBlock& block) {
  std::string out;
  std::vector<std::string> done;
  for (const Member& m : block.members) {
    const std::string type = type_name(m, Language::c);
    if (m.components == 1 || std::find(done.begin(), done.end(), type) != done.end()) continue;
    done.push_back(type);
    Member component = m;
    component.components = 1;
    constexpr std::array<const char*, 5> names{"", "", "x, y", "x, y, z", "x, y, z, w"};
    out += fmt::format("#ifndef {0}_DEFINED\n#define {0}_DEFINED\ntypedef struct {{ {1} {2}; }} {0};\n#endif\n", type,
                       type_name(component, Language::c), names[static_cast<std::size_t>(m.components)]);
  }
  return out;
}

// One line per member, comments aligned.
std::string member_lines(const UniformBlock& block, Language language) {
  std::vector<std::pair<std::string, const Member*>> lines;
  const std::vector<Member> members = with_padding(block);
  std::size_t width = 0;
  for (const Member& m : members) {
    const std::string type = type_name(m, language);
    lines.emplace_back(language == Language::wgsl ? fmt::format("  {} : {},", m.name, type) : fmt::format("  {} {};", type, m.name), &m);
    width = std::max(width, lines.back().first.size());
  }
  std::string out;
  for (const auto& [line, m] : lines) {
    const std::string note = m->sentence.empty() ? "padding" : fmt::format("[{}] {}", m->unit, m->sentence);
    out += fmt::format("{:<{}}  // {:>3}  {}\n", line, width, m->offset, note);
  }
  return out;
}

// A struct of this name, with a check of its size if the language supports it.
std::string struct_text(const UniformBlock& block, Language language) {
  const std::string lines = member_lines(block, language);
  switch (language) {
    case Language::c:
      return fmt::format(
          "#include <stdint.h>\n{0}typedef struct {{\n{1}}} {2};\n"
          "typedef char {2}_has_{3}_bytes[sizeof({2}) == {3} ? 1 : -1];\n",
          c_vector_types(block), lines, block.name, block.size);
    case Language::cuda:
      return fmt::format("struct {0} {{\n{1}}};\nstatic_assert(sizeof({0}) == {2}, \"layout of {0}\");\n", block.name, lines, block.size);
    case Language::wgsl:
      return fmt::format("struct {} {{\n{}}}\n", block.name, lines);
    case Language::glsl:
    case Language::glsl330:
    case Language::hlsl:
      return fmt::format("struct {} {{\n{}}};\n", block.name, lines);
    case Language::gdshader:
      return "";
  }
  return "";
}

std::string head(const UniformBlock& block) {
  return fmt::format("// {}: {} bytes, little endian. Comments: offset in bytes, [unit], meaning.\n", block.name, block.size);
}

// Uniforms of their own; padding is nothing there.
std::string godot_uniforms(const UniformBlock& block) {
  std::string out;
  for (const Member& m : block.members)
    out += fmt::format("uniform {} {};  // [{}] {}\n", type_name(m, Language::gdshader), m.name, m.unit, m.sentence);
  return out;
}

}  // namespace

std::string type_name(const Member& m, Language language) {
  const auto pick = [&](const char* of_float, const char* of_int, const char* of_uint) -> std::string {
    return m.scalar == Scalar::float32 ? of_float : m.scalar == Scalar::int32 ? of_int : of_uint;
  };
  const bool is_vector = m.components > 1;
  const std::string count = is_vector ? std::to_string(m.components) : "";
  switch (language) {
    case Language::c:
      return is_vector ? pick("rainref_float", "rainref_int", "rainref_uint") + count : pick("float", "int32_t", "uint32_t");
    case Language::cuda:
      return is_vector ? pick("float", "int", "uint") + count : pick("float", "int", "unsigned int");
    case Language::glsl:
    case Language::glsl330:
    case Language::gdshader:
      return is_vector ? pick("vec", "ivec", "uvec") + count : pick("float", "int", "uint");
    case Language::hlsl:
      return pick("float", "int", "uint") + count;
    case Language::wgsl: {
      const std::string scalar = pick("f32", "i32", "u32");
      return is_vector ? fmt::format("vec{}<{}>", m.components, scalar) : scalar;
    }
  }
  return "?";
}

Language language_from_name(std::string_view wanted) {
  for (std::size_t i = 0; i < language_names.size(); ++i) {
    if (language_names[i] == wanted) return static_cast<Language>(i);
  }
  const std::vector<std::string> names(language_names.begin(), language_names.end());
  throw Error(ExitCode::usage,
              fmt::format("layout: expected one of '{}', found '{}'{}", fmt::join(names, "', '"), wanted, did_you_mean(wanted, names)));
}

const char* name(Language language) { return language_names[static_cast<std::size_t>(language)]; }

std::string layout(const UniformBlock& block, Language language) {
  validate(block);
  std::string out = head(block);
  switch (language) {
    case Language::c:
    case Language::cuda:
      return out + struct_text(block, language);
    case Language::glsl:
      return out + fmt::format("layout(std140, binding = 0) uniform {} {{\n{}}} {};\n", block.name, member_lines(block, language),
                               snake_case(block.name));
    case Language::glsl330:
      return out +
             fmt::format("layout(std140) uniform {} {{\n{}}} {};\n", block.name, member_lines(block, language), snake_case(block.name));
    case Language::gdshader:
      return fmt::format("// {}. Comments: [unit], meaning.\n", block.name) + godot_uniforms(block);
    case Language::hlsl:
      return out + fmt::format("cbuffer {} : register(b0) {{\n{}}};\n", block.name, member_lines(block, language));
    case Language::wgsl:
      return out + struct_text(block, language) +
             fmt::format("@group(0) @binding(0) var<uniform> {} : {};\n", snake_case(block.name), block.name);
  }
  return out;
}

std::string record_layout(const UniformBlock& record, Language language) {
  validate_record(record);
  const std::string text = struct_text(record, language);
  return text.empty() ? "" : head(record) + text;
}

}  // namespace rainref::scene
