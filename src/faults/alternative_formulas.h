// Whether a port computes what a pass does by another formula, one that real arithmetic makes equal.
#pragma once

#include <optional>
#include <vector>

#include "capture/pass_model.h"
#include "faults/fault.h"
#include "judge/verdict.h"
#include "math/profile.h"

namespace rainref::faults {

/// The first of the pass's alternative formulas (capture::AlternativeFormula) whose envelopes hold nine in ten of the failing texels and
/// of the passing ones; nothing where there is none. No bits are compared: `explained` is 0.
std::optional<judge::Cause> alternative_formula(const capture::PassCase& c, const std::vector<capture::Array>& port,
                                                const enclosed::Profile& profile, judge::HalfMode mode, const std::vector<Texel>& failing,
                                                const std::vector<Texel>& passing);

}  // namespace rainref::faults
