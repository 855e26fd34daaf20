// Judging the files that a port wrote, as `rainref validate` does.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "judging/judge_cases.h"

namespace rainref::judging {

struct FolderOptions {
  std::string profile = "vulkan";
  std::vector<std::string> passes{};               ///< judge these alone; empty: all
  bool partial = false;                            ///< a pass without any file of the port is not judged, and its files are not missing
  bool strict = false;                             ///< each WARN is a FAIL
  std::function<void(int done, int of)> progress;  ///< after each run, by the thread that asked; may be null
};

/// Judges the outputs in `port` for the pack. Files that are missing or cannot be used stand in the judgement, which reads pictures from
/// both folders again. Errors as judge::validate's.
Judged judge_folder(const std::filesystem::path& pack, const std::filesystem::path& port, const FolderOptions& options,
                    const parallel::Executor& executor);

}  // namespace rainref::judging
