// Differences between passes and truth as files and numbers.
#pragma once

#include <filesystem>
#include <span>

#include <nlohmann/json_fwd.hpp>

#include "compositor/picture.h"
#include "compositor/truth.h"
#include "rainref/recorder.h"

namespace rainref::cli {

/// Writes a PNG of each difference, STEM.NAME-SCALE-UNIT.png, and gives {name: {unit, pixels, p50, p90, p99, max, mean,
/// scale, picture}}.
nlohmann::ordered_json write_differences(const std::filesystem::path& stem, std::span<const compositor::Difference> differences);

/// Tells a recorder, if there is one, of a picture that was traced.
void report_traced(Recorder* recorder, int frame, const compositor::Picture& picture, const Image& shown, double seconds);
/// All that was traced, as named channels: R G B, normal.X .Y .Z, depth.Z, film, mask.
void write_traced_exr(const std::filesystem::path& path, const compositor::Picture& picture);

}  // namespace rainref::cli
