// A state as bytes: docs/notes/state.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "state/items.h"

namespace rainref::state {

inline constexpr std::uint32_t format_version = 1;

/// Identifies the owner of a state.
struct Texts {
  std::string scene;   ///< "key = value" lines
  std::string inputs;  ///< a line for each picture that was read: key and hash
  std::string note;    ///< other text that the writer stores with it
};

/// Receives the bytes of a file in order.
using Sink = std::function<void(std::span<const std::byte>)>;
void write(const Texts& texts, const Items& items, const Sink& sink);

/// A state that was read: its texts, and its items as views of the bytes, which must outlive it.
class Saved {
 public:
  struct Stored {
    std::string_view name;
    Type type;
    std::vector<std::uint64_t> shape;
    std::span<const std::byte> bytes;
  };

  /// `origin`: source of the bytes, for messages. Throws Error(usage) for bytes that are no state, cut short, damaged, of another format
  /// version or of another golden generation. Counts in the bytes are checked before memory is allocated for them.
  Saved(std::span<const std::byte> bytes, std::string origin);

  const std::string& origin() const { return origin_; }
  std::string_view scene() const { return scene_; }
  std::string_view inputs() const { return inputs_; }
  std::string_view note() const { return note_; }
  const std::vector<Stored>& items() const { return items_; }
  /// Number of simulated frames: the item `frame`, which every effect has; nothing if it is missing.
  std::optional<std::int64_t> frame() const;

 private:
  std::string origin_;
  std::string_view scene_, inputs_, note_;
  std::vector<Stored> items_;
};

/// Throws Error(usage) with the item, expected and found, unless the items of `saved` match the list: same names in the same order, types,
/// shapes (lengths within their limits), numbers within their ranges. Changes nothing.
void require_fit(const Saved& saved, const Items& items);
/// Call after require_fit: overwrites the listed items.
void load(const Saved& saved, const Items& items);

}  // namespace rainref::state
