// The axes of a plan: lists, ranges and files of cases.
#pragma once

#include <span>

#include "scene/toml_reader.h"
#include "sweep/plan.h"

namespace rainref::sweep {

/// Largest number of values of an axis, and of cells of a plan.
inline constexpr std::int64_t most_cells = 1'000'000;

/// The axes of these entries, whose keys have lost their prefix "axes.", in order. Files of cases are relative to `folder`. Throws
/// Error(usage) with the place; Error(io) for a file of cases that cannot be read.
std::vector<Axis> axes_from(std::span<const scene::RawEntry> entries, const std::filesystem::path& folder);

/// `count` values from the first to the last one, which is exact; integers if both ends and every step are integers.
std::vector<scene::RawValue> range(const scene::RawValue& from, const scene::RawValue& to, std::int64_t count);

/// A key without the plan's quotes: "\"rain.rate\"" and "rain.rate" are the same.
std::string unquoted(const std::string& key);

}  // namespace rainref::sweep
