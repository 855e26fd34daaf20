// Layouts as source text, ready to paste into a port.
#pragma once

#include <string>
#include <string_view>

#include "scene/uniform_block.h"

namespace rainref::scene {

enum class Language : std::uint8_t { c, glsl, hlsl, wgsl, cuda };

/// Throws Error(usage) naming the nearest language.
Language language_from_name(std::string_view name);
/// "c", "glsl", …
const char* name(Language language);

/// A uniform block: every gap an explicit padding member, every member with its offset, unit and sentence. The bytes
/// are those of the block in each language (std140, HLSL cbuffer, WGSL uniform, C99, CUDA). Throws as validate does.
std::string layout(const UniformBlock& block, Language language);
/// The element struct of a storage buffer, and the buffer (std430, StructuredBuffer, WGSL storage; a struct alone in C
/// and CUDA). Throws as validate_record does.
std::string record_layout(const UniformBlock& record, Language language);

}  // namespace rainref::scene
