// Checks whether the inputs of a pass fit together.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::pass {

/// Returns how a list violates its declaration, or "": "uniform tap_count: expected 0 to 4, the records of in.taps, found 5".
std::string records_fault(const scene::UniformBlock& block, std::span<const std::byte> uniforms, const In& list, std::size_t records);

}  // namespace rainref::pass
