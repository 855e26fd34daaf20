// Storage formats, and the images that passes read and write, byte for byte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rainref/storage.h"

namespace rainref {

struct Hash128;  // src/base/hash.h

/// Storage formats, named as graphics APIs name them. Unorm values are code / 255.
enum class Format : std::uint8_t { r8, rg8, rgba8, rgba8_srgb, r16f, rg16f, rgba16f, r32f, rg32f, rgba32f, r32ui };

struct FormatInfo {
  std::string_view name;
  int channels;
  int channel_bytes;
  enum Kind : std::uint8_t { unorm8, srgb8, float16, float32, uint32 } kind;
  int texel_bytes() const { return channels * channel_bytes; }
};

const FormatInfo& info(Format format);
/// Returns the format of this name. Throws Error(usage) with the nearest name.
Format format_from_name(std::string_view name);

/// A two-dimensional array of texels, channels interleaved, row 0 = v 0 of the pass that writes it.
///
/// Every row has a margin of left_margin texels before it and of at least right_margin after it, so a kernel may read a whole vector at any
/// column. A kernel may also keep ghost texels for its boundary rule in the margins. Margins are zero until a kernel fills them. They are
/// never hashed, captured or written to a file.
class Image {
 public:
  static constexpr int left_margin = 16;
  static constexpr int right_margin = 32;

  Image() = default;
  /// Makes an image of zeros. Throws Error(usage) if a side is not in [1, 65536] or memory is short.
  Image(Format format, int width, int height);

  Format format() const { return format_; }
  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return info(format_).channels; }
  bool empty() const { return width_ == 0; }

  /// Returns the first texel of row y. T is the storage type of one channel: float, Half, Unorm8 or std::uint32_t.
  template <class T>
  T* row(int y) {
    return reinterpret_cast<T*>(row_bytes(y));
  }
  template <class T>
  const T* row(int y) const {
    return reinterpret_cast<const T*>(row_bytes(y));
  }
  std::byte* row_bytes(int y) {
    if (shared_) refuse_to_change();
    return origin_ + static_cast<std::ptrdiff_t>(y) * stride_;
  }
  const std::byte* row_bytes(int y) const { return origin_ + static_cast<std::ptrdiff_t>(y) * stride_; }
  /// Distance between rows [byte].
  std::ptrdiff_t stride() const { return stride_; }

  /// Memory of an image of this format and size [byte].
  static std::uint64_t memory_bytes(Format format, int width, int height);

  /// Returns another image that shares this one's texels. The last image that shares them frees the memory. From the first call on, the
  /// texels must not change: a writable row of any such image throws Error(internal).
  Image share();
  /// Does the same if this image is already shared. Otherwise returns a copy.
  Image shared() const;
  /// Hash of format, size and texels without margins. It is computed once for shared texels.
  Hash128 content_hash() const;

 private:
  struct Free {
    std::size_t bytes;
    Free() : bytes(0) {}
    explicit Free(std::size_t b) : bytes(b) {}
    void operator()(std::byte* p) const;
  };
  struct Shared;
  [[noreturn]] static void refuse_to_change();

  Format format_ = Format::r8;
  int width_ = 0, height_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::unique_ptr<std::byte, Free> memory_;
  std::shared_ptr<Shared> shared_;  // if set, it owns the memory
  std::byte* origin_ = nullptr;
};

/// A buffer as callers see it. Its channels, in order, are those of one image, or several single-channel images of one size (`parts`).
/// Channels without a part are zero. The canonical bytes are the rows without padding, little endian.
struct BufferView {
  Format format;
  std::vector<const Image*> parts;

  BufferView(const Image& image) : format(image.format()), parts{&image} {}
  BufferView(Format as, std::vector<const Image*> channel_images) : format(as), parts(std::move(channel_images)) {}
  int width() const { return parts.front()->width(); }
  int height() const { return parts.front()->height(); }
  std::size_t row_bytes() const { return static_cast<std::size_t>(width()) * info(format).texel_bytes(); }
  /// Writes the canonical bytes of row y to out (row_bytes() bytes).
  void copy_row(int y, std::byte* out) const;
};

}  // namespace rainref
