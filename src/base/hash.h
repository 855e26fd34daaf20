// Hashes of canonical bytes: XXH3-128, seeded with the golden generation.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace rainref {

/// A 128-bit hash. text() is 32 lower-case hex digits, high word first, as `xxhsum -H2` prints it.
struct Hash128 {
  std::uint64_t high = 0, low = 0;
  std::string text() const;
  auto operator<=>(const Hash128&) const = default;
};

/// XXH3-128 of a stream of bytes, independent of how the stream is cut into add() calls.
class Hasher {
 public:
  Hasher();
  /// Uses another seed than the golden generation; 0 hashes as `xxhsum -H2` does.
  explicit Hasher(std::uint64_t seed);
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;
  void add(std::span<const std::byte> bytes);
  void add(std::string_view text) { add(std::as_bytes(std::span(text))); }
  Hash128 finish() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Unseeded hash of a file's bytes, as `xxhsum -H2` prints it.
Hash128 file_hash(std::span<const std::byte> bytes);

}  // namespace rainref
