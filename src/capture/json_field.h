// Checks the values of an untrusted JSON file one by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace rainref::capture {

/// A value and its location. Throws Error(port_files) for any unexpected value: "FILE: cases[3].width: expected a whole number from 1 to
/// 65536, found -1".
class JsonField {
 public:
  JsonField(const nlohmann::ordered_json& value, std::string file, std::string path = "")
      : value_(value), file_(std::move(file)), path_(std::move(path)) {}

  /// Returns a required member.
  JsonField operator[](std::string_view key) const;
  bool has(std::string_view key) const;
  /// True if the member is null or missing.
  bool is_null(std::string_view key) const;
  std::vector<JsonField> elements() const;
  /// Returns the members of an object, in order.
  std::vector<std::pair<std::string, JsonField>> members() const;
  /// Throws if the object has a member with another key, and names the nearest key.
  void require_known(std::span<const std::string> keys) const;

  bool is_number() const;
  bool is_object() const;
  std::string text() const;
  bool boolean() const;
  /// A non-negative integer.
  std::size_t count() const;
  std::int64_t whole(std::int64_t low, std::int64_t high) const;
  double number() const;
  std::vector<std::string> texts() const;
  /// Returns the hint for an unknown name: "; did you mean 'x'?", or "" if no name is near.
  using Hint = std::function<std::string(const std::string& text)>;
  /// Returns the index of the text among these names. Without a hint, or if it is "", the error suggests the nearest name.
  int one_of(std::span<const std::string> names, const Hint& hint = {}) const;
  /// Returns the value as JSON.
  std::string dump() const;

  [[noreturn]] void fail(const std::string& expected) const;
  /// Throws an error about the value that does not concern its type.
  [[noreturn]] void refuse(const std::string& message) const;

 private:
  std::string path_of(std::string_view key) const;

  const nlohmann::ordered_json& value_;
  std::string file_, path_;
};

}  // namespace rainref::capture
