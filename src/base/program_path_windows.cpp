// PATH has semicolons, and names of programs end in ".exe".
#include <system_error>

#include "base/machine.h"
#include "base/path_text.h"
#include "base/program_path.h"

namespace rainref {

namespace fs = std::filesystem;

bool starts_programs() { return true; }

fs::path program_in_path(const std::string& name) {
  const std::string all = machine::variable("PATH").value_or("");
  for (std::size_t begin = 0; begin <= all.size();) {
    const std::size_t end = std::min(all.find(';', begin), all.size());
    std::string folder = all.substr(begin, end - begin);
    std::erase(folder, '"');  // which may stand around a folder
    begin = end + 1;
    if (folder.empty()) continue;
    for (const char* const suffix : {".exe", ""}) {
      const fs::path program = utf8_path(folder) / utf8_path(name + suffix);
      std::error_code none;
      if (program.has_extension() && fs::is_regular_file(program, none)) return program;
    }
  }
  return {};
}

}  // namespace rainref
