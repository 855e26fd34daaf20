// Why a port fails: which single mistake gives what it stored where it fails.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "capture/pack_read.h"
#include "faults/replay.h"
#include "judge/judge_pass.h"

namespace rainref::faults {

/// What explains a failing run, best first, and where it fails; no cause when nothing explains enough of it. A wrong list is
/// behind what is wrong in an image that goes with it, so lists are asked first. Serves as judge::ValidateOptions::explain.
judge::Explanation diagnose(const judge::FailedRun& failed);
/// The same in a limited time: past it the best so far is said, and none is likely.
judge::Explanation diagnose_within(const SearchLimit& limit, const judge::FailedRun& failed);

/// "only channel y of wave; only within 4 texels of a record of drops", or "". The rule stands in where.cpp.
std::string where_it_fails(const judge::FailedRun& failed);

class TexelReplay;
/// Before any search: the mistake of decidable_faults() that gives nearly all of what fails in a run, and in `other`, which may be null;
/// nothing where none does, where few texels fail, or where a plain mistake of a finished buffer gives about as much.
std::optional<judge::Cause> decided(const TexelReplay& run, const TexelReplay* other);
/// Of list `output`: dead records behind the right ones, which are all of what fails; nothing where that is not so.
std::optional<judge::Cause> read_beyond_end(const judge::FailedRun& failed, std::size_t output);
/// That each failing element is not a number, and where the first stands; nothing where one is a number.
std::optional<judge::Cause> not_numbers(const judge::FailedRun& failed);

/// What explains the failing ids of a case's lists that are matched by id. `model` may be null.
std::vector<judge::Cause> diagnose_lists(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before,
                                         const capture::PassModel* model, const std::vector<capture::Array>& port,
                                         const enclosed::Profile& profile, const parallel::Executor& executor);

/// Of what explains as much, how far it is from what is usually done wrong, or said: words that leave much out, what is fitted to the
/// records that a port lost, an operation that is rarely taken for another.
int far_fetched(const Tried& c);

/// The three best of them, of those that explain enough. Of causes that explain about as much, and come about as near, the one that
/// comes first is taken: `causes` are in the order in which they are to be believed. What is fitted to the port comes after all others.
/// Says which is likely.
std::vector<Tried> best_causes(std::vector<Tried> causes);

}  // namespace rainref::faults
