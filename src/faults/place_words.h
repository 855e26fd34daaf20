// What can go wrong at one place of a pass text, in words.
#pragma once

#include <string>
#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

/// A mistake at a place, what it is called and what to look for in the port.
struct Words {
  perturbed::PlaceFault fault;
  std::string name, sentence;
};
/// All of a node of a probe.
std::vector<Words> words_of(const Probe& p, std::size_t at);

}  // namespace rainref::faults
