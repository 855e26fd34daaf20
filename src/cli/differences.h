// Differences between passes and truth as files and numbers.
#pragma once

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

#include "truth/difference.h"

namespace rainref::cli {

/// Writes a PNG of each difference, STEM.NAME-SCALE-UNIT.png, and gives the counts of pixels and
/// {"differences": {name: {unit, pixels, p50, p90, p99, max, mean, scale, picture}}}.
nlohmann::ordered_json write_comparison(const std::filesystem::path& stem, const truth::Comparison& comparison);

}  // namespace rainref::cli
