#include "image_io/decode.h"

#include <algorithm>
#include <exception>

#include <fmt/format.h>

#include "base/memory.h"
#include "image_io/channels.h"
#include "image_io/codec.h"
#include "image_io/png_chunks.h"
#include "rainref/error.h"
#include "rainref/image.h"

namespace rainref::image_io {

namespace {

[[noreturn]] void refuse(std::string_view file, const std::string& why) { throw Error(ExitCode::usage, fmt::format("{}: {}", file, why)); }

const char* format_name(FileKind kind) {
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

/// Memory needed at the same time: the decoded samples and the image made of them. A header of a few bytes can ask for 64 GiB, and filling
/// that would get the process killed instead of an error.
void check_memory(std::string_view file, const StoredPicture& spec, std::size_t texel_bytes) {
  const std::uint64_t bytes = static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height) *
                              (texel_bytes + info(Format::rgba32f).texel_bytes());
  const MemoryLimit limit = memory_limit();
  if (bytes > limit.bytes)
    refuse(file, fmt::format("{}x{} needs {} of memory; {} {}", spec.width, spec.height, memory_text(bytes), limit.owner,
                             memory_text(limit.bytes)));
}

void check_shape(std::string_view file, FileKind kind, const StoredPicture& spec) {
  if (spec.deep) refuse(file, "deep pixels are not supported");
  if (spec.depth > 1) refuse(file, "volumes are not supported");
  if (spec.width < 1 || spec.height < 1 || spec.width > max_side || spec.height > max_side) {
    refuse(file, fmt::format("size {}x{}: each side must be from 1 to {}", spec.width, spec.height, max_side));
  }
  if (spec.channels.empty()) refuse(file, "no channels");
  // A crop or an overscan would silently shift every texel coordinate. (The offset in a PNG is a position on a printed page.)
  if (kind == FileKind::exr &&
      (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width || spec.height != spec.full_height)) {
    refuse(file, fmt::format("data window {}x{}{:+}{:+} differs from display window {}x{}{:+}{:+}; save it uncropped", spec.width,
                             spec.height, spec.x, spec.y, spec.full_width, spec.full_height, spec.full_x, spec.full_y));
  }
  const int most = kind == FileKind::jpeg || kind == FileKind::png ? 8 : 1;
  if (spec.orientation < 1 || spec.orientation > most)
    refuse(file, fmt::format("stored rotated or mirrored (orientation {}); save it upright", spec.orientation));
}

Sample sample_of(std::string_view file, const StoredChannel& channel) {
  if (channel.type == "uint8") return Sample::u8;
  if (channel.type == "uint16") return Sample::u16;
  if (channel.type == "half") return Sample::half;
  if (channel.type == "float") return Sample::float32;
  refuse(file, fmt::format("channel '{}' is of type {}; expected 8 or 16 bits, half or float", channel.name, channel.type));
}

std::string compression_of(FileKind kind, const StoredPicture& spec) {
  switch (kind) {
    case FileKind::exr:
      return spec.compression;
    case FileKind::png:
      return "deflate";
    case FileKind::hdr:
      return "rgbe";
    case FileKind::jpeg:
      return "jpeg";
  }
  return "";
}

bool is_linear(std::string_view colour_space) {
  return std::ranges::equal(colour_space, std::string_view("linear"),
                            [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

}  // namespace

std::string one_line(std::string reason) {
  std::ranges::replace(reason, '\n', ' ');
  reason.erase(reason.find_last_not_of(" .") + 1);
  return reason.empty() ? "damaged or incomplete" : reason;
}

Decoded decode(std::string_view file, FileKind kind, std::span<const std::byte> bytes, std::string_view layer, Content content,
               Texels texels) try {
  if (kind == FileKind::png && !png_is_whole(bytes)) refuse(file, "truncated: the end mark of the PNG is missing");
  const auto reader = codec().open(format_name(kind), bytes);
  if (!reader) refuse(file, fmt::format("this OpenImageIO cannot read {} from memory", format_name(kind)));
  const StoredPicture& spec = reader->picture();
  check_shape(file, kind, spec);

  Decoded out;
  out.width = spec.width;
  out.height = spec.height;
  out.orientation = spec.orientation;
  for (const StoredChannel& channel : spec.channels) out.channel_names.push_back(channel.name);
  out.compression = compression_of(kind, spec);
  out.declared_linear = is_linear(spec.colour_space);

  // Reads only the channels from the first wanted to the last, because a file may have a thousand others.
  const ChannelPick pick = content == Content::colour ? pick_channels(file, out.channel_names, layer)
                                                      : pick_quantity(file, out.channel_names, content == Content::depth);
  std::size_t first = spec.channels.size(), end = 0;
  for (const int c : pick.source) {
    if (c < 0) continue;
    first = std::min(first, static_cast<std::size_t>(c));
    end = std::max(end, static_cast<std::size_t>(c) + 1);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const int c = pick.source[i];
    out.channels[i].one = c == ChannelPick::one;
    if (c < 0) continue;
    const auto index = static_cast<std::size_t>(c);
    out.channels[i].name = spec.channels[index].name;
    out.channels[i].sample = sample_of(file, spec.channels[index]);
    out.channels[i].offset = static_cast<int>(spec.texel_bytes(first, index));
  }
  out.texel_bytes = spec.texel_bytes(first, end);
  if (texels == Texels::left) return out;
  check_memory(file, spec, out.texel_bytes);
  // Not zeroed, so that a file with less data than its header states is detected before the memory is touched.
  out.texels = std::make_unique_for_overwrite<std::byte[]>(out.texel_bytes * static_cast<std::size_t>(out.width) *
                                                           static_cast<std::size_t>(out.height));
  reader->read(first, end, out.texels.get());
  return out;
} catch (const Error&) {
  throw;
} catch (const std::exception& error) {
  refuse(file, one_line(error.what()));
}

}  // namespace rainref::image_io
