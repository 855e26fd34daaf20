// Arrays and layouts of rainref.h that refer to memory of others.
#pragma once

#include "capture/array.h"
#include "port_dump/stored_image.h"
#include "rainref.h"
#include "rainref/simulation.h"
#include "scene/uniform_block.h"

namespace rainref::c_library {

/// Describes a buffer that a simulation holds. `record` is the layout of records, null for images. `name` must outlive the result.
rr_array array_of(const char* name, const Buffer& content, const scene::UniformBlock* record);
/// Describes a mip level of a captured array. Throws Error(usage) if there is no such level.
rr_array array_of(const char* name, const capture::Array& array, int level);
/// Checks an image given by a caller. Throws Error(usage) with the member if it is not valid.
port_dump::StoredImage image_of(const rr_array& given);
/// Describes a uniform block and its bytes.
rr_array array_of(const scene::UniformBlock& block, const void* bytes);

}  // namespace rainref::c_library
