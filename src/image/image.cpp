#include "rainref/image.h"

#include <array>
#include <bit>
#include <cstring>
#include <mutex>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "base/hash.h"
#include "base/zeroed.h"
#include "image/flipped.h"
#include "rainref/error.h"

namespace rainref {

static_assert(std::endian::native == std::endian::little, "canonical bytes are little endian; a swap is not written");

namespace {

constexpr std::array<FormatInfo, 11> formats{{{"r8", 1, 1, FormatInfo::unorm8},
                                              {"rg8", 2, 1, FormatInfo::unorm8},
                                              {"rgba8", 4, 1, FormatInfo::unorm8},
                                              {"rgba8_srgb", 4, 1, FormatInfo::srgb8},
                                              {"r16f", 1, 2, FormatInfo::float16},
                                              {"rg16f", 2, 2, FormatInfo::float16},
                                              {"rgba16f", 4, 2, FormatInfo::float16},
                                              {"r32f", 1, 4, FormatInfo::float32},
                                              {"rg32f", 2, 4, FormatInfo::float32},
                                              {"rgba32f", 4, 4, FormatInfo::float32},
                                              {"r32ui", 1, 4, FormatInfo::uint32}}};
constexpr std::size_t alignment = 64;
constexpr int max_side = 65536;

std::size_t stride_bytes(Format format, int width) {
  const std::size_t texels = static_cast<std::size_t>(Image::left_margin) + width + Image::right_margin;
  return (texels * info(format).texel_bytes() + alignment - 1) / alignment * alignment;
}

}  // namespace

const FormatInfo& info(Format format) { return formats[static_cast<std::size_t>(format)]; }

Format format_from_name(std::string_view name) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < formats.size(); ++i) {
    if (formats[i].name == name) return static_cast<Format>(i);
    names.emplace_back(formats[i].name);
  }
  throw Error(ExitCode::usage, fmt::format("unknown format '{}'{}", name, did_you_mean(name, names)));
}

void Image::Free::operator()(std::byte* p) const { zeroed::give_back(p, bytes); }

std::uint64_t Image::memory_bytes(Format format, int width, int height) {
  return std::uint64_t{stride_bytes(format, width)} * static_cast<std::uint64_t>(height);
}

Image::Image(Format format, int width, int height) : format_(format), width_(width), height_(height) {
  const FloatingPointGuard guard;
  if (width < 1 || height < 1 || width > max_side || height > max_side) {
    throw Error(ExitCode::usage, fmt::format("image size {}x{}: each side must be from 1 to {}", width, height, max_side));
  }
  stride_ = static_cast<std::ptrdiff_t>(stride_bytes(format, width));
  const std::uint64_t bytes = memory_bytes(format, width, height);
  if (std::in_range<std::ptrdiff_t>(bytes))
    memory_ = std::unique_ptr<std::byte, Free>(zeroed::take(static_cast<std::size_t>(bytes)), Free(static_cast<std::size_t>(bytes)));
  if (!memory_) {
    throw Error(ExitCode::usage, fmt::format("image {}x{} {}: {:.1f} GiB of memory could not be had", width, height, info(format).name,
                                             static_cast<double>(bytes) / (1u << 30)));
  }
  // The margin keeps the first texel of every row aligned to the bytes of 16 texels.
  origin_ = memory_.get() + static_cast<std::size_t>(left_margin) * info(format).texel_bytes();
}

struct Image::Shared {
  std::unique_ptr<std::byte, Free> memory;
  std::once_flag is_hashed;
  Hash128 hash;
};

void Image::refuse_to_change() { throw Error(ExitCode::internal, "an image that is shared was to be changed"); }

Image Image::share() {
  const FloatingPointGuard guard;
  if (memory_) {
    shared_ = std::make_shared<Shared>();
    shared_->memory = std::move(memory_);
  }
  return std::as_const(*this).shared();
}

Image Image::shared() const {
  const FloatingPointGuard guard;
  if (!shared_) return copy_of(*this);
  Image other;
  other.format_ = format_;
  other.width_ = width_;
  other.height_ = height_;
  other.stride_ = stride_;
  other.shared_ = shared_;
  other.origin_ = origin_;
  return other;
}

namespace {

Hash128 hash_of(const Image& image) {
  Hasher hasher(0);
  const std::array<std::int32_t, 3> head{static_cast<std::int32_t>(image.format()), image.width(), image.height()};
  hasher.add(std::as_bytes(std::span(head)));
  const std::size_t bytes = static_cast<std::size_t>(image.width()) * info(image.format()).texel_bytes();
  for (int y = 0; y < image.height(); ++y) hasher.add({image.row_bytes(y), bytes});
  return hasher.finish();
}

}  // namespace

Hash128 Image::content_hash() const {
  const FloatingPointGuard guard;
  if (!shared_) return hash_of(*this);
  std::call_once(shared_->is_hashed, [&] { shared_->hash = hash_of(*this); });
  return shared_->hash;
}

namespace {

/// Copies channels of this number of bytes into every texel of a row.
template <std::size_t Bytes>
void copy_channel(const std::byte* in, int count, std::size_t texel_bytes, std::byte* out) {
  for (int x = 0; x < count; ++x) std::memcpy(out + x * texel_bytes, in + x * Bytes, Bytes);
}

/// Both channels of a texel at once, little endian, which compilers vectorize.
template <class Channel, class Texel>
void copy_channels(const std::byte* first, const std::byte* second, int count, std::byte* out) {
  for (int x = 0; x < count; ++x) {
    Channel a, b;
    std::memcpy(&a, first + x * sizeof a, sizeof a);
    std::memcpy(&b, second + x * sizeof b, sizeof b);
    const Texel both = static_cast<Texel>(static_cast<Texel>(b) << (8 * sizeof a) | a);
    std::memcpy(out + x * sizeof both, &both, sizeof both);
  }
}

}  // namespace

void BufferView::copy_row(int y, std::byte* out) const {
  if (parts.size() == 1 && parts.front()->format() == format) {
    std::memcpy(out, parts.front()->row_bytes(y), row_bytes());
    return;
  }
  const std::size_t channel_bytes = info(format).channel_bytes, texel_bytes = info(format).texel_bytes();
  if (parts.size() == 2 && texel_bytes == 2 * channel_bytes && channel_bytes != 1) {
    const auto copy = channel_bytes == 2 ? copy_channels<std::uint16_t, std::uint32_t> : copy_channels<std::uint32_t, std::uint64_t>;
    return copy(parts[0]->row_bytes(y), parts[1]->row_bytes(y), width(), out);
  }
  std::memset(out, 0, row_bytes());
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const auto copy = channel_bytes == 1 ? copy_channel<1> : channel_bytes == 2 ? copy_channel<2> : copy_channel<4>;
    copy(parts[c]->row_bytes(y), width(), texel_bytes, out + c * channel_bytes);
  }
}

}  // namespace rainref
