// Passes that take lists of drops, as conformance takes them.
#pragma once

#include <memory>
#include <vector>

#include "capture/pass_model.h"

namespace rainref::drops {

/// Allows more than every profile: what is settled under it is settled under each of them. Groups of drops that share
/// decisions are found by it.
const enclosed::Profile& loosest_profile();

std::unique_ptr<capture::PassModel> bind_merge(const capture::PassCase& c);
std::unique_ptr<capture::PassModel> bind_necks(const capture::PassCase& c);
std::unique_ptr<capture::PassModel> bind_integrate(const capture::PassCase& c);
std::unique_ptr<capture::PassModel> bind_splat(const capture::PassCase& c);
/// spawn: the drops of before and the arrivals.
std::vector<capture::Array> recompute_spawn(const capture::PassCase& c);

}  // namespace rainref::drops
