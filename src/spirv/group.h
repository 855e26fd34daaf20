// Workgroups in lockstep, in float: barriers, shared memory, atomics.
#pragma once

#include "spirv/machine.h"

namespace rainref::spirv {

using Float = scalar::Scalar<float>;

/// Executes all invocations of `groups` workgroups. If invocations of a workgroup cooperate, each runs one block in turn, so that an
/// invocation that waits for another makes progress; otherwise they run one after the other. Throws Refusal.
void dispatch(Machine<Float>& machine, const Three& groups);

}  // namespace rainref::spirv
