// Nodes of a probe that belong together: the components of vectors, the channels that one lookup gives.
#pragma once

#include <cstdint>
#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

using Nodes = std::vector<std::int32_t>;

/// Whether some of them have one shape.
bool are_alike(const Probe& p, const Nodes& v);
/// In a loop that meets the components, all of one shape, round by round: how many there are; else 0.
std::int32_t period_of(const Probe& p, const Nodes& v);
/// What belongs together as a vector: what a length is taken of, the arguments of named functions, what is alike but for the
/// component, what the outputs are made of side by side, and pairs of one operation beside each other. Two or three nodes each.
std::vector<Nodes> vector_groups_of(const Probe& p);
/// Channels that one lookup gives, two or three.
std::vector<Nodes> lookups_of(const Probe& p);

}  // namespace rainref::faults
