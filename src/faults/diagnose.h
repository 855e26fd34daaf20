// Diagnosis: finds the single mistake that reproduces the failing values of a port.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "capture/pack_read.h"
#include "faults/replay.h"
#include "judge/judge_pass.h"

namespace rainref::faults {

/// Returns the causes of a failing run, best first, and where it fails; no cause if none explains enough. Lists are examined first, because
/// a wrong list causes wrong images. Serves as judge::ValidateOptions::explain.
judge::Explanation diagnose(const judge::FailedRun& failed);
/// The same with a time limit. If time runs out, returns the best causes so far, none of them likely.
judge::Explanation diagnose_within(const SearchLimit& limit, const judge::FailedRun& failed);

/// Removes entries that only have lines (judge::Cause::is_found) if a cause was found.
void keep_found(std::vector<judge::Cause>& causes);

/// "only channel y of wave; only within 4 texels of a record of drops", or "". where.cpp states the rule.
std::string where_it_fails(const judge::FailedRun& failed);

class TexelReplay;
/// Runs before any search. Returns the mistake of decidable_faults() that reproduces nearly all failing texels, also in `other` (may be
/// null). Nothing if there is none, if few texels fail, or if a plain mistake in a finished buffer reproduces about as many.
std::optional<judge::Cause> decided(const TexelReplay& run, const TexelReplay* other);
/// Checks list `output` for dead records after the correct ones that account for all failures; nothing if there are none.
std::optional<judge::Cause> read_beyond_end(const judge::FailedRun& failed, std::size_t output);
/// Reports that every failing element is not a number, and the first place; nothing if one is a number.
std::optional<judge::Cause> not_numbers(const judge::FailedRun& failed);

/// Returns causes of the failing ids in a case's lists that are matched by id. `model` may be null.
std::vector<judge::Cause> diagnose_lists(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before,
                                         const capture::PassModel* model, const std::vector<capture::Array>& port,
                                         const enclosed::Profile& profile, const parallel::Executor& executor);

/// Tie-breaker: penalty for an unlikely mistake; lower is more plausible. Texts with gaps, values fitted to the records that a port lost,
/// and operations that are rarely confused are penalized.
int far_fetched(const Tried& c);

/// Returns the three best causes that explain enough, and marks the likely one. If causes explain about as many failures and come about as
/// near, the first wins: `causes` are in order of plausibility. Values fitted to the port come last.
std::vector<Tried> best_causes(std::vector<Tried> causes);

}  // namespace rainref::faults
