#include "cli/option_values.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "base/number_text.h"
#include "rainref/error.h"
#include "scene/rows_of_text.h"

namespace rainref::cli {

int whole_number(const std::string& text, const char* option, int low, int high) {
  const std::optional<int> value = whole_from<int>(text);
  if (!value || *value < low || *value > high)
    throw Error(ExitCode::usage, fmt::format("{}: expected a whole number from {} to {}, found '{}'", option, low, high, text));
  return *value;
}

std::vector<std::string> list_of(const std::string& text) {
  const std::vector<std::string_view> parts = scene::split(text, ',');
  return {parts.begin(), parts.end()};
}

void require_word(const std::string& text, const char* option, const char* expected, const std::vector<std::string>& words) {
  if (std::find(words.begin(), words.end(), text) != words.end()) return;
  throw Error(ExitCode::usage, fmt::format("{}: expected {}, found '{}'{}", option, expected, text, did_you_mean(text, words)));
}

void require_text(const std::string& text, const char* option, const char* expected) {
  if (text.empty()) throw Error(ExitCode::usage, fmt::format("{}: expected {}, found ''", option, expected));
}

}  // namespace rainref::cli
