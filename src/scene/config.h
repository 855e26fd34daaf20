// The effective configuration of a scene: each parameter that its variant uses, with its value and where it came from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rainref/error.h"
#include "scene/parameter.h"

namespace rainref::scene {

/// Where a value came from.
struct Origin {
  enum Kind : std::uint8_t { by_default, file, override_option } kind = by_default;
  SourceLocation at;  ///< of Kind file; of an override that a plan says
  /// "scenes/puddle/x.toml:12:3", "--set" or "default".
  std::string text() const;
};

class Config {
 public:
  struct Entry {
    Parameter parameter;
    Value value;
    Origin origin;
  };

  Config() = default;
  /// Entries in the order of declaration. Throws Error(internal) when a value is not one that its parameter accepts, or
  /// when there is no effect or no variant.
  Config(std::vector<Entry> entries, std::filesystem::path directory);

  const std::string& effect() const { return text("effect"); }
  const std::string& variant() const { return text("variant"); }

  // Typed access. A key that this variant does not use, or another type, is a defect: Error(internal).
  bool boolean(std::string_view key) const;
  std::int64_t integer(std::string_view key) const;
  const Integer2& integer2(std::string_view key) const;
  double real(std::string_view key) const;
  const Real2& real2(std::string_view key) const;
  const Real3& real3(std::string_view key) const;
  /// Of Type::choice and Type::text.
  const std::string& text(std::string_view key) const;

  /// Whether the scene or the command line gave it; false for a default. Error(internal) for an unknown key.
  bool given(std::string_view key) const { return entry(key).origin.kind != Origin::by_default; }
  const Entry& entry(std::string_view key) const;
  /// In the order of declaration: effect, variant, seed, run.*, then the effect's own.
  const std::vector<Entry>& entries() const { return entries_; }

  /// Another value of a key, for plans of many runs. Throws Error(internal) for a key that is not here and a value that its parameter does
  /// not accept.
  void set(std::string_view key, Value value, Origin origin);

  /// The folder of the scene file, which relative file names in it refer to; "" for the current folder.
  const std::filesystem::path& directory() const { return directory_; }

  /// One "key = value" line each, in the order of declaration; the same for equal configurations whatever their
  /// origins, and itself a scene that loads as this configuration.
  std::string canonical_text() const;

 private:
  template <class T>
  const T& get(std::string_view key, const char* asked) const;

  std::size_t place_of(std::string_view key) const;

  std::vector<Entry> entries_;
  std::vector<std::uint32_t> by_key_;  ///< places of the entries, sorted by their keys
  std::filesystem::path directory_;
};

}  // namespace rainref::scene
