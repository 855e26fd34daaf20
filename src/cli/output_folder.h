// The folder that `rainref run` writes to, and what an earlier run left there.
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

/// A file of a run, by its name: "puddle.0012.png", "puddle.0012.exr", "puddle.0012.truth.normal.png".
struct RunPicture {
  enum class Kind : std::uint8_t { png, exr, truth } kind;
  std::string effect;
  std::int64_t frame;
};

/// Made before the work: an unwritable place should not cost a run. Unless keep() is called, the folders that were made go again, if
/// nothing lies in them. While it lives no other run writes there.
class OutputFolder {
 public:
  using Writes = std::function<bool(const RunPicture&)>;

  /// Throws Error(io).
  explicit OutputFolder(const std::filesystem::path& folder);
  void keep() { made_->keep(); }
  const std::filesystem::path& summary() const { return summary_; }

  /// Two runs' results do not stand beside each other. Throws Error(usage) where pictures of an earlier run would stay, which this one does
  /// not write; a capture, where this one makes none; or the checkpoint of a killed run from which this one does not go on. With
  /// options.overwrite they go when the first result is written; Error(usage) then only for a capture with files in it that are not
  /// rainref's. So do, in the folder that rainref chose itself (no options.output), the pictures of one frame. `writes`: whether this run
  /// writes such a picture.
  void require_one_run(const RunOptions& options, const Checkpoint& checkpoint, bool goes_on, const Writes& writes);
  /// To be called before each result is written: what an earlier run left goes, its summary first, but for what this run goes on from.
  void forget_older_run(const Checkpoint& checkpoint, bool goes_on);

 private:
  void remove(const std::filesystem::path& path) const;

  std::filesystem::path folder_, summary_;
  std::optional<MadeFolders> made_;
  std::optional<FolderLock> lock_;
  std::vector<std::filesystem::path> replaced_, others_;  ///< pictures of an earlier run, which this one writes or does not
  bool removes_capture_ = false;
  bool is_new_ = false;
};

}  // namespace rainref::cli
