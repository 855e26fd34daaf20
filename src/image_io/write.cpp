#include "image_io/write.h"

#include <cstring>
#include <exception>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/path_text.h"
#include "image_io/codec.h"
#include "rainref/error.h"

namespace rainref::image_io {

namespace {

void require(bool holds, std::string_view what) {
  if (!holds) throw Error(ExitCode::internal, fmt::format("writing a picture: {}", what));
}

/// The bytes of an EXR. `name` is for messages.
std::vector<std::byte> encoded_exr(const std::string& name, const StoredPicture& picture, const std::vector<std::byte>& texels) try {
  auto bytes = codec().encode_exr(name, picture, texels.data());
  require(bytes.has_value(), "this OpenImageIO cannot write EXR to memory");
  return std::move(*bytes);
} catch (const Error&) {
  throw;
} catch (const std::exception& error) {
  const std::string_view why = error.what();
  throw Error(ExitCode::io, fmt::format("cannot write '{}': {}", name, why.empty() ? "no reason given" : why));
}

/// Copies the first `bytes` bytes of every texel of `in` to `out` with a stride of `step` bytes.
void interleave(const Image& in, std::size_t bytes, std::size_t step, std::byte* out) {
  const std::size_t texel_bytes = info(in.format()).texel_bytes();
  for (int y = 0; y < in.height(); ++y) {
    const std::byte* row = in.row_bytes(y);
    for (int x = 0; x < in.width(); ++x, row += texel_bytes, out += step) std::memcpy(out, row, bytes);
  }
}

std::string channel_type(Format format) {
  const FormatInfo::Kind kind = info(format).kind;
  require(kind == FormatInfo::float16 || kind == FormatInfo::float32, fmt::format("an EXR layer cannot be {}", info(format).name));
  return kind == FormatInfo::float16 ? "half" : "float";
}

/// Adds the layer's channels to the picture; names must not repeat.
void add_channels(const Layer& layer, std::set<std::string>& taken, StoredPicture& picture) {
  for (const std::string& channel : layer.channels) {
    const std::string name = layer.name_prefix.empty() ? channel : layer.name_prefix + "." + channel;
    require(!channel.empty() && taken.insert(name).second, fmt::format("EXR channel '{}' is named twice", name));
    const Format format = layer.image->format();
    picture.channels.push_back({name, channel_type(format), static_cast<std::size_t>(info(format).channel_bytes)});
  }
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image, PngChannels channels, const Notes& notes) {
  write_file(path, png_bytes(image, channels, notes));
}

void write_exr(const std::filesystem::path& path, const std::vector<Layer>& layers, const Notes& notes) {
  require(!layers.empty(), "an EXR needs a layer");
  StoredPicture picture;
  std::set<std::string> taken;
  for (const Layer& layer : layers) {
    require(layer.image && !layer.image->empty(), "an EXR layer needs an image");
    const Image& image = *layer.image;
    const Image& first = *layers.front().image;
    require(image.width() == first.width() && image.height() == first.height(), "EXR layers differ in size");
    require(!layer.channels.empty() && layer.channels.size() <= static_cast<std::size_t>(image.channels()),
            "an EXR layer names no channel, or more than its image has");
    add_channels(layer, taken, picture);
  }
  picture.width = layers.front().image->width();
  picture.height = layers.front().image->height();
  picture.compression = "zip";
  picture.notes = notes;

  const std::size_t texel_bytes = picture.texel_bytes();
  std::vector<std::byte> texels(texel_bytes * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  std::byte* out = texels.data();
  for (const Layer& layer : layers) {
    const std::size_t bytes = layer.channels.size() * info(layer.image->format()).channel_bytes;
    interleave(*layer.image, bytes, texel_bytes, out);
    out += bytes;
  }
  write_file(path, encoded_exr(path_text(path), picture, texels));
}

}  // namespace rainref::image_io
