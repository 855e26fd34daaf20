// The state that an effect keeps between frames, as a list of items. Saving and loading use the same list.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rainref/image.h"

namespace rainref::state {

/// Storage type of a number.
enum class Type : std::uint8_t { u8, u32, i32, i64, f16, f32, f64 };
/// "u8", "f16" ...
const char* name(Type type);
std::size_t bytes_of(Type type);
/// "wave f16 [512, 768, 1]": shapes slowest first, images as rows, columns, channels; [] is one number.
std::string text_of(std::string_view name, Type type, std::span<const std::uint64_t> shape);

/// Allowed values of the numbers of an item. A NaN is never allowed.
struct Range {
  double low, high;
};
/// All finite numbers of a type.
Range finite();

/// A length that changes from frame to frame; the items of one list share it.
struct Length {
  std::uint64_t now, most;
  std::function<void(std::uint64_t)> resize;  ///< called with at most `most`; contents beyond that are lost
};

struct Item {
  std::string name;
  Type type;
  std::vector<std::uint64_t> shape;
  Range range;
  std::uint64_t rows;                                ///< pieces that are contiguous in memory
  std::function<std::byte*(std::uint64_t row)> row;  ///< address of a piece; called again after a resize
  std::shared_ptr<Length> length = nullptr;          ///< set if the shape may differ
  std::size_t row_bytes() const;                     ///< for the current shape
};

/// References to the listed items; must not outlive them.
class Items {
 public:
  void number(std::string name, std::int32_t& value, Range range);
  void number(std::string name, std::int64_t& value, Range range);
  void number(std::string name, std::uint32_t& value);
  void flag(std::string name, bool& value);
  void numbers(std::string name, std::span<double> values, Range range);
  /// Adds the texels of an image, without margins.
  void image(std::string name, Image& image, Range range = finite());
  /// Adds one of several arrays of 4-byte numbers (f32, u32) with the same length; `data`: its start.
  void array(std::string name, Type type, Range range, const std::shared_ptr<Length>& length, std::function<void*()> data);
  /// Adds an action to run after everything is loaded, in order, to compute values that follow from the items.
  void then(std::function<void()> action) { after_.push_back(std::move(action)); }

  const std::vector<Item>& all() const { return all_; }
  void finish() const;
  /// Prefix for the names of the following items; "" ends it.
  void begin_names_with(std::string prefix) { prefix_ = std::move(prefix); }

 private:
  void add(std::string name, Type type, std::vector<std::uint64_t> shape, Range range, void* data);

  std::string prefix_;
  std::vector<Item> all_;
  std::vector<std::function<void()>> after_;
};

/// Range of frame counts in a state: ten times the largest number that a scene may ask for, so no counter overflows.
inline constexpr Range frames{0, 1e7};
/// Range of sums of whole mass units: one more frame cannot overflow.
inline constexpr Range sums{-0x1p62, 0x1p62};

}  // namespace rainref::state
