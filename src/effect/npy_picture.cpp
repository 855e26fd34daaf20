#include "effect/npy_picture.h"

#include <array>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/path_text.h"
#include "base/read_file.h"
#include "capture/hashing.h"
#include "capture/npy_read.h"
#include "image_io/quantity.h"
#include "math/half.h"
#include "math/unorm.h"
#include "rainref/error.h"

namespace rainref::effect {
namespace {

constexpr std::size_t longest_side = 65536;

template <class T>
float number(T stored) {
  if constexpr (std::is_same_v<T, float>)
    return stored;
  else
    return to_float(stored);
}
struct Array {
  capture::NpyHeader header;
  std::size_t channels;
  int width, height;
};
/// Grey is replicated; an absent alpha is `one`.
template <class T>
Image four_channels(const Array& array, const std::byte* from, Format format, T one, const std::string& file, image_io::Content content) {
  const int width = array.width, height = array.height;
  const std::size_t channels = array.channels;
  Image image(format, width, height);
  std::array<T, 4> texel{one, one, one, one};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, from += channels * sizeof(T)) {
      std::memcpy(texel.data(), from, channels * sizeof(T));
      for (std::size_t c = 0; c < channels; ++c) {
        const float value = number(texel[c]);
        if (!(value - value == 0) && !(content == image_io::Content::depth && value > 0))
          throw Error(ExitCode::usage,
                      fmt::format("'{}': {} at x {}, y {} (from the top), channel {}", file, value != value ? "NaN" : "infinity", x, y, c));
      }
      if (channels == 1) texel[1] = texel[2] = texel[0];
      std::memcpy(image.row<T>(y) + 4 * x, texel.data(), sizeof texel);
    }
  }
  return image;
}

Array array_of(const std::string& file, std::span<const std::byte> bytes) {
  capture::NpyHeader header;
  try {
    header = capture::parse_npy_header(bytes, fmt::format("'{}'", file));
  } catch (const Error& e) {
    throw Error(ExitCode::usage, e.what());  // the user's picture, not a port's file
  }
  const std::vector<std::size_t>& shape = header.shape;
  const std::size_t channels = shape.size() == 3 ? shape[2] : 1;
  const bool is_picture = (shape.size() == 2 || shape.size() == 3) && (channels == 1 || channels == 3 || channels == 4);
  if (!is_picture || header.type.empty() || header.type == "<u4") {
    throw Error(
        ExitCode::usage,
        fmt::format("'{}': expected numbers of type <f4, <f2 or |u1 and of shape (height, width) or (height, width, 1, 3 or 4)", file));
  }
  if (shape[0] < 1 || shape[1] < 1 || shape[0] > longest_side || shape[1] > longest_side) {
    throw Error(ExitCode::usage, fmt::format("'{}': expected sides from 1 to {}, found {}x{}", file, longest_side, shape[1], shape[0]));
  }
  const int width = static_cast<int>(shape[1]), height = static_cast<int>(shape[0]);
  return {std::move(header), channels, width, height};
}
image_io::Picture described(const Array& a, image_io::Content content) {
  image_io::Picture out;
  out.channel_names = a.channels == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  if (a.channels == 4) out.channel_names.push_back("A");
  out.srgb_encoded = a.header.type == "|u1";
  out.compression = "none";
  out.file_width = a.width;
  out.file_height = a.height;
  if (content != image_io::Content::colour) out.taken = out.channel_names.front();
  return out;
}

}  // namespace

bool is_npy(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;  // opening a pipe would wait
  std::array<char, 6> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  return std::memcmp(start.data(), "\x93NUMPY", start.size()) == 0;
}

image_io::Picture inspect_npy(const std::filesystem::path& path, std::span<const std::byte> bytes, image_io::Content content) {
  return described(array_of(path_text(path), bytes), content);
}

image_io::Picture read_npy(const std::filesystem::path& path, image_io::Content content) {
  const std::string file = path_text(path);
  const std::vector<std::byte> bytes = read_file(path);
  const Array array = array_of(file, bytes);
  const std::byte* from = bytes.data() + array.header.data_offset;
  image_io::Picture out = described(array, content);
  if (array.header.type == "<f4")
    out.image = four_channels(array, from, Format::rgba32f, 1.0f, file, content);
  else if (array.header.type == "<f2")
    out.image = four_channels(array, from, Format::rgba16f, to_half(1.0f), file, content);
  else
    out.image = four_channels(array, from, Format::rgba8, Unorm8{255}, file, content);
  if (content != image_io::Content::colour && array.channels > 1)
    image_io::require_alike(fmt::format("'{}'", file), out.image, {"R", "G", "B"});
  out.decoded_hash = capture::hash_of(BufferView(out.image));
  return out;
}

}  // namespace rainref::effect
