#include "image_io/decode.h"

#include <algorithm>
#include <exception>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "base/memory.h"
#include "image_io/channels.h"
#include "image_io/openimageio.h"
#include "image_io/png_chunks.h"
#include "rainref/error.h"
#include "rainref/image.h"

namespace rainref::image_io {

namespace {

constexpr int max_side = 65536;

[[noreturn]] void refuse(std::string_view file, const std::string& why) {
  throw Error(ExitCode::usage, fmt::format("{}: {}", file, why));
}

const char* reader_name(FileKind kind) {
  switch (kind) {
    case FileKind::exr:
      return "openexr";
    case FileKind::png:
      return "png";
    case FileKind::hdr:
      return "hdr";
    case FileKind::jpeg:
      return "jpeg";
  }
  return "";
}

/// OpenImageIO's reason on one line, without the full stop and line break that it sometimes has.
std::string reason(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  text.erase(text.find_last_not_of(" .") + 1);
  return text.empty() ? "damaged or incomplete" : text;
}

/// What the picture needs at once: the decoded samples and the image made of them. A header of a few bytes can ask for
/// 64 GiB, and filling that would get the process killed rather than refused.
void check_memory(std::string_view file, const OIIO::ImageSpec& spec, std::size_t texel_bytes) {
  const std::size_t bytes = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                            (texel_bytes + info(Format::rgba32f).texel_bytes());
  if (bytes > physical_memory()) {
    refuse(file, fmt::format("{}x{} needs {} of memory; this machine has {}", spec.width, spec.height,
                             memory_text(bytes), memory_text(physical_memory())));
  }
}

void check_shape(std::string_view file, FileKind kind, const OIIO::ImageSpec& spec) {
  if (spec.deep) refuse(file, "deep pixels are not supported");
  if (spec.depth > 1) refuse(file, "volumes are not supported");
  if (spec.width < 1 || spec.height < 1 || spec.width > max_side || spec.height > max_side) {
    refuse(file, fmt::format("size {}x{}: each side must be from 1 to {}", spec.width, spec.height, max_side));
  }
  if (spec.nchannels < 1) refuse(file, "no channels");
  // A crop or an overscan would shift every texel coordinate without a word. (The offset that a PNG may carry is a
  // position on a printed page.)
  if (kind == FileKind::exr && (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
                                spec.height != spec.full_height)) {
    refuse(file, fmt::format("data window {}x{}{:+}{:+} differs from display window {}x{}{:+}{:+}; save it uncropped",
                             spec.width, spec.height, spec.x, spec.y, spec.full_width, spec.full_height, spec.full_x,
                             spec.full_y));
  }
  const int orientation = spec.get_int_attribute("Orientation", 1);
  if (orientation != 1)
    refuse(file, fmt::format("stored rotated or mirrored (orientation {}); save it upright", orientation));
}

Sample sample_of(std::string_view file, const OIIO::ImageSpec& spec, int channel) {
  const OIIO::TypeDesc type = spec.channelformat(channel);
  if (type == OIIO::TypeUInt8) return Sample::u8;
  if (type == OIIO::TypeUInt16) return Sample::u16;
  if (type == OIIO::TypeHalf) return Sample::half;
  if (type == OIIO::TypeFloat) return Sample::float32;
  refuse(file, fmt::format("channel '{}' is of type {}; expected 8 or 16 bits, half or float",
                           spec.channelnames[channel], type.c_str()));
}

std::string compression_of(FileKind kind, const OIIO::ImageSpec& spec) {
  switch (kind) {
    case FileKind::exr:
      return std::string(spec.get_string_attribute("compression", "none"));
    case FileKind::png:
      return "deflate";
    case FileKind::hdr:
      return "rgbe";
    case FileKind::jpeg:
      return "jpeg";
  }
  return "";
}

}  // namespace

Decoded decode(std::string_view file, FileKind kind, std::span<const std::byte> bytes, std::string_view layer) try {
  if (kind == FileKind::png && !png_is_whole(bytes)) refuse(file, "truncated: the end mark of the PNG is missing");
  configure_openimageio();
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());  // outlives its reader
  const auto input = OIIO::ImageInput::create(reader_name(kind));
  if (!input) refuse(file, fmt::format("this OpenImageIO has no reader for {}", reader_name(kind)));
  if (!input->set_ioproxy(&memory)) {
    refuse(file, fmt::format("this OpenImageIO cannot read {} from memory", reader_name(kind)));
  }

  OIIO::ImageSpec config, spec;
  config.attribute("oiio:UnassociatedAlpha", 1);  // colour not multiplied by alpha
  config.attribute("oiio:RawColor", 1);           // no change of colour model
  // The bytes come from memory; OpenImageIO needs a name for its messages only, and ours starts with the real one.
  if (!input->open("picture", spec, config)) refuse(file, reason(input->geterror()));
  check_shape(file, kind, spec);

  Decoded out;
  out.width = spec.width;
  out.height = spec.height;
  out.channel_names = spec.channelnames;
  out.compression = compression_of(kind, spec);
  out.declared_linear = OIIO::Strutil::iequals(spec.get_string_attribute("oiio:ColorSpace"), "linear");

  // Channels are read from the first wanted to the last: a file may have a thousand others.
  const ChannelPick pick = pick_channels(file, spec.channelnames, layer);
  int first = spec.nchannels, last = -1;
  for (const int c : pick.source) {
    if (c < 0) continue;
    first = std::min(first, c);
    last = std::max(last, c);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const int c = pick.source[i];
    out.channels[i].one = c == ChannelPick::one;
    if (c < 0) continue;
    out.channels[i].name = spec.channelnames[c];
    out.channels[i].sample = sample_of(file, spec, c);
    out.channels[i].offset = static_cast<int>(spec.pixel_bytes(first, c, true));
  }
  out.texel_bytes = spec.pixel_bytes(first, last + 1, true);
  check_memory(file, spec, out.texel_bytes);
  // Not zeroed: a file that promises more than it holds is found out before the memory is touched.
  out.texels = std::make_unique_for_overwrite<std::byte[]>(out.texel_bytes * static_cast<std::size_t>(out.width) *
                                                           static_cast<std::size_t>(out.height));

  // The unknown type asks for the file's own types, each channel in its own: no value is converted.
  const bool whole = input->read_image(0, 0, first, last + 1, OIIO::TypeUnknown, out.texels.get());
  // Some readers return partial data and success, and leave only a message behind.
  if (!whole || input->has_error()) refuse(file, reason(input->geterror()));
  return out;
} catch (const Error&) {
  throw;
} catch (const std::exception& error) {
  refuse(file, reason(error.what()));
}

}  // namespace rainref::image_io
