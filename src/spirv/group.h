// Workgroups in lockstep, in float: barriers, shared memory, atomics.
#pragma once

#include "spirv/machine.h"

namespace rainref::spirv {

using Float = scalar::Scalar<float>;

/// Executes all invocations of so many workgroups. Where invocations of a workgroup work together they take turns, block by block in their
/// order, so that one that waits for another gets on; otherwise one after the other. Throws Refusal.
void dispatch(Machine<Float>& machine, const Three& groups);

}  // namespace rainref::spirv
