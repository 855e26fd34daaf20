// Judging an output by its bits: texel by texel, or record by record.
#pragma once

#include "capture/pass_case.h"
#include "judge/verdict.h"

namespace rainref::judge {

/// Whether these are the bits of -0, whose ordered code is that of +0.
bool is_negative_zero(FormatInfo::Kind kind, const std::byte* stored);

/// Sets what both stored and what was expected, their place in the order of codes and the signs of zeros, for a value
/// that must have the expected bits and has not.
void set_unequal(FormatInfo::Kind kind, const std::byte* want, const std::byte* have, Failure& f);

/// Each texel or record of the port must be the expected one, byte for byte.
OutputJudgement judge_bits(const capture::CaseOutput& expected, const capture::Array& port);

}  // namespace rainref::judge
