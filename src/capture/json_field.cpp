#include "capture/json_field.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "rainref/error.h"

namespace rainref::capture {

using Json = nlohmann::ordered_json;

namespace {

// Shortens a long value, because a message is one line.
std::string shown(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array";
  const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

constexpr std::size_t longest_word = 80;  // longer words get no suggestion

}  // namespace

void JsonField::refuse(const std::string& message) const {
  throw Error(ExitCode::port_files, fmt::format("{}: {}{}{}", file_, path_, path_.empty() ? "" : ": ", message));
}
void JsonField::fail(const std::string& expected) const { refuse(fmt::format("expected {}, found {}", expected, shown(value_))); }

bool JsonField::has(std::string_view key) const {
  if (!value_.is_object()) fail("an object");
  return value_.contains(key);
}
bool JsonField::is_null(std::string_view key) const { return !has(key) || value_.at(std::string(key)).is_null(); }

JsonField JsonField::operator[](std::string_view key) const {
  if (!has(key)) refuse(fmt::format("'{}' is missing", key));
  return {value_.at(std::string(key)), file_, path_of(key)};
}
std::string JsonField::path_of(std::string_view key) const {
  return fmt::format("{}{}{}", path_, path_.empty() ? "" : ".", key.substr(0, longest_word));
}

std::vector<JsonField> JsonField::elements() const {
  if (!value_.is_array()) fail("an array");
  std::vector<JsonField> out;
  for (std::size_t i = 0; i < value_.size(); ++i) out.emplace_back(value_[i], file_, fmt::format("{}[{}]", path_, i));
  return out;
}

std::vector<std::pair<std::string, JsonField>> JsonField::members() const {
  if (!value_.is_object()) fail("an object");
  std::vector<std::pair<std::string, JsonField>> out;
  for (const auto& [key, value] : value_.items()) out.emplace_back(key, JsonField(value, file_, path_of(key)));
  return out;
}

void JsonField::require_known(std::span<const std::string> keys) const {
  for (const auto& [key, value] : members()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    if (key.size() > longest_word) refuse(fmt::format("an unknown key of {} bytes", key.size()));
    const std::string hint = did_you_mean(key, keys);
    refuse(fmt::format("unknown key '{}'{}", key, hint.empty() ? fmt::format("; known are {}", fmt::join(keys, ", ")) : hint));
  }
}

std::string JsonField::text() const {
  if (!value_.is_string()) fail("a text");
  return value_.get<std::string>();
}

bool JsonField::boolean() const {
  if (!value_.is_boolean()) fail("true or false");
  return value_.get<bool>();
}

std::size_t JsonField::count() const {
  if (!value_.is_number_unsigned() || !std::in_range<std::size_t>(value_.get<std::uint64_t>())) fail("a whole number, at least 0");
  return value_.get<std::size_t>();
}

std::int64_t JsonField::whole(std::int64_t low, std::int64_t high) const {
  const bool fits =
      value_.is_number_integer() && !(value_.is_number_unsigned() && value_.get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX));
  if (!fits || value_.get<std::int64_t>() < low || value_.get<std::int64_t>() > high)
    fail(fmt::format("a whole number from {} to {}", low, high));
  return value_.get<std::int64_t>();
}

bool JsonField::is_object() const { return value_.is_object(); }
bool JsonField::is_number() const { return value_.is_number(); }

double JsonField::number() const {
  if (!value_.is_number()) fail("a number");
  return value_.get<double>();
}

std::vector<std::string> JsonField::texts() const {
  std::vector<std::string> out;
  for (const JsonField& e : elements()) out.push_back(e.text());
  return out;
}

int JsonField::one_of(std::span<const std::string> names, const Hint& hint) const {
  const std::string found = text();
  const auto at = std::find(names.begin(), names.end(), found);
  if (at != names.end()) return static_cast<int>(at - names.begin());
  const std::string expected = fmt::format("one of {}", fmt::join(names, ", "));
  if (found.size() > longest_word) fail(expected);
  const std::string meant = hint ? hint(found) : "";
  refuse(fmt::format("expected {}, found '{}'{}", expected, found, meant.empty() ? did_you_mean(found, names) : meant));
}

std::string JsonField::dump() const { return value_.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace rainref::capture
