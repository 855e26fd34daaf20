// Words that cannot name a quantity in every language a layout is printed in.
#pragma once

#include <string_view>

namespace rainref::scene {

/// Whether a lower-case word is a keyword, a reserved word or a built-in type of C, C++, CUDA, GLSL 4.60, HLSL or WGSL.
bool is_reserved_word(std::string_view word);

}  // namespace rainref::scene
