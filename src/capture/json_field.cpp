#include "capture/json_field.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "rainref/error.h"

namespace rainref::capture {

using Json = nlohmann::ordered_json;

namespace {

// A long value is cut: a message is one line.
std::string shown(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array";
  const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

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
  return {value_.at(std::string(key)), file_, path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key)};
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
  for (const auto& [key, value] : value_.items()) out.emplace_back(key, JsonField(value, file_, fmt::format("{}.{}", path_, key)));
  return out;
}

std::string JsonField::text() const {
  if (!value_.is_string()) fail("a text");
  return value_.get<std::string>();
}

std::int64_t JsonField::whole(std::int64_t low, std::int64_t high) const {
  const bool fits =
      value_.is_number_integer() && !(value_.is_number_unsigned() && value_.get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX));
  if (!fits || value_.get<std::int64_t>() < low || value_.get<std::int64_t>() > high)
    fail(fmt::format("a whole number from {} to {}", low, high));
  return value_.get<std::int64_t>();
}

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

int JsonField::one_of(std::span<const std::string> names) const {
  const std::string found = text();
  const auto at = std::find(names.begin(), names.end(), found);
  if (at == names.end()) refuse(fmt::format("expected one of {}, found '{}'{}", fmt::join(names, ", "), found, did_you_mean(found, names)));
  return static_cast<int>(at - names.begin());
}

std::string JsonField::dump() const { return value_.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace rainref::capture
