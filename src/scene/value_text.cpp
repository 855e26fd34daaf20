#include "scene/value_text.h"

#include <fmt/format.h>

namespace rainref::scene {
namespace {

std::string literal(bool v) { return v ? "true" : "false"; }
std::string literal(std::int64_t v) { return fmt::format("{}", v); }
std::string literal(double v) { return real_text(v); }
std::string literal(const std::string& v) { return toml_string(v); }

template <class T, std::size_t N>
std::string literal(const std::array<T, N>& v) {
  std::string out = "[";
  for (std::size_t i = 0; i < N; ++i) {
    if (i) out += ", ";
    out += literal(v[i]);
  }
  return out + "]";
}

}  // namespace

std::string real_text(double value) {
  std::string out = fmt::format("{}", value);
  if (out.find_first_of(".en") == std::string::npos) out += ".0";  // 'n' is in "nan" and "inf"
  return out;
}

std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string value_text(const Value& value) {
  return std::visit([](const auto& v) { return literal(v); }, value);
}

}  // namespace rainref::scene
