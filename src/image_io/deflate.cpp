#include "image_io/deflate.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace rainref::image_io {
namespace {

/// Bits into bytes, the lowest first.
class BitWriter {
 public:
  explicit BitWriter(std::vector<std::byte>& out) : out_(out) {}
  void bits(std::uint32_t value, int count) {
    held_ |= std::uint64_t{value} << fill_;
    for (fill_ += count; fill_ >= 8; fill_ -= 8, held_ >>= 8) out_.push_back(static_cast<std::byte>(held_));
  }
  /// Huffman codes begin with their highest bit.
  void code(std::uint32_t value, int count) {
    std::uint32_t turned = 0;
    for (int k = 0; k < count; ++k) turned |= (value >> k & 1u) << (count - 1 - k);
    bits(turned, count);
  }
  void finish() {
    if (fill_ > 0) bits(0, 8 - fill_);
  }

 private:
  std::vector<std::byte>& out_;
  std::uint64_t held_ = 0;
  int fill_ = 0;
};

/// A literal, the end of the block (256), or a code of lengths, in the fixed code.
void put_symbol(BitWriter& out, std::uint32_t symbol) {
  if (symbol < 144)
    out.code(0x30 + symbol, 8);
  else if (symbol < 256)
    out.code(0x190 + symbol - 144, 9);
  else if (symbol < 280)
    out.code(symbol - 256, 7);
  else
    out.code(0xc0 + symbol - 280, 8);
}

/// What a code of lengths or distances begins with, and how many further bits say the rest.
struct Step {
  std::uint32_t base;
  int bits;
};
constexpr std::array<Step, 29> lengths{{{3, 0},  {4, 0},  {5, 0},  {6, 0},   {7, 0},   {8, 0},   {9, 0},   {10, 0},  {11, 1}, {13, 1},
                                        {15, 1}, {17, 1}, {19, 2}, {23, 2},  {27, 2},  {31, 2},  {35, 3},  {43, 3},  {51, 3}, {59, 3},
                                        {67, 4}, {83, 4}, {99, 4}, {115, 4}, {131, 5}, {163, 5}, {195, 5}, {227, 5}, {258, 0}}};
constexpr std::array<Step, 30> distances{{{1, 0},     {2, 0},     {3, 0},     {4, 0},      {5, 1},      {7, 1},     {9, 2},     {13, 2},
                                          {17, 3},    {25, 3},    {33, 4},    {49, 4},     {65, 5},     {97, 5},    {129, 6},   {193, 6},
                                          {257, 7},   {385, 7},   {513, 8},   {769, 8},    {1025, 9},   {1537, 9},  {2049, 10}, {3073, 10},
                                          {4097, 11}, {6145, 11}, {8193, 12}, {12289, 12}, {16385, 13}, {24577, 13}}};
template <std::size_t N>
std::uint32_t step_of(const std::array<Step, N>& steps, std::uint32_t value) {
  const auto above = std::upper_bound(steps.begin(), steps.end(), value, [](std::uint32_t v, const Step& s) { return v < s.base; });
  return static_cast<std::uint32_t>(above - steps.begin() - 1);
}
void put_repeat(BitWriter& out, std::uint32_t length, std::uint32_t distance) {
  const std::uint32_t l = step_of(lengths, length), d = step_of(distances, distance);
  put_symbol(out, 257 + l);
  out.bits(length - lengths[l].base, lengths[l].bits);
  out.code(d, 5);
  out.bits(distance - distances[d].base, distances[d].bits);
}

constexpr std::size_t window = 32768, shortest = 3, longest = 258;
constexpr int most_tries = 32;

/// Where bytes that begin alike were seen last, and before that.
class Seen {
 public:
  explicit Seen(std::span<const std::byte> data) : data_(data), last_(1u << 15, none), before_(data.size(), none) {}
  void add(std::size_t at) {
    if (at + shortest > data_.size()) return;
    std::size_t& head = last_[hash(at)];
    before_[at] = head;
    head = at;
  }
  /// The longest repeat of what begins at `at`, {length, distance}; length 0: none.
  std::array<std::size_t, 2> find(std::size_t at) const {
    std::array<std::size_t, 2> best{};
    if (at + shortest > data_.size()) return best;
    const std::size_t most = std::min(longest, data_.size() - at);
    int tries = most_tries;
    for (std::size_t from = last_[hash(at)]; from != none && at - from <= window && tries-- > 0 && best[0] < most; from = before_[from]) {
      std::size_t length = 0;
      while (length < most && data_[from + length] == data_[at + length]) ++length;
      if (length >= shortest && length > best[0]) best = {length, at - from};
    }
    return best;
  }

 private:
  static constexpr std::size_t none = ~std::size_t{0};
  std::size_t hash(std::size_t at) const {
    const auto byte = [&](std::size_t k) { return std::to_integer<std::uint32_t>(data_[at + k]); };
    return ((byte(0) << 16 | byte(1) << 8 | byte(2)) * 2654435761u) >> 17;
  }
  std::span<const std::byte> data_;
  std::vector<std::size_t> last_, before_;
};

std::uint32_t adler32(std::span<const std::byte> data) {
  std::uint32_t a = 1, b = 0;
  for (const std::byte byte : data) {
    a = (a + std::to_integer<std::uint32_t>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

}  // namespace

std::vector<std::byte> zlib_bytes(std::span<const std::byte> data) {
  std::vector<std::byte> bytes{std::byte{0x78}, std::byte{0x01}};
  BitWriter out(bytes);
  out.bits(1, 1);  // the last block
  out.bits(1, 2);  // in the fixed code
  Seen seen(data);
  for (std::size_t at = 0; at < data.size();) {
    const auto [length, distance] = seen.find(at);
    const std::size_t step = std::max<std::size_t>(length, 1);
    if (length > 0)
      put_repeat(out, static_cast<std::uint32_t>(length), static_cast<std::uint32_t>(distance));
    else
      put_symbol(out, std::to_integer<std::uint32_t>(data[at]));
    for (std::size_t k = 0; k < step; ++k) seen.add(at++);
  }
  put_symbol(out, 256);
  out.finish();
  const std::uint32_t sum = adler32(data);
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::byte>(sum >> shift));
  return bytes;
}

}  // namespace rainref::image_io
