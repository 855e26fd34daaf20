// Quantities over time by key frames in a scene: "time value; time value; ...".
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "windshield/motion/pchip.h"

namespace rainref::windshield {

/// One number of a row, behind its time.
struct KeyedQuantity {
  const char *name, *unit;
  double least, most;
};
/// A curve for each quantity, smooth between the rows and never beyond them; what the first and the last row say holds before and behind
/// them. Times in s. Throws Error(usage) naming `key` and the row: fewer than two rows, another count of numbers, a field that is none,
/// times that do not ascend, a value out of range.
std::vector<Pchip> parse_curves(std::string_view text, const std::string& key, std::span<const KeyedQuantity> quantities);

}  // namespace rainref::windshield
