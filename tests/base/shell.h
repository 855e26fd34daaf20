// Commands of the shell.
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <utility>

namespace rainref {

/// What a command prints, its errors with it, and how it ended: with 0 where it succeeded.
inline std::pair<std::string, int> output_of(const std::string& command) {
  std::string text;
  std::FILE* pipe = ::popen(("{ " + command + "\n} 2>&1").c_str(), "r");
  if (!pipe) return {"cannot be run", -1};
  std::array<char, 4096> part;
  while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe)) text.append(part.data(), n);
  return {text, ::pclose(pipe)};
}

}  // namespace rainref
