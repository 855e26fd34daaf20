// What a guard asks of the processor. One of floating_point_<processor>.cpp is compiled, which CMake chooses; that file also has
// floating_point_control(), set_floating_point_control() and pinned_floating_point_control.
#pragma once

#include <cstdint>

namespace rainref::floating_point_unit {

/// What a guard keeps, in 64 bits: the control register with its sticky flags, and whatever else of the unit bears on results.
std::uint64_t whole_state();
/// To pinned_floating_point_control, and the rest to what a process starts with.
void pin();
/// Back to what whole_state() gave.
void put_back(std::uint64_t state);

}  // namespace rainref::floating_point_unit
