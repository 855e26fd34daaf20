// A JSON object whose keys are all known: port.json and the sidecars of raw bytes.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace rainref::port_dump {

/// The object that a JSON text is. `file` is its quoted name and starts every message. Every failure is
/// Error(port_files): text that is no JSON (with line and column), that nests deeper than 8 or repeats a key, an
/// unknown key (with the nearest known one), a value of another type than asked for. A getter gives nothing for an
/// absent key.
class JsonObject {
 public:
  JsonObject(std::string_view text, std::string file, std::span<const std::string> known_keys);
  ~JsonObject();
  JsonObject(JsonObject&&) noexcept;

  bool has(const std::string& key) const { return find(key) != nullptr; }
  std::optional<std::string> text(const std::string& key) const;
  std::optional<bool> boolean(const std::string& key) const;
  /// A whole number, at least 0.
  std::optional<std::size_t> count(const std::string& key) const;
  /// What to say of a text that is none of the choices: "; did you mean 'x'?", or "" where nothing is near.
  using Hint = std::function<std::string(const std::string& word)>;
  /// Which of the choices the text is. Without a hint, or where it says nothing, the nearest choice is named.
  std::optional<std::size_t> choice(const std::string& key, std::span<const std::string> choices, const Hint& hint = {}) const;
  /// {"a": 0, "b": 4}, in the order of the names.
  std::optional<std::vector<std::pair<std::string, std::size_t>>> counts(const std::string& key) const;

  /// Throws Error(port_files): "<file>: <key>: <why>".
  [[noreturn]] void refuse(const std::string& key, const std::string& why) const;
  const std::string& file() const { return file_; }

 private:
  const nlohmann::ordered_json* find(const std::string& key) const;
  /// The value as a whole number that std::size_t holds.
  std::size_t count_of(const std::string& key, const nlohmann::ordered_json& value) const;
  [[noreturn]] void refuse_value(const std::string& key, const std::string& expected, const nlohmann::ordered_json& found) const;

  std::string file_;
  std::unique_ptr<const nlohmann::ordered_json> object_;
};

}  // namespace rainref::port_dump
