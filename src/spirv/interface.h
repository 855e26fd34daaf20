// The descriptors that a shader declares, in the terms of a pack: the first draft of a foreign effect's description.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rainref/image.h"
#include "scene/uniform_block.h"
#include "spirv/module.h"

namespace rainref::spirv {

/// A descriptor as the module declares it.
struct Wanted {
  std::string name;  ///< of the variable, else of its block; "binding_3" if the module has no names
  std::uint32_t set = 0, binding = 0;
  Bound bound = Bound::uniform_buffer;
  /// Layout of a uniform block, or of the elements of a storage buffer. Members of structures, elements of arrays and columns of matrices
  /// become members: "light_colour", "weights_3", "view_0". Sizes are the module's; a block's size is a multiple of 16.
  scene::UniformBlock block;
  std::optional<Format> format;  ///< of a storage image; nothing if the module does not say, or no pack has it
};

/// Returns all descriptors but samplers, sorted by set and binding. Throws Refusal for a buffer that a pack cannot describe: one without
/// offsets, a storage buffer that is not one array of elements, or more than 4096 members.
std::vector<Wanted> interface_of(const Module& module);
/// Returns the layout of the first uniform block; nothing if there is none. Throws like interface_of().
std::optional<scene::UniformBlock> uniform_block_of(const Module& module);

}  // namespace rainref::spirv
