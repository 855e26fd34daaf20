// What is decided before any search: one of decidable_faults(), a list read beyond its end, what is not a number.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "faults/texel_replay.h"
#include "judge/judge_pass.h"

namespace rainref::faults {

/// The decidable mistake that gives nearly all of what fails in a run, and in `other`, which may be null; nothing where none does, where
/// few texels fail, or where a plain mistake of a finished buffer gives about as much.
std::optional<judge::Cause> decided(const TexelReplay& run, const TexelReplay* other);

/// Of list `output`: dead records behind the right ones, which are all of what fails; nothing where that is not so.
std::optional<judge::Cause> read_beyond_end(const judge::FailedRun& failed, std::size_t output);

/// That each failing element is not a number, and where the first stands; nothing where one is a number.
std::optional<judge::Cause> not_numbers(const judge::FailedRun& failed);

}  // namespace rainref::faults
