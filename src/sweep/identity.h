// The name of a cell: a hash of exactly the inputs of its result.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/config.h"

namespace rainref::sweep {

/// True if the scene has this key.
bool has(const scene::Config& config, std::string_view key);
/// 32 hexadecimal digits: the XXH3-128 of a text.
std::string id_of(std::string_view text);

/// Hashes of files; each file is read once while it is unchanged.
class Inputs {
 public:
  /// The configuration's canonical text without run.frames, with file names replaced by contents: the decoded hash of a picture, the bytes
  /// of another file or a sequence. Throws Error with the key if a file cannot be read. Lines whose values did not change since the last
  /// call are reused.
  std::string text_of(const scene::Config& config);
  /// Hash of a folder's files, names and bytes. Throws Error(io).
  std::string folder_hash(const std::filesystem::path& folder);
  /// Hash of a file's bytes. Throws Error(io).
  std::string bytes_hash(const std::filesystem::path& file);

 private:
  struct Line {
    std::string key;
    scene::Value value;
    std::string text;
    bool is_of_file;
  };
  std::string hash_of(const scene::Config& config, const std::string& key);

  std::map<std::string, std::string> known_;
  std::vector<Line> lines_;
  std::filesystem::path directory_;
};

}  // namespace rainref::sweep
