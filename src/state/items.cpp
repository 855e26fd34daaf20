#include "state/items.h"

#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rainref::state {
namespace {

Type type_of(const FormatInfo& format) {
  switch (format.kind) {
    case FormatInfo::float16:
      return Type::f16;
    case FormatInfo::float32:
      return Type::f32;
    case FormatInfo::uint32:
      return Type::u32;
    default:
      return Type::u8;
  }
}

}  // namespace

const char* name(Type type) {
  constexpr const char* names[] = {"u8", "u32", "i32", "i64", "f16", "f32", "f64"};
  return names[static_cast<int>(type)];
}
std::size_t bytes_of(Type type) {
  constexpr std::size_t bytes[] = {1, 4, 4, 8, 2, 4, 8};
  return bytes[static_cast<int>(type)];
}
std::string text_of(std::string_view name, Type type, std::span<const std::uint64_t> shape) {
  return fmt::format("{} {} [{}]", name, state::name(type), fmt::join(shape, ", "));
}

Range finite() { return {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()}; }

std::size_t Item::row_bytes() const {
  std::size_t bytes = bytes_of(type);
  for (const std::uint64_t n : shape) bytes *= n;
  return rows == 0 ? 0 : bytes / rows;
}

void Items::add(std::string name, Type type, std::vector<std::uint64_t> shape, Range range, void* data) {
  auto* bytes = static_cast<std::byte*>(data);
  all_.push_back({prefix_ + std::move(name), type, std::move(shape), range, 1, [bytes](std::uint64_t) { return bytes; }});
}

void Items::number(std::string name, std::int32_t& value, Range range) { add(std::move(name), Type::i32, {}, range, &value); }
void Items::number(std::string name, std::int64_t& value, Range range) { add(std::move(name), Type::i64, {}, range, &value); }
void Items::number(std::string name, std::uint32_t& value) { add(std::move(name), Type::u32, {}, finite(), &value); }
void Items::flag(std::string name, bool& value) {
  static_assert(sizeof(bool) == 1);
  add(std::move(name), Type::u8, {}, {0, 1}, &value);
}
void Items::numbers(std::string name, std::span<double> values, Range range) {
  add(std::move(name), Type::f64, {values.size()}, range, values.data());
}

void Items::image(std::string name, Image& image, Range range) {
  const auto height = static_cast<std::uint64_t>(image.height()), width = static_cast<std::uint64_t>(image.width());
  all_.push_back({prefix_ + std::move(name),
                  type_of(info(image.format())),
                  {height, width, static_cast<std::uint64_t>(image.channels())},
                  range,
                  height,
                  [&image](std::uint64_t y) { return image.row_bytes(static_cast<int>(y)); }});
}

void Items::array(std::string name, Type type, Range range, const std::shared_ptr<Length>& length, std::function<void*()> data) {
  all_.push_back({prefix_ + std::move(name),
                  type,
                  {length->now},
                  range,
                  1,
                  [data = std::move(data)](std::uint64_t) { return static_cast<std::byte*>(data()); },
                  length});
}

void Items::finish() const {
  for (const auto& action : after_) action();
}

}  // namespace rainref::state
