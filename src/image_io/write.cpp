#include "image_io/write.h"

#include <cstring>
#include <exception>
#include <set>
#include <string_view>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "base/atomic_file.h"
#include "image_io/openimageio.h"
#include "rainref/error.h"

namespace rainref::image_io {

namespace {

void require(bool holds, std::string_view what) {
  if (!holds) throw Error(ExitCode::internal, fmt::format("writing a picture: {}", what));
}

/// Encodes interleaved texels in the native types that the spec names, in memory: OpenImageIO would open the final name,
/// and its errors do not tell why a disk refused. `name` is for messages.
std::vector<std::byte> encoded(const std::string& name, const char* writer, const OIIO::ImageSpec& spec, const std::vector<std::byte>& texels) {
  configure_openimageio();
  std::vector<unsigned char> bytes;
  std::string problem;
  try {
    OIIO::Filesystem::IOVecOutput memory(bytes);  // outlives its writer
    const auto output = OIIO::ImageOutput::create(writer);
    require(output != nullptr, fmt::format("this OpenImageIO has no writer for {}", writer));
    require(output->set_ioproxy(&memory), fmt::format("this OpenImageIO cannot write {} to memory", writer));
    // The data are in the file's own types: for one type to be named, for several to be left unknown.
    const OIIO::TypeDesc type = spec.channelformats.empty() ? spec.format : OIIO::TypeUnknown;
    const bool whole = output->open(name, spec) && output->write_image(type, texels.data()) && output->close();
    if (!whole || output->has_error()) problem = output->geterror();
    if (!whole && problem.empty()) problem = "no reason given";
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    problem = error.what();
  }
  if (!problem.empty()) throw Error(ExitCode::io, fmt::format("cannot write '{}': {}", name, problem));
  const auto written = std::as_bytes(std::span(bytes));
  return {written.begin(), written.end()};
}

/// Copies the first `bytes` bytes of every texel of `in` to every `step` bytes from `out` on.
void interleave(const Image& in, std::size_t bytes, std::size_t step, std::byte* out) {
  const std::size_t texel_bytes = info(in.format()).texel_bytes();
  for (int y = 0; y < in.height(); ++y) {
    const std::byte* row = in.row_bytes(y);
    for (int x = 0; x < in.width(); ++x, row += texel_bytes, out += step) std::memcpy(out, row, bytes);
  }
}

std::vector<std::byte> encoded_png(const std::string& name, const Image& image, PngChannels channels) {
  require(image.format() == Format::rgba8 || image.format() == Format::rgba8_srgb, "a PNG is made of rgba8");
  const int count = channels == PngChannels::rgb ? 3 : 4;
  OIIO::ImageSpec spec(image.width(), image.height(), count, OIIO::TypeUInt8);
  spec.attribute("oiio:UnassociatedAlpha", 1);  // else colour would be divided by alpha
  spec.attribute("png:compressionLevel", 6);
  if (image.format() == Format::rgba8_srgb) spec.attribute("oiio:ColorSpace", "sRGB");
  std::vector<std::byte> texels(static_cast<std::size_t>(count) * image.width() * image.height());
  interleave(image, count, count, texels.data());
  return encoded(name, "png", spec, texels);
}

OIIO::TypeDesc channel_type(Format format) {
  switch (info(format).kind) {
    case FormatInfo::float16:
      return OIIO::TypeHalf;
    case FormatInfo::float32:
      return OIIO::TypeFloat;
    default:
      require(false, fmt::format("an EXR layer cannot be {}", info(format).name));
  }
  return OIIO::TypeUnknown;
}

/// Adds the layer's channels to the spec; names must not repeat.
void add_channels(const Layer& layer, std::set<std::string>& taken, OIIO::ImageSpec& spec) {
  for (const std::string& channel : layer.channels) {
    const std::string name = layer.name_prefix.empty() ? channel : layer.name_prefix + "." + channel;
    require(!channel.empty() && taken.insert(name).second, fmt::format("EXR channel '{}' is named twice", name));
    spec.channelnames.push_back(name);
    spec.channelformats.push_back(channel_type(layer.image->format()));
  }
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image, PngChannels channels) {
  write_file(path, encoded_png(path.string(), image, channels));
}

std::vector<std::byte> png_bytes(const Image& image, PngChannels channels) { return encoded_png("picture.png", image, channels); }

void write_exr(const std::filesystem::path& path, const std::vector<Layer>& layers) {
  require(!layers.empty(), "an EXR needs a layer");
  OIIO::ImageSpec spec;
  std::set<std::string> taken;
  for (const Layer& layer : layers) {
    require(layer.image && !layer.image->empty(), "an EXR layer needs an image");
    const Image& image = *layer.image;
    const Image& first = *layers.front().image;
    require(image.width() == first.width() && image.height() == first.height(), "EXR layers differ in size");
    require(!layer.channels.empty() && layer.channels.size() <= static_cast<std::size_t>(image.channels()),
            "an EXR layer names no channel, or more than its image has");
    if (&layer == &layers.front())
      spec = OIIO::ImageSpec(image.width(), image.height(), 0, channel_type(image.format()));
    add_channels(layer, taken, spec);
  }
  spec.nchannels = static_cast<int>(spec.channelnames.size());
  spec.attribute("compression", "zip");
  // An empty date: without one, OpenImageIO stores the time of day, and no two files would be equal.
  spec.attribute("DateTime", "");

  const std::size_t texel_bytes = spec.pixel_bytes(true);
  std::vector<std::byte> texels(texel_bytes * static_cast<std::size_t>(spec.width) *
                                static_cast<std::size_t>(spec.height));
  std::byte* out = texels.data();
  for (const Layer& layer : layers) {
    const std::size_t bytes = layer.channels.size() * info(layer.image->format()).channel_bytes;
    interleave(*layer.image, bytes, texel_bytes, out);
    out += bytes;
  }
  write_file(path, encoded(path.string(), "openexr", spec, texels));
}

}  // namespace rainref::image_io
