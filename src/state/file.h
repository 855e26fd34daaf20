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

/// Whose state it is.
struct Texts {
  std::string scene;   ///< "key = value" lines
  std::string inputs;  ///< a line for each picture that was read: key and hash
  std::string note;    ///< whatever else the writer keeps with it
};

/// Takes the bytes of a file in order.
using Sink = std::function<void(std::span<const std::byte>)>;
void write(const Texts& texts, const Items& items, const Sink& sink);

/// A state that was read: texts, and items as views of the bytes, which must outlive it.
class Saved {
 public:
  struct Stored {
    std::string_view name;
    Type type;
    std::vector<std::uint64_t> shape;
    std::span<const std::byte> bytes;
  };

  /// `origin`: where the bytes are from, for messages. Throws Error(usage) for bytes that are no state, cut short, damaged, of another
  /// format version or of another golden generation. Counts that the bytes name are looked at before anything is allocated by them.
  Saved(std::span<const std::byte> bytes, std::string origin);

  const std::string& origin() const { return origin_; }
  std::string_view scene() const { return scene_; }
  std::string_view inputs() const { return inputs_; }
  std::string_view note() const { return note_; }
  const std::vector<Stored>& items() const { return items_; }
  /// Frames behind it: the item `frame`, which every effect has; nothing where there is none.
  std::optional<std::int64_t> frame() const;

 private:
  std::string origin_;
  std::string_view scene_, inputs_, note_;
  std::vector<Stored> items_;
};

/// Throws Error(usage), naming the item, what is expected and what was found, unless the items of `saved` are those listed: the same
/// names in the same order, types, shapes (lengths within their limits), numbers within their ranges. Changes nothing.
void require_fit(const Saved& saved, const Items& items);
/// After require_fit: overwrites what is listed.
void load(const Saved& saved, const Items& items);

}  // namespace rainref::state
