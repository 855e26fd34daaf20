// Access of a guard to the processor. CMake compiles one of floating_point_<processor>.cpp, which also defines floating_point_control(),
// set_floating_point_control() and pinned_floating_point_control.
#pragma once

#include <cstdint>

namespace rainref::floating_point_unit {

/// The state that a guard saves, in 64 bits: the control register with its sticky flags, and all other state that affects results.
std::uint64_t whole_state();
/// Sets pinned_floating_point_control, and all other state to its value at the start of a process.
void pin();
/// Restores the result of whole_state().
void put_back(std::uint64_t state);

}  // namespace rainref::floating_point_unit
