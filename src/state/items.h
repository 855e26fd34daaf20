// What an effect holds from one frame to the next, item by item. An effect lists its items once; saving and loading both read that list.
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

/// Of one number, as it is stored.
enum class Type : std::uint8_t { u8, u32, i32, i64, f16, f32, f64 };
/// "u8", "f16" ...
const char* name(Type type);
std::size_t bytes_of(Type type);
/// "wave f16 [512, 768, 1]": shapes slowest first, images as rows, columns, channels; [] is one number.
std::string text_of(std::string_view name, Type type, std::span<const std::uint64_t> shape);

/// What each number of an item may be; a NaN never is.
struct Range {
  double low, high;
};
/// Of a type's finite numbers.
Range finite();

/// Numbers whose count changes from frame to frame; items of one list share it.
struct Length {
  std::uint64_t now, most;
  std::function<void(std::uint64_t)> resize;  ///< called with at most `most`; what is held beyond is lost
};

struct Item {
  std::string name;
  Type type;
  std::vector<std::uint64_t> shape;
  Range range;
  std::uint64_t rows;                                ///< pieces that lie together in memory
  std::function<std::byte*(std::uint64_t row)> row;  ///< each of them; asked anew after a resize
  std::shared_ptr<Length> length = nullptr;          ///< where the shape may be another one
  std::size_t row_bytes() const;                     ///< of the shape now
};

/// Refers to what is listed; lives no longer.
class Items {
 public:
  void number(std::string name, std::int32_t& value, Range range);
  void number(std::string name, std::int64_t& value, Range range);
  void number(std::string name, std::uint32_t& value);
  void flag(std::string name, bool& value);
  void numbers(std::string name, std::span<double> values, Range range);
  /// Its texels, without margins.
  void image(std::string name, Image& image, Range range = finite());
  /// One of several arrays of 4-byte numbers (f32, u32) of the same length; `data`: where it begins.
  void array(std::string name, Type type, Range range, const std::shared_ptr<Length>& length, std::function<void*()> data);
  /// To be called once everything is loaded, in order: what follows from the items.
  void then(std::function<void()> action) { after_.push_back(std::move(action)); }

  const std::vector<Item>& all() const { return all_; }
  void finish() const;
  /// Names of items to come begin with it; "": no longer.
  void begin_names_with(std::string prefix) { prefix_ = std::move(prefix); }

 private:
  void add(std::string name, Type type, std::vector<std::uint64_t> shape, Range range, void* data);

  std::string prefix_;
  std::vector<Item> all_;
  std::vector<std::function<void()>> after_;
};

/// Frames that a state may have behind it: ten times what a scene may ask for, so that no counter overflows.
inline constexpr Range frames{0, 1e7};
/// Sums of whole mass units: another frame overflows nothing.
inline constexpr Range sums{-0x1p62, 0x1p62};

}  // namespace rainref::state
