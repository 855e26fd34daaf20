// The output folder of `rainref run`, and files that an earlier run left there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/file_lock.h"
#include "base/folders.h"
#include "cli/checkpoint.h"

namespace rainref::cli {

/// A file of a run, identified by its name: "puddle.0012.png", "puddle.0012.exr", "puddle.0012.truth.normal.png".
struct RunPicture {
  enum class Kind : std::uint8_t { png, exr, truth } kind;
  std::string effect;
  std::int64_t frame;
};

/// The output folder, created before the work so that an unwritable path does not waste a run. Unless keep() is called, created folders are
/// removed again if they are empty. While it exists, no other run writes there.
class OutputFolder {
 public:
  using Writes = std::function<bool(const RunPicture&)>;

  /// Throws Error(io).
  explicit OutputFolder(const std::filesystem::path& folder);
  void keep() { made_->keep(); }
  const std::filesystem::path& summary() const { return summary_; }

  /// Prevents mixed results of two runs. Throws Error(usage) if the folder has pictures of an earlier run that this one does not overwrite,
  /// a capture if this run makes none, or the checkpoint of a killed run that this one does not resume. With options.overwrite these are
  /// deleted when the first result is written; Error(usage) then remains only for a capture with files that are not rainref's. In a folder
  /// that rainref chose itself (no options.output), the pictures of one frame are deleted too. `writes`: returns whether this run writes a
  /// picture.
  void require_one_run(const RunOptions& options, const Checkpoint& checkpoint, bool goes_on, const Writes& writes);
  /// Call before each result is written: deletes what an earlier run left, its summary first, except what this run resumes from.
  void forget_older_run(const Checkpoint& checkpoint, bool goes_on);

 private:
  void remove(const std::filesystem::path& path) const;

  std::filesystem::path folder_, summary_;
  std::optional<MadeFolders> made_;
  std::optional<FolderLock> lock_;
  std::vector<std::filesystem::path> replaced_, others_;  ///< pictures of an earlier run that this one does and does not overwrite
  bool removes_capture_ = false;
  bool is_new_ = false;
};

}  // namespace rainref::cli
