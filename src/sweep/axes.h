// The axes of a plan: lists, ranges and files of cases.
#pragma once

#include <span>

#include "scene/toml_reader.h"
#include "sweep/plan.h"

namespace rainref::sweep {

/// Most values of an axis, and most cells of a plan.
inline constexpr std::int64_t most_cells = 1'000'000;

/// The axes that these entries say, whose keys no longer begin with "axes."; in their order. Files of cases lie in `folder`. Throws
/// Error(usage), placed; Error(io) for a file of cases that cannot be read.
std::vector<Axis> axes_from(std::span<const scene::RawEntry> entries, const std::filesystem::path& folder);

/// `count` values from the first to the last one, which is exact; whole numbers where both ends and every step are.
std::vector<scene::RawValue> range(const scene::RawValue& from, const scene::RawValue& to, std::int64_t count);

/// A key as the plan quotes it: "\"rain.rate\"" and "rain.rate" are the same.
std::string unquoted(const std::string& key);

}  // namespace rainref::sweep
