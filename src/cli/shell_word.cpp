#include "cli/shell_word.h"

namespace rainref::cli {

bool is_plain(std::string_view text, std::string_view marks) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
  for (const char c : text)
    if (letters.find(c) == letters.npos && marks.find(c) == marks.npos) return false;
  return true;
}

std::string quoted_word(std::string_view word, std::string_view marks, char quote, std::string_view inside) {
  if (!word.empty() && is_plain(word, marks)) return std::string(word);
  std::string out(1, quote);
  for (const char c : word) out += c == quote ? std::string(inside) : std::string(1, c);
  return out + quote;
}

}  // namespace rainref::cli
