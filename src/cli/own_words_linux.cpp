// From files of the kernel. The link leads to the program even if its file was replaced.
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "cli/own_program.h"
#include "cli/own_words.h"
#include "rainref/error.h"

namespace rainref::cli {

const char* own_program_name() { return "/proc/self/exe"; }

std::filesystem::path own_program() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink(own_program_name(), error);
  if (error) throw Error(ExitCode::io, fmt::format("{}: {}", own_program_name(), error.message()));
  return program;
}

std::vector<std::string> own_arguments() {
  std::ifstream in("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> all;
  for (std::string word; std::getline(in, word, '\0');) all.push_back(word);
  if (!all.empty()) all.erase(all.begin());
  return all;
}

}  // namespace rainref::cli
