#include "cache/program.h"

#include <filesystem>
#include <fstream>
#include <span>
#include <vector>

#include "base/code_file.h"

namespace rainref::cache {
namespace {

/// None if it cannot be read. Reads piece by piece, because touching new memory of a program's size takes longer than reading it.
std::optional<Hash128> hash_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return {};
  Hasher hasher(0);
  std::vector<char> piece(std::size_t{1} << 16);
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0)
    hasher.add(std::as_bytes(std::span(piece)).first(static_cast<std::size_t>(file.gcount())));
  if (!file.eof()) return {};
  return hasher.finish();
}

}  // namespace

std::optional<Hash128> program_hash() {
  static const std::optional<Hash128> hash = []() -> std::optional<Hash128> {
    const std::filesystem::path file = code_file();
    if (file.empty()) return {};
    return hash_of(file);
  }();
  return hash;
}

}  // namespace rainref::cache
