// Writes the differences between passes and truth to files and statistics.
#pragma once

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

#include "truth/difference.h"

namespace rainref::cli {

/// Writes a PNG of each difference, STEM.NAME-SCALE-UNIT.png, and returns pixel counts and
///   {"differences": {name: {unit, pixels, p50, p90, p99, max, mean, scale, picture}}}.
nlohmann::ordered_json write_comparison(const std::filesystem::path& stem, const truth::Comparison& comparison);

}  // namespace rainref::cli
