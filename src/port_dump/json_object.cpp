#include "port_dump/json_object.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "capture/json_read.h"
#include "rainref/error.h"

namespace rainref::port_dump {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void fail(const std::string& message) { throw Error(ExitCode::port_files, message); }

std::string shown(const Json& value) {
  if (value.is_array()) return "a list";
  if (value.is_object()) return "an object";
  const std::string text = value.is_string() ? fmt::format("'{}'", value.get<std::string>()) : value.dump();
  return text.size() <= 40 ? text : "a text of " + std::to_string(text.size()) + " bytes";
}

}  // namespace

JsonObject::JsonObject(std::string_view text, std::string file, std::span<const std::string> known_keys) : file_(std::move(file)) {
  object_ = std::make_unique<const Json>(capture::parse_json(text, file_, capture::small_json));
  if (!object_->is_object()) fail(fmt::format("{}: expected an object {{...}}, found {}", file_, shown(*object_)));
  for (const auto& [key, value] : object_->items()) {
    if (std::ranges::find(known_keys, key) != known_keys.end()) continue;
    if (key.size() > 40) fail(fmt::format("{}: an unknown key of {} bytes", file_, key.size()));
    const std::string hint = did_you_mean(key, known_keys);
    fail(fmt::format("{}: unknown key '{}'{}", file_, key,
                     hint.empty() ? fmt::format("; known are {}", fmt::join(known_keys, ", ")) : hint));
  }
}

JsonObject::~JsonObject() = default;
JsonObject::JsonObject(JsonObject&&) noexcept = default;

void JsonObject::refuse(const std::string& key, const std::string& why) const { fail(fmt::format("{}: {}: {}", file_, key, why)); }

void JsonObject::refuse_value(const std::string& key, const std::string& expected, const Json& found) const {
  refuse(key, fmt::format("expected {}, found {}", expected, shown(found)));
}

const Json* JsonObject::find(const std::string& key) const {
  const auto found = object_->find(key);
  return found == object_->end() ? nullptr : &*found;
}

std::optional<std::string> JsonObject::text(const std::string& key) const {
  const Json* value = find(key);
  if (!value) return std::nullopt;
  if (!value->is_string()) refuse_value(key, "a text", *value);
  return value->get<std::string>();
}

std::optional<bool> JsonObject::boolean(const std::string& key) const {
  const Json* value = find(key);
  if (!value) return std::nullopt;
  if (!value->is_boolean()) refuse_value(key, "true or false", *value);
  return value->get<bool>();
}

std::size_t JsonObject::count_of(const std::string& key, const Json& value) const {
  if (!value.is_number_unsigned() || !std::in_range<std::size_t>(value.get<std::uint64_t>())) {
    refuse_value(key, "a whole number, at least 0", value);
  }
  return value.get<std::size_t>();
}

std::optional<std::size_t> JsonObject::count(const std::string& key) const {
  const Json* value = find(key);
  if (!value) return std::nullopt;
  return count_of(key, *value);
}

std::optional<std::size_t> JsonObject::choice(const std::string& key, std::span<const std::string> choices, const Hint& hint) const {
  const Json* value = find(key);
  if (!value) return std::nullopt;
  const auto expected = [&] { return fmt::format("one of '{}'", fmt::join(choices, "', '")); };
  if (!value->is_string()) refuse_value(key, expected(), *value);
  const auto& word = value->get_ref<const std::string&>();
  const auto found = std::ranges::find(choices, word);
  if (found == choices.end()) {
    std::string said = hint && word.size() <= 80 ? hint(word) : std::string();
    if (said.empty() && word.size() <= 40) said = did_you_mean(word, choices);
    refuse(key, fmt::format("expected {}, found {}{}", expected(), shown(*value), said));
  }
  return static_cast<std::size_t>(found - choices.begin());
}

std::optional<std::vector<std::pair<std::string, std::size_t>>> JsonObject::counts(const std::string& key) const {
  const Json* value = find(key);
  if (!value) return std::nullopt;
  if (!value->is_object()) refuse_value(key, "an object of whole numbers, as {\"x\": 0, \"y\": 4}", *value);
  std::vector<std::pair<std::string, std::size_t>> out;
  for (const auto& [name, number] : value->items()) {
    out.emplace_back(name, count_of(key + "." + name.substr(0, 40), number));
  }
  std::ranges::sort(out);
  return out;
}

}  // namespace rainref::port_dump
