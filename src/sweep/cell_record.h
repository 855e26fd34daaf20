// cell.json: what a finished cell is and holds, so that any byte of it that changes shows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "capture/new_folder.h"

namespace rainref::sweep {

/// A file of a cell.
struct KeptFile {
  std::string path;  ///< in the cell's folder
  std::uintmax_t bytes;
  std::string hash;  ///< XXH3-128
};

/// Writes the files of a cell, and cell.json last.
class CellWriter {
 public:
  explicit CellWriter(const std::filesystem::path& cell);
  /// For files that others write there; tell each with wrote().
  const std::filesystem::path& folder() const { return folder_.path(); }
  void write(const std::string& path, std::span<const std::byte> bytes);
  void write(const std::string& path, std::string_view text) { write(path, std::as_bytes(std::span(text))); }
  void wrote(const std::string& path);
  /// Adds the files to the record, and gives the folder its name. False: another one was first. Throws Error(io). `names`
  /// holds folders that hold names of earlier cells and are to be brought to the disk; then those that hold this one's.
  bool finish(nlohmann::ordered_json record, std::vector<std::filesystem::path>& names);
  std::uintmax_t bytes() const;

 private:
  capture::NewFolder folder_;
  std::vector<KeptFile> files_;
};

/// What a finished cell's record says.
struct CellRecord {
  std::string verdict;                                          ///< of a judged cell
  std::vector<std::pair<std::string, std::string>> last_frame;  ///< "pass.buffer", and its hash
  std::vector<KeptFile> files;
};
/// The record of a finished cell. Throws Error(io) where it cannot be read; Error(port_files) where it is damaged: its hash is not its own,
/// a value is not of its kind, it is of another cell, a file lies elsewhere, or its last frame is not the one before its end.
CellRecord read_record(const std::filesystem::path& cell);
/// Why a cell is not what its record says, or "": reads all its files. `record` is what it says.
std::string damage_of(const std::filesystem::path& cell, CellRecord& record);
std::string damage_of(const std::filesystem::path& cell);

}  // namespace rainref::sweep
