// What a cell is called: a hash of all that its result depends on, and of nothing else.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/config.h"

namespace rainref::sweep {

/// 32 hexadecimal digits: the XXH3-128 of a text.
std::string id_of(std::string_view text);

/// Hashes of files, each read once as long as it stands there unchanged.
class Inputs {
 public:
  /// The configuration's canonical text without run.frames, files by what they hold in place of their names: a picture's decoded hash,
  /// another file's or a sequence's bytes. Throws Error naming the key where a file cannot be read. Lines of values that are those of the
  /// call before are not made again.
  std::string text_of(const scene::Config& config);
  /// Of a folder's files, names and bytes. Throws Error(io).
  std::string folder_hash(const std::filesystem::path& folder);
  /// Of a file's bytes. Throws Error(io).
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
