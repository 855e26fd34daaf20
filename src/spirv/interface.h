// What a shader wants bound, in the words of a pack: the first draft of a foreign effect's description.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rainref/image.h"
#include "scene/uniform_block.h"
#include "spirv/module.h"

namespace rainref::spirv {

/// A descriptor and what the module says of it.
struct Wanted {
  std::string name;  ///< of the variable, else of its block; "binding_3" where the module has no names
  std::uint32_t set = 0, binding = 0;
  Bound bound = Bound::uniform_buffer;
  /// A uniform block's layout, or that of the elements of a storage buffer. Members of structures, elements of arrays and columns of
  /// matrices are members of their own: "light_colour", "weights_3", "view_0". Sizes are those of the module, a block's a multiple of 16.
  scene::UniformBlock block;
  std::optional<Format> format;  ///< of a storage image; nothing where the module does not say, or no pack has it
};

/// Every descriptor but samplers, by set and binding. Throws Refusal for a buffer that no pack can describe: one without offsets, a storage
/// buffer that is anything but one array of elements, more than 4096 members.
std::vector<Wanted> interface_of(const Module& module);
/// The first uniform block's layout alone; nothing where there is none. Throws like it.
std::optional<scene::UniformBlock> uniform_block_of(const Module& module);

}  // namespace rainref::spirv
