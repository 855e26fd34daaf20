#include "base/program_path.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "base/path_text.h"

namespace rainref {

namespace fs = std::filesystem;

bool starts_programs() { return true; }

fs::path program_in_path(const std::string& name) {
  const char* const variable = std::getenv("PATH");
  const std::string all = variable ? variable : "/usr/local/bin:/usr/bin:/bin";
  for (std::size_t begin = 0; begin <= all.size();) {
    const std::size_t end = std::min(all.find(':', begin), all.size());
    const std::string folder = all.substr(begin, end - begin);
    const fs::path program = utf8_path(folder.empty() ? "." : folder) / utf8_path(name);
    std::error_code none;
    if (fs::is_regular_file(program, none) && ::access(program.c_str(), X_OK) == 0) return program;
    begin = end + 1;
  }
  return {};
}

}  // namespace rainref
