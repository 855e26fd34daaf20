#include "sweep/command_files.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "base/path_text.h"
#include "base/program_path.h"

namespace rainref::sweep {
namespace {

namespace fs = std::filesystem;

/// Words as a shell separates them. A quoted word may be a command itself: sh -c '...'.
void add_words(std::string_view command, std::vector<std::string>& words) {
  std::string word;
  char quote = 0;
  bool has_parts = false;
  const auto end = [&] {
    if (word.empty()) return;
    words.push_back(word);
    if (has_parts) add_words(std::string(word), words);
    word.clear();
    has_parts = false;
  };
  for (std::size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    const bool is_space = c == ' ' || c == '\t' || c == '\n';
    if (c == '\\' && quote != '\'' && i + 1 < command.size()) {
      word += command[++i];
    } else if (quote ? c == quote : c == '"' || c == '\'') {
      quote = quote ? 0 : c;
    } else if (!quote && (is_space || std::string_view(";|&()<>`").find(c) != std::string_view::npos)) {
      end();
    } else {
      has_parts = has_parts || is_space;
      word += c;
    }
  }
  end();
}

/// Empty if the word names no file.
fs::path file_of(const std::string& word) {
  std::error_code error;
  if (const fs::path file = utf8_path(word); fs::is_regular_file(file, error)) return fs::absolute(file).lexically_normal();
  if (word.empty() || utf8_path(word).has_parent_path()) return {};
  const fs::path program = program_in_path(word);
  constexpr std::array of_machine{"/bin", "/sbin", "/usr/bin", "/usr/sbin"};
  const auto is_of_machine = [&](const char* folder) { return program.parent_path() == folder; };
  return std::any_of(of_machine.begin(), of_machine.end(), is_of_machine) ? fs::path() : program;
}

}  // namespace

std::vector<fs::path> files_named_by(const std::string& command) {
  std::vector<std::string> words;
  add_words(command, words);
  std::vector<fs::path> files;
  for (const std::string& word : words) {
    for (const std::string& part : {word, word.substr(std::min(word.find('='), word.size() - 1) + 1)}) {
      const fs::path file = file_of(part);
      if (!file.empty() && std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
    }
  }
  return files;
}

}  // namespace rainref::sweep
