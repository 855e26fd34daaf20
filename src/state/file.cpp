#include "state/file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

#include <fmt/format.h>

#include "base/hash.h"
#include "base/printable.h"
#include "math/half.h"
#include "rainref/error.h"
#include "rainref/version.h"

namespace rainref::state {
namespace {

// The newline and the control character reveal a transfer in text mode, as in PNG.
constexpr std::string_view magic = "rainref-state\r\n\x1a";
constexpr std::size_t most_dimensions = 3, checksum_bytes = 16;

/// Writes integers, lowest byte first.
class Writer {
 public:
  explicit Writer(const Sink* sink) : sink_(sink) {}
  template <class T>
  void put(T value) {
    std::array<std::byte, sizeof(T)> bytes;
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes[i] = static_cast<std::byte>(value >> 8 * i & 0xff);
    put(std::span<const std::byte>(bytes));
  }
  void put(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    put(std::as_bytes(std::span(text)));
  }
  void put(std::span<const std::byte> bytes) {
    count_ += bytes.size();
    if (!sink_) return;
    hasher_.add(bytes);
    (*sink_)(bytes);
  }
  std::uint64_t count() const { return count_; }
  Hash128 hash() const { return hasher_.finish(); }

 private:
  const Sink* sink_;  // null: only counts
  std::uint64_t count_ = 0;
  Hasher hasher_{0};
};

void put_all(Writer& out, const Texts& texts, const Items& items, std::uint64_t file_bytes) {
  out.put(std::as_bytes(std::span(magic)));
  out.put(format_version);
  out.put(static_cast<std::uint32_t>(golden_generation));
  out.put(file_bytes);
  for (const std::string* text : {&texts.scene, &texts.inputs, &texts.note}) out.put(std::string_view(*text));
  out.put(static_cast<std::uint32_t>(items.all().size()));
  for (const Item& item : items.all()) {
    out.put(std::string_view(item.name));
    out.put(static_cast<std::uint8_t>(item.type));
    out.put(static_cast<std::uint8_t>(item.shape.size()));
    for (const std::uint64_t n : item.shape) out.put(n);
    const std::size_t bytes = item.row_bytes();
    for (std::uint64_t row = 0; row < item.rows; ++row) out.put(std::span<const std::byte>(item.row(row), bytes));
  }
}

/// Reads them back, never beyond the end.
class Reader {
 public:
  Reader(std::span<const std::byte> bytes, const std::string& origin) : bytes_(bytes), origin_(origin) {}
  template <class T>
  T take() {
    const std::span<const std::byte> from = take(sizeof(T));
    T value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) value = static_cast<T>(value | static_cast<T>(std::to_integer<T>(from[i]) << 8 * i));
    return value;
  }
  std::string_view take_text() {
    const std::span<const std::byte> text = take(take<std::uint64_t>());
    return {reinterpret_cast<const char*>(text.data()), text.size()};
  }
  std::span<const std::byte> take(std::uint64_t count) {
    if (count > bytes_.size() - at_) fail("a count in it reaches beyond its end");
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }
  bool at_end() const { return at_ == bytes_.size(); }
  [[noreturn]] void fail(const std::string& why) const { throw Error(ExitCode::usage, fmt::format("{}: {}", origin_, why)); }

 private:
  std::span<const std::byte> bytes_;
  const std::string& origin_;
  std::size_t at_ = 0;
};

/// Bytes that the shape needs, or more than any file has.
std::uint64_t wanted_bytes(const Saved::Stored& item) {
  constexpr std::uint64_t most = std::uint64_t{1} << 62;
  std::uint64_t bytes = bytes_of(item.type);
  for (const std::uint64_t n : item.shape) {
    if (n != 0 && bytes > most / n) return most;
    bytes *= n;
  }
  return bytes;
}

}  // namespace

void write(const Texts& texts, const Items& items, const Sink& sink) {
  Writer counted(nullptr);
  put_all(counted, texts, items, 0);
  Writer out(&sink);
  put_all(out, texts, items, counted.count() + checksum_bytes);
  const Hash128 hash = out.hash();
  out.put(hash.low);
  out.put(hash.high);
}

Saved::Saved(std::span<const std::byte> bytes, std::string origin) : origin_(std::move(origin)) {
  Reader in(bytes, origin_);
  if (bytes.size() < magic.size() || std::memcmp(bytes.data(), magic.data(), magic.size()) != 0)
    in.fail("expected a state that rainref saved, found other bytes");
  in.take(magic.size());
  const auto short_file = [&](std::uint64_t expected) {
    in.fail(fmt::format("cut short or lengthened: expected {} bytes, found {}", expected, bytes.size()));
  };
  constexpr std::size_t head = magic.size() + 4 + 4 + 8;
  if (bytes.size() < head + checksum_bytes) short_file(head + checksum_bytes);
  const auto version = in.take<std::uint32_t>(), generation = in.take<std::uint32_t>();
  if (version != format_version) in.fail(fmt::format("expected a state of format {}, found {}", format_version, version));
  const auto size = in.take<std::uint64_t>();
  if (size != bytes.size()) short_file(size);
  Hasher hasher(0);
  hasher.add(bytes.first(bytes.size() - checksum_bytes));
  const Hash128 hash = hasher.finish();
  Reader end(bytes.last(checksum_bytes), origin_);
  if (end.take<std::uint64_t>() != hash.low || end.take<std::uint64_t>() != hash.high)
    in.fail("damaged: its checksum is not that of its bytes");
  if (generation != golden_generation) {
    in.fail(fmt::format("expected a state of golden generation {}, found {}: another version of rainref saved it, with other bits",
                        golden_generation, generation));
  }

  Reader body(bytes.first(bytes.size() - checksum_bytes), origin_);
  body.take(head);
  for (std::string_view* text : {&scene_, &inputs_, &note_}) *text = body.take_text();
  const auto count = body.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < count; ++i) {
    Stored item{body.take_text(), Type::u8, {}, {}};
    const auto type = body.take<std::uint8_t>(), dimensions = body.take<std::uint8_t>();
    if (type > static_cast<std::uint8_t>(Type::f64) || dimensions > most_dimensions)
      body.fail(fmt::format("item {} has type {} and {} dimensions", printable(item.name), type, dimensions));
    item.type = static_cast<Type>(type);
    for (std::uint8_t d = 0; d < dimensions; ++d) item.shape.push_back(body.take<std::uint64_t>());
    item.bytes = body.take(wanted_bytes(item));
    items_.push_back(std::move(item));
  }
  if (!body.at_end()) body.fail("bytes follow the last item");
}

std::optional<std::int64_t> Saved::frame() const {
  for (const Stored& item : items_) {
    if (item.name != "frame" || !item.shape.empty()) continue;
    if (item.type == Type::i32) return Reader(item.bytes, origin_).take<std::int32_t>();
    if (item.type == Type::i64) return Reader(item.bytes, origin_).take<std::int64_t>();
  }
  return std::nullopt;
}

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
