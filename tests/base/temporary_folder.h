// A folder of its own for a test, removed with all that is in it.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rainref {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::random_device random;
    for (int tries = 0; tries < 100; ++tries) {
      path_ = named(::testing::TempDir() + "rainref-test-" + std::to_string(random()));
      if (std::filesystem::create_directory(path_)) return;
    }
    throw std::runtime_error("no temporary folder");
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / named(name); }
  const std::filesystem::path& path() const { return path_; }
  /// Names of all that lies in the folder, hidden files included, sorted.
  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
      const std::u8string name = entry.path().filename().u8string();
      out.emplace_back(name.begin(), name.end());
    }
    std::sort(out.begin(), out.end());
    return out;
  }

 private:
  // Texts are UTF-8, as in base/path_text.h.
  static std::filesystem::path named(const std::string& text) { return std::u8string(text.begin(), text.end()); }

  std::filesystem::path path_;
};

/// A file's bytes; "" when there is none.
inline std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Writes a file without help from the code under test.
inline void put(const std::filesystem::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

}  // namespace rainref
