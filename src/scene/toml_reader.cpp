#include "scene/toml_reader.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "scene/value_text.h"

namespace rainref::scene {
namespace {

constexpr std::size_t largest_file = std::size_t{1} << 20;
// The library destroys nested tables recursively and does not limit how many a dotted key opens, so a hostile file of a few hundred
// kilobytes could exhaust the stack. It limits nested values (256). Lines with keys have few dots.
constexpr int most_dots_in_line = 32;
constexpr int deepest_key = 8;
constexpr std::size_t longest_found = 60;

SourceLocation place(const toml::source_region& source, const std::string& file) {
  return {file, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

// The 1-based line that has too many dots, or 0. Comment lines hold no keys.
int too_deep_line(std::string_view text) {
  int line = 1, dots = 0;
  bool blank = true, comment = false;
  for (const char c : text) {
    if (c == '\n') {
      ++line;
      dots = 0;
      blank = true;
      comment = false;
      continue;
    }
    if (blank && c == '#') comment = true;
    if (c != ' ' && c != '\t') blank = false;
    if (c == '.' && !comment && ++dots > most_dots_in_line) return line;
  }
  return 0;
}

// A part of a key in TOML's form.
std::string key_part(std::string_view part) {
  const bool bare = !part.empty() && std::all_of(part.begin(), part.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? std::string(part) : toml_string(part);
}

RawValue raw(const toml::node& node, const std::string& file) {
  RawValue out{RawValue::Date{}, place(node.source(), file)};
  if (const auto* b = node.as_boolean()) out.data = b->get();
  if (const auto* i = node.as_integer()) out.data = i->get();
  if (const auto* d = node.as_floating_point()) out.data = d->get();
  if (const auto* s = node.as_string()) out.data = s->get();
  if (node.is_table()) out.data = RawValue::Table{};
  if (const auto* a = node.as_array()) {
    std::vector<RawValue> elements;
    for (const toml::node& element : *a) elements.push_back(raw(element, file));
    out.data = std::move(elements);
  }
  return out;
}

void flatten(const toml::table& table, const std::string& prefix, int depth, const std::string& file, std::vector<RawEntry>& out) {
  for (const auto& [key, node] : table) {
    const std::string full = prefix + key_part(key.str());
    const toml::table* inner = node.as_table();
    if (inner && !inner->empty() && depth < deepest_key) {
      flatten(*inner, full + ".", depth + 1, file, out);
    } else {
      out.push_back({full, place(key.source(), file), raw(node, file)});
    }
  }
}

std::string one_line(std::string_view text) {
  std::string out(text);
  std::replace_if(
      out.begin(), out.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return out;
}

void append_text(const RawValue& value, std::string& out) {
  if (out.size() > longest_found) return;
  if (const auto* b = std::get_if<bool>(&value.data)) out += *b ? "true" : "false";
  if (const auto* i = std::get_if<std::int64_t>(&value.data)) out += fmt::format("{}", *i);
  if (const auto* d = std::get_if<double>(&value.data)) out += real_text(*d);
  if (const auto* s = std::get_if<std::string>(&value.data)) out += toml_string(*s);
  if (std::holds_alternative<RawValue::Table>(value.data)) out += "a table";
  if (std::holds_alternative<RawValue::Date>(value.data)) out += "a date or time";
  if (const auto* a = std::get_if<std::vector<RawValue>>(&value.data)) {
    out += '[';
    for (std::size_t i = 0; i < a->size() && out.size() <= longest_found; ++i) {
      if (i) out += ", ";
      append_text((*a)[i], out);
    }
    out += ']';
  }
}

}  // namespace

std::string RawValue::text() const {
  std::string out;
  append_text(*this, out);
  if (out.size() <= longest_found) return out;
  std::size_t end = longest_found;
  while (end > 0 && (static_cast<unsigned char>(out[end]) & 0xc0) == 0x80) --end;  // never inside a UTF-8 sequence
  return out.substr(0, end) + "…";
}

std::vector<RawEntry> read_toml(std::string_view text, const std::string& file) {
  if (text.size() > largest_file) {
    throw Error(ExitCode::usage, SourceLocation{file}, fmt::format("larger than {} bytes, so not a scene", largest_file));
  }
  if (const int line = too_deep_line(text)) {
    throw Error(ExitCode::usage, SourceLocation{file, line, 0},
                fmt::format("more than {} dots in one line; no scene nests keys so deeply", most_dots_in_line));
  }
  try {
    const toml::table table = toml::parse(text, std::string_view(file));
    std::vector<RawEntry> out;
    flatten(table, "", 1, file, out);
    std::stable_sort(out.begin(), out.end(), [](const RawEntry& a, const RawEntry& b) {
      return std::tie(a.at.line, a.at.column) < std::tie(b.at.line, b.at.column);
    });
    return out;
  } catch (const toml::parse_error& e) {
    throw Error(ExitCode::usage, place(e.source(), file), one_line(e.description()));
  }
}

std::optional<RawValue> read_toml_value(std::string_view text) {
  try {
    std::vector<RawEntry> entries = read_toml(fmt::format("value = {}", text), "");
    if (entries.size() == 1 && entries[0].key == "value") return std::move(entries[0].value);
  } catch (const Error&) {
  }
  return std::nullopt;
}

std::optional<RawValue> read_bare_text(std::string_view text) {
  try {
    // The library checks whether the bytes are UTF-8; quoted as a string they have no other meaning.
    static_cast<void>(toml::parse(fmt::format("value = {}", toml_string(text))));
    return RawValue{std::string(text), {}};
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

}  // namespace rainref::scene
