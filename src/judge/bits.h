// Judges an output by its bits, texel by texel or record by record.
#pragma once

#include "capture/pass_case.h"
#include "judge/verdict.h"

namespace rainref::judge {

/// True for the bits of -0, which has the same ordered code as +0.
bool is_negative_zero(FormatInfo::Kind kind, const std::byte* stored);

/// Sets the stored and expected values of a failure, their ordered codes and the signs of zeros.
void set_unequal(FormatInfo::Kind kind, const std::byte* want, const std::byte* have, Failure& f);

/// Each texel or record of the port must equal the expected one, byte for byte.
OutputJudgement judge_bits(const capture::CaseOutput& expected, const capture::Array& port);

}  // namespace rainref::judge
