#include "scene/describe.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "scene/json.h"
#include "scene/value_text.h"

namespace rainref::scene {
namespace {

constexpr std::size_t columns = 100;
constexpr std::string_view indent = "    ";

// Columns that a UTF-8 text takes, one for each code point.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t to) { return text + std::string(to - std::min(to, width(text)), ' '); }

// Indented lines of whole words; a word longer than a line is not broken.
std::string wrapped(std::string_view text) {
  std::string out, line;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!line.empty() && indent.size() + width(line) + 1 + width(word) > columns) {
      out += fmt::format("{}{}\n", indent, line);
      line.clear();
    }
    if (!line.empty()) line += ' ';
    line += word;
  }
  return out + fmt::format("{}{}\n", indent, line);
}

std::string default_text(const Parameter& p) { return p.is_required ? "required" : value_text(p.default_value); }

std::string range_and_unit(const Parameter& p) {
  std::string out = range_text(p);
  if (!p.unit.empty()) out += fmt::format("{}[{}]", out.empty() ? "" : " ", p.unit);
  return out;
}

std::string notes(const Parameter& p) {
  std::string out = p.sentence;
  if (p.type == Type::choice) out += fmt::format(" One of '{}'.", fmt::join(p.choices, "', '"));
  for (const auto& [variant, value] : p.variant_defaults) {
    out += fmt::format(" Default of variant '{}': {}.", variant, value_text(value));
  }
  if (!p.variants.empty()) out += fmt::format(" Only in variant '{}'.", fmt::join(p.variants, "', '"));
  return out;
}

}  // namespace

std::string describe_text(std::span<const Parameter> parameters) {
  std::size_t keys = 0, types = 0, defaults = 0;
  for (const Parameter& p : parameters) {
    keys = std::max(keys, width(p.key));
    types = std::max(types, width(name(p.type)));
    // A long default (a file name) moves only its own range to the right.
    if (width(default_text(p)) <= 20) defaults = std::max(defaults, width(default_text(p)));
  }
  std::string out;
  for (const Parameter& p : parameters) {
    std::string line = fmt::format("{}  {}  {}  {}", padded(p.key, keys), padded(name(p.type), types), padded(default_text(p), defaults),
                                   range_and_unit(p));
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n" + wrapped(notes(p));
  }
  return out;
}

std::string describe_json(std::span<const Parameter> parameters) { return parameters_json(parameters).dump(2) + "\n"; }

}  // namespace rainref::scene
