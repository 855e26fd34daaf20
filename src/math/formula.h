// What a place of a pass text gives by another formula of what it is made of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "math/perturbed.h"
#include "math/rewrites.h"

namespace rainref::perturbed {

/// An operation again, of other operands; `r`, as it was, where it cannot be.
Perturbed again(Op op, const Perturbed& r, const std::array<Perturbed, 4>& of);
/// How many operands an operation of a formula takes; 0: it is none that a formula can do.
int operands_of(Op op);

/// A formula at a place whose operands are `of`, nodes `nodes` of the trace, with what was met in its first `before` nodes; r, as it
/// was, where a part of it is not there.
Perturbed by_formula(const Formula& formula, const Perturbed& r, const std::array<Perturbed, 4>& of,
                     const std::array<std::int32_t, 4>& nodes, const Trace& trace, std::size_t before);

}  // namespace rainref::perturbed
