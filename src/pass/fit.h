// Whether what a pass takes fits together.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::pass {

/// Why a list is not as declared, or "": "uniform tap_count: expected 0 to 4, the records of in.taps, found 5".
std::string records_fault(const scene::UniformBlock& block, std::span<const std::byte> uniforms, const In& list, std::size_t records);

}  // namespace rainref::pass
