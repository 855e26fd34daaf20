#include "cache/program.h"

#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/number_text.h"

namespace rainref::cache {
namespace {

/// The file of the mapping that contains an address, from lines "begin-end rights offset device inode path"; empty: none.
std::string mapped_file(const void* address) {
  const auto wanted = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const std::size_t dash = line.find('-'), space = line.find(' ');
    if (dash == std::string::npos || space == std::string::npos || dash > space) continue;
    const std::string_view range = std::string_view(line).substr(0, space);
    const auto begin = whole_from<std::uintptr_t>(range.substr(0, dash), 16), end = whole_from<std::uintptr_t>(range.substr(dash + 1), 16);
    if (!begin || !end || wanted < *begin || wanted >= *end) continue;
    const std::size_t path = line.find('/');
    return path == std::string::npos ? std::string() : line.substr(path);
  }
  return {};
}

/// None if it cannot be read. Reads piece by piece, because touching new memory of a program's size takes longer than reading it.
std::optional<Hash128> hash_of(const std::string& path) {
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
    const std::string file = mapped_file(reinterpret_cast<const void*>(&program_hash));
    if (file.empty()) return {};
    return hash_of(file);
  }();
  return hash;
}

}  // namespace rainref::cache
