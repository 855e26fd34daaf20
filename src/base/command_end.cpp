#include "base/command_end.h"

#include <cstddef>

namespace rainref {
namespace {

constexpr std::size_t kept_lines = 20;

}  // namespace

std::vector<std::string> last_lines_of(const std::string& text) {
  std::vector<std::string> lines{""};
  for (const char c : text) {
    if (c == '\n')
      lines.emplace_back();
    else if (c != '\r')
      lines.back() += c;
  }
  if (lines.back().empty()) lines.pop_back();
  if (lines.size() > kept_lines) lines.erase(lines.begin(), lines.end() - kept_lines);
  return lines;
}

}  // namespace rainref
