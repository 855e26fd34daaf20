#include "judge/pass_texts.h"

namespace rainref::judge {

std::string_view pass_line(std::string_view file, int line) {
  std::string_view rest = detail::embedded_text(file);
  for (int n = 1; n < line && !rest.empty(); ++n) {
    const std::size_t end = rest.find('\n');
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  }
  rest = rest.substr(0, rest.find('\n'));
  rest = rest.substr(0, rest.find("//"));
  const std::size_t first = rest.find_first_not_of(' ');
  if (first == std::string_view::npos) return "";
  return rest.substr(first, rest.find_last_not_of(' ') + 1 - first);
}

}  // namespace rainref::judge
