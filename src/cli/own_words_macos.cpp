// Written from Apple's documents and never compiled.
#include <crt_externs.h>
#include <mach-o/dyld.h>

#include <cstdint>

#include "base/path_text.h"
#include "cli/own_program.h"
#include "cli/own_words.h"

namespace rainref::cli {

const char* own_program_name() {
  static const std::string name = [] {
    std::uint32_t size = 0;
    ::_NSGetExecutablePath(nullptr, &size);
    std::string path(size, '\0');
    ::_NSGetExecutablePath(path.data(), &size);
    path.resize(path.find('\0'));
    return path;
  }();
  return name.c_str();
}

std::filesystem::path own_program() {
  std::error_code error;
  const std::filesystem::path named = utf8_path(own_program_name()), real = std::filesystem::canonical(named, error);
  return error ? named : real;
}

std::vector<std::string> own_arguments() {
  char** const all = *::_NSGetArgv();
  return {all + 1, all + *::_NSGetArgc()};
}

}  // namespace rainref::cli
