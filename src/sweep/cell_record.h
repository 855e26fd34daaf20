// cell.json: describes a finished cell and its files, so that every changed byte is detected.
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
  std::string path;  ///< relative to the cell's folder
  std::uintmax_t bytes;
  std::string hash;  ///< XXH3-128
};

/// Writes the files of a cell, and cell.json last.
class CellWriter {
 public:
  explicit CellWriter(const std::filesystem::path& cell);
  /// For files written by others; call wrote() for each.
  const std::filesystem::path& folder() const { return folder_.path(); }
  void write(const std::string& path, std::span<const std::byte> bytes);
  void write(const std::string& path, std::string_view text) { write(path, std::as_bytes(std::span(text))); }
  void wrote(const std::string& path);
  /// Adds the files to the record, and renames the folder to its final name. False: another process finished first. Throws Error(io).
  /// `names`: parent folders of earlier cells that must be synced to disk; afterwards those of this one.
  bool finish(nlohmann::ordered_json record, std::vector<std::filesystem::path>& names);
  std::uintmax_t bytes() const;

 private:
  capture::NewFolder folder_;
  std::vector<KeptFile> files_;
};

/// Contents of a finished cell's record.
struct CellRecord {
  std::string verdict;                                          ///< for a judged cell
  std::vector<std::pair<std::string, std::string>> last_frame;  ///< "pass.buffer", and its hash
  std::vector<KeptFile> files;
};
/// Reads the record of a finished cell. Throws Error(io) if it cannot be read. Throws Error(port_files) if it is damaged: its hash is
/// wrong, a value has the wrong kind, it belongs to another cell, a file is elsewhere, or its last frame is not the one before its end.
CellRecord read_record(const std::filesystem::path& cell);
/// Returns how a cell differs from its record, or "". Reads all its files. `record` receives the contents of the record.
std::string damage_of(const std::filesystem::path& cell, CellRecord& record);
std::string damage_of(const std::filesystem::path& cell);

}  // namespace rainref::sweep
