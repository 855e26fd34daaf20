// Arrays and layouts as rainref.h hands them out: addresses of what others hold.
#pragma once

#include "capture/array.h"
#include "port_dump/stored_image.h"
#include "rainref.h"
#include "rainref/simulation.h"
#include "scene/uniform_block.h"

namespace rainref::c_library {

/// A buffer that a simulation holds; `record` is the layout of records, null of images. `name` must outlive it.
rr_array array_of(const char* name, const Buffer& content, const scene::UniformBlock* record);
/// A mip level of a captured array; Error(usage) where it has no such level.
rr_array array_of(const char* name, const capture::Array& array, int level);
/// An image that a caller gives; Error(usage), naming the member, for what no image is.
port_dump::StoredImage image_of(const rr_array& given);
/// A uniform block and its bytes.
rr_array array_of(const scene::UniformBlock& block, const void* bytes);

}  // namespace rainref::c_library
