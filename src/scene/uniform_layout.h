// Layouts as source text, ready to paste into a port.
#pragma once

#include <string>
#include <string_view>

#include "scene/uniform_block.h"

namespace rainref::scene {

enum class Language : std::uint8_t { c, glsl, hlsl, wgsl, cuda };

/// Throws Error(usage) with the nearest language.
Language language_from_name(std::string_view name);
/// "c", "glsl", …
const char* name(Language language);

/// A uniform block: every gap is an explicit padding member, and every member has its offset, unit and sentence. The bytes are those of the
/// block in each language (std140, HLSL cbuffer, WGSL uniform, C99, CUDA). Throws as validate does.
std::string layout(const UniformBlock& block, Language language);
/// The element struct of a list. Throws as validate_record does.
std::string record_layout(const UniformBlock& record, Language language);

/// Binding of a list of records in a pass.
struct ListBinding {
  std::string name, record;
  bool is_written = false;
  int binding = 1;  ///< in descriptor set or group 0
  int slot = 0;     ///< HLSL: t register if it is read, u register if it is written
};
/// Declares the list (std430, StructuredBuffer, WGSL storage; nothing in C and CUDA). A written list begins with its count, in the first of
/// four words; not in HLSL, where the program stores the count elsewhere.
std::string list_layout(const ListBinding& list, Language language);

}  // namespace rainref::scene
