// Evaluates another formula of a place's inputs at that place of a pass text.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "math/perturbed.h"
#include "math/rewrites.h"

namespace rainref::perturbed {

/// Repeats an operation with other operands; returns the original `r` if that is impossible.
Perturbed again(Op op, const Perturbed& r, const std::array<Perturbed, 4>& of);
/// Number of operands of an operation of a formula; 0: formulas do not support it.
int operands_of(Op op);

/// A formula at a place with operands `of`, nodes `nodes` of the trace, and values from its first `before` nodes; returns the original r if
/// a part is missing.
Perturbed by_formula(const Formula& formula, const Perturbed& r, const std::array<Perturbed, 4>& of,
                     const std::array<std::int32_t, 4>& nodes, const Trace& trace, std::size_t before);

}  // namespace rainref::perturbed
