#include "capture/python_literal.h"

#include <algorithm>
#include <limits>

namespace rainref::capture {
namespace {

constexpr int deepest = 8;
constexpr std::size_t most_keys = 16;

class Parser {
 public:
  explicit Parser(std::string_view text) : rest_(text) {}

  bool whole(PythonLiteral& out) {
    if (!value(out, 0)) return false;
    skip_space();
    return rest_.empty();
  }

 private:
  void skip_space() {
    const std::size_t n = rest_.find_first_not_of(" \t\r\n");
    rest_.remove_prefix(std::min(n, rest_.size()));
  }
  bool take(std::string_view token) {
    skip_space();
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  bool value(PythonLiteral& out, int depth) {
    skip_space();
    if (rest_.empty() || depth > deepest) return false;
    const char c = rest_.front();
    if (c == '\'' || c == '"') {
      out.kind = PythonLiteral::string;
      return quoted(out.text);
    }
    if (c >= '0' && c <= '9') return integer(out);
    if (take("True")) return boolean(out, 1);
    if (take("False")) return boolean(out, 0);
    if (take("(")) return sequence(out, PythonLiteral::tuple, ")", depth);
    if (take("[")) return sequence(out, PythonLiteral::list, "]", depth);
    if (take("{")) return dictionary(out, depth);
    return false;
  }

  bool boolean(PythonLiteral& out, std::size_t number) {
    out.kind = PythonLiteral::boolean;
    out.number = number;
    return true;
  }

  bool quoted(std::string& out) {
    const std::size_t end = rest_.find(rest_.front(), 1);
    if (end == std::string_view::npos) return false;
    out = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    return out.find_first_of("\\\n") == std::string::npos;
  }

  bool integer(PythonLiteral& out) {
    out.kind = PythonLiteral::integer;
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
    while (!rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9') {
      const auto digit = static_cast<std::size_t>(rest_.front() - '0');
      if (out.number > (most - digit) / 10) return false;
      out.number = 10 * out.number + digit;
      rest_.remove_prefix(1);
    }
    if (rest_.starts_with("L")) rest_.remove_prefix(1);  // Python 2 writes long integers this way
    return true;
  }

  bool sequence(PythonLiteral& out, PythonLiteral::Kind kind, std::string_view end, int depth) {
    out.kind = kind;
    bool comma = true;
    while (!take(end)) {
      if (!comma) return false;
      if (!value(out.items.emplace_back(), depth + 1)) return false;
      comma = take(",");
    }
    // (x) is x in parentheses, (x,) is a tuple.
    if (kind == PythonLiteral::tuple && out.items.size() == 1 && !comma) {
      PythonLiteral inner = std::move(out.items.front());
      out = std::move(inner);
    }
    return true;
  }

  bool dictionary(PythonLiteral& out, int depth) {
    out.kind = PythonLiteral::dictionary;
    bool comma = true;
    while (!take("}")) {
      PythonLiteral key;
      if (!comma || !value(key, depth + 1) || key.kind != PythonLiteral::string || !take(":")) return false;
      if (out.find(key.text) || out.keys.size() == most_keys) return false;
      out.keys.push_back(std::move(key.text));
      if (!value(out.items.emplace_back(), depth + 1)) return false;
      comma = take(",");
    }
    return true;
  }

  std::string_view rest_;
};

}  // namespace

const PythonLiteral* PythonLiteral::find(std::string_view key) const {
  for (std::size_t i = 0; i < items.size() && i < keys.size(); ++i) {
    if (keys[i] == key) return &items[i];
  }
  return nullptr;
}

std::optional<PythonLiteral> parse_python_literal(std::string_view text) {
  PythonLiteral out;
  if (!Parser(text).whole(out)) return std::nullopt;
  return out;
}

}  // namespace rainref::capture
