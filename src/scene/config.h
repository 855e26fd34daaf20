// The effective configuration of a scene: each parameter that its variant uses, with its value and the origin of the value.
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

/// Origin of a value.
struct Origin {
  enum Kind : std::uint8_t { by_default, file, override_option } kind = by_default;
  SourceLocation at;  ///< for Kind file, and for an override from a plan
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
  /// Entries in the order of declaration. Throws Error(internal) if a parameter does not accept its value, or if there is no effect or no
  /// variant.
  Config(std::vector<Entry> entries, std::filesystem::path directory);

  const std::string& effect() const { return text("effect"); }
  const std::string& variant() const { return text("variant"); }

  // Typed access. Throws Error(internal) for a key that this variant does not use, or for another type.
  bool boolean(std::string_view key) const;
  std::int64_t integer(std::string_view key) const;
  const Integer2& integer2(std::string_view key) const;
  double real(std::string_view key) const;
  const Real2& real2(std::string_view key) const;
  const Real3& real3(std::string_view key) const;
  /// For Type::choice and Type::text.
  const std::string& text(std::string_view key) const;

  /// True if the scene or the command line gave the key; false for a default. Throws Error(internal) for an unknown key.
  bool given(std::string_view key) const { return entry(key).origin.kind != Origin::by_default; }
  const Entry& entry(std::string_view key) const;
  /// In the order of declaration: effect, variant, seed, run.*, then the effect's own.
  const std::vector<Entry>& entries() const { return entries_; }

  /// Changes the value of a key, for plans of many runs. Throws Error(internal) for an unknown key or a value that its parameter does not
  /// accept.
  void set(std::string_view key, Value value, Origin origin);

  /// The folder of the scene file, to which its relative file names refer; "" for the current folder.
  const std::filesystem::path& directory() const { return directory_; }

  /// One "key = value" line each, in the order of declaration. It is the same for equal configurations whatever the origins, and is itself
  /// a scene that loads as this configuration.
  std::string canonical_text() const;

 private:
  template <class T>
  const T& get(std::string_view key, const char* asked) const;

  std::size_t place_of(std::string_view key) const;

  std::vector<Entry> entries_;
  std::vector<std::uint32_t> by_key_;  ///< indices of the entries, sorted by their keys
  std::filesystem::path directory_;
};

}  // namespace rainref::scene
