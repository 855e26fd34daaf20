// Layouts as source text, ready to paste into a port.
#pragma once

#include <string>
#include <string_view>

#include "scene/uniform_block.h"

namespace rainref::scene {

/// `glsl330`: fragment shaders of OpenGL 3.3, OpenGL ES 3.0 and WebGL 2. `gdshader`: Godot.
enum class Language : std::uint8_t { c, glsl, hlsl, wgsl, cuda, glsl330, gdshader };

/// Throws Error(usage) with the nearest language.
Language language_from_name(std::string_view name);
/// "c", "glsl", …
const char* name(Language language);

/// The name of a member's type.
std::string type_name(const Member& member, Language language);

/// A uniform block: every gap is an explicit padding member, and every member has its offset, unit and sentence. The bytes are those of the
/// block in each language (std140, HLSL cbuffer, WGSL uniform, C99, CUDA). Godot has no blocks: each member is a uniform of its own. Throws
/// as validate does.
std::string layout(const UniformBlock& block, Language language);
/// The element struct of a list; "" in Godot. Throws as validate_record does.
std::string record_layout(const UniformBlock& record, Language language);

}  // namespace rainref::scene
