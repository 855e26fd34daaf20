// Images and lists that a pass reads and writes, declared in source text.
#pragma once

#include <string>
#include <vector>

#include "scene/uniform_layout.h"

namespace rainref::scene {

/// Where a pass binds an image or a list.
struct Place {
  int binding = 1;  ///< in descriptor set or group 0
  int slot = 0;     ///< HLSL: t register of what is read, u register of what is written
};

/// A list of records in a pass.
struct ListBinding {
  std::string name, record;
  bool is_written = false;
  Place place = {};
  int counter = 0;  ///< HLSL: u register of the count of a written list
};
/// Declares the list (std430, StructuredBuffer, WGSL storage; nothing in C and CUDA). A written list begins with its count, in the first of
/// four words; in HLSL the count is a buffer of one word.
std::string list_layout(const ListBinding& list, Language language);
/// Declares the list where a shader has no storage buffers, with functions that load a record: GLSL 3.30 as a struct, Godot each member.
/// Row i of the texture holds record i, 16 bytes a texel: RGBA32UI, in Godot RGBAF. A list that is written is a comment.
std::string list_in_texels(const ListBinding& list, const UniformBlock& record, Language language);

/// An image in a pass.
struct ImageBinding {
  std::string name;
  std::string format;  ///< of the storage; the key of a scene where that selects it
  bool is_written = false;
  Place place = {};
};
/// Declares images: a sampler with each that is read, and what is written as a storage image. Where a fragment shader writes it
/// (`by_fragments`: WGSL, GLSL 3.30), it is an output of that; `name` begins the name of their struct in WGSL. Nothing in C and CUDA.
std::string image_layout(const std::vector<ImageBinding>& images, const std::string& name, bool by_fragments, Language language);

/// What comes before all declarations: in GLSL 3.30 the precisions that GLSL ES wants, "" elsewhere.
std::string layout_preamble(Language language);

}  // namespace rainref::scene
