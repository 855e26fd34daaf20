#include "state/file.h"

#include <algorithm>
#include <cstring>
#include <map>

#include <fmt/format.h>

#include "base/printable.h"
#include "math/half.h"
#include "rainref/error.h"

namespace rainref::state {
namespace {

template <class T, class Value>
void require_range(std::span<const std::byte> bytes, Range range, const Value& value, const std::string& name) {
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(T)) {
    T stored;
    std::memcpy(&stored, bytes.data() + at, sizeof(T));
    const double number = value(stored);
    if (!(number >= range.low && number <= range.high)) {
      throw Error(ExitCode::usage, fmt::format("{}: expected numbers from {} to {}, found {}", name, range.low, range.high, number));
    }
  }
}
void require_range(const Saved::Stored& stored, Range range, const std::string& name) {
  const auto plain = [](auto x) { return static_cast<double>(x); };
  switch (stored.type) {
    case Type::u8:
      return require_range<std::uint8_t>(stored.bytes, range, plain, name);
    case Type::u32:
      return;  // any number is one
    case Type::i32:
      return require_range<std::int32_t>(stored.bytes, range, plain, name);
    case Type::i64:
      return require_range<std::int64_t>(stored.bytes, range, plain, name);
    case Type::f16:
      return require_range<Half>(
          stored.bytes, range, [](Half x) { return static_cast<double>(to_float(x)); }, name);
    case Type::f32:
      return require_range<float>(stored.bytes, range, plain, name);
    case Type::f64:
      return require_range<double>(stored.bytes, range, plain, name);
  }
}

bool fits(const Saved::Stored& stored, const Item& item, std::map<const Length*, std::uint64_t>& lengths) {
  if (stored.type != item.type) return false;
  if (!item.length) return stored.shape == item.shape;
  if (stored.shape.size() != 1 || stored.shape[0] > item.length->most) return false;
  return lengths.emplace(item.length.get(), stored.shape[0]).first->second == stored.shape[0];
}

std::string expected_text(const Item& item) {
  return item.length ? fmt::format("{} {} [up to {}, as long as its neighbours]", item.name, name(item.type), item.length->most)
                     : text_of(item.name, item.type, item.shape);
}

}  // namespace

void require_fit(const Saved& saved, const Items& items) {
  const auto fail = [&](const std::string& expected, const std::string& found) {
    throw Error(ExitCode::usage, fmt::format("{}: expected {}, found {}", saved.origin(), expected, found));
  };
  std::map<const Length*, std::uint64_t> lengths;
  const std::size_t count = std::max(saved.items().size(), items.all().size());
  for (std::size_t i = 0; i < count; ++i) {
    const Item* item = i < items.all().size() ? &items.all()[i] : nullptr;
    const Saved::Stored* stored = i < saved.items().size() ? &saved.items()[i] : nullptr;
    if (item && stored && stored->name == item->name && fits(*stored, *item, lengths)) {
      require_range(*stored, item->range, fmt::format("{}: {}", saved.origin(), item->name));
    } else {
      fail(item ? expected_text(*item) : "no more items",
           stored ? text_of(printable(stored->name), stored->type, stored->shape) : "no more items");
    }
  }
}

void load(const Saved& saved, const Items& items) {
  std::map<const Length*, bool> resized;
  for (std::size_t i = 0; i < items.all().size(); ++i) {
    const Item& item = items.all()[i];
    const Saved::Stored& stored = saved.items()[i];
    if (item.length && resized.emplace(item.length.get(), true).second) item.length->resize(stored.shape[0]);
    const std::size_t row_bytes = item.rows == 0 ? 0 : stored.bytes.size() / item.rows;
    for (std::uint64_t row = 0; row < item.rows && row_bytes > 0; ++row)
      std::memcpy(item.row(row), stored.bytes.data() + row * row_bytes, row_bytes);
  }
  items.finish();
}

}  // namespace rainref::state
