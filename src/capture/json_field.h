// Values of a JSON file that someone else may have written, checked one by one.
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

/// A value and where it stands. Whatever is not as asked is Error(port_files): "FILE: cases[3].width: expected a whole
/// number from 1 to 65536, found -1".
class JsonField {
 public:
  JsonField(const nlohmann::ordered_json& value, std::string file, std::string path = "")
      : value_(value), file_(std::move(file)), path_(std::move(path)) {}

  /// A member that must be there.
  JsonField operator[](std::string_view key) const;
  bool has(std::string_view key) const;
  /// Null, or a member that is not there.
  bool is_null(std::string_view key) const;
  std::vector<JsonField> elements() const;
  /// Members of an object, in order.
  std::vector<std::pair<std::string, JsonField>> members() const;
  /// Refuses an object with a member that is not among these, naming the nearest one.
  void require_known(std::span<const std::string> keys) const;

  bool is_number() const;
  std::string text() const;
  bool boolean() const;
  /// A whole number of 0 or more.
  std::size_t count() const;
  std::int64_t whole(std::int64_t low, std::int64_t high) const;
  double number() const;
  std::vector<std::string> texts() const;
  /// What to say of a text that is none of the names: "; did you mean 'x'?", or "" where nothing is near.
  using Hint = std::function<std::string(const std::string& text)>;
  /// The index of the text among these names. Without a hint, or where it says nothing, the nearest name is suggested.
  int one_of(std::span<const std::string> names, const Hint& hint = {}) const;
  /// The value as JSON.
  std::string dump() const;

  [[noreturn]] void fail(const std::string& expected) const;
  /// An error that is about the value but no matter of its type.
  [[noreturn]] void refuse(const std::string& message) const;

 private:
  std::string path_of(std::string_view key) const;

  const nlohmann::ordered_json& value_;
  std::string file_, path_;
};

}  // namespace rainref::capture
