#include "image_io/evidence.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/checked_product.h"
#include "image_io/channels.h"
#include "image_io/codec.h"
#include "image_io/decode.h"
#include "image_io/exr_header.h"
#include "image_io/png_chunks.h"
#include "rainref/error.h"

namespace rainref::image_io {
namespace {

using Kind = FormatInfo::Kind;

constexpr std::size_t most_channels = 4;
constexpr std::uint32_t largest_tile = 2048;

[[noreturn]] void refuse(std::string_view file, const std::string& why) {
  throw Error(ExitCode::port_files, fmt::format("{}: {}", file, why));
}

bool starts_with(std::span<const std::byte> bytes, std::string_view signature) {
  return bytes.size() >= signature.size() && std::memcmp(bytes.data(), signature.data(), signature.size()) == 0;
}
bool is_exr(std::span<const std::byte> bytes) { return starts_with(bytes, "\x76\x2f\x31\x01"); }
bool is_png(std::span<const std::byte> bytes) { return starts_with(bytes, "\x89PNG\r\n\x1a\n"); }

EvidenceSize exr_size(std::string_view file, std::span<const std::byte> bytes) {
  const ExrHeader header = parse_exr_header(file, bytes);
  if (!is_lossless_exr(header.compression)) {
    refuse(file, fmt::format("EXR compression '{}' is lossy: its values are not the buffer's; save with none, rle, zips, zip or piz",
                             exr_compression_name(header.compression)));
  }
  if (header.data_window != header.display_window) {
    refuse(file, "its data window differs from its display window; save it uncropped");
  }
  if (header.is_tiled && header.tile_mode != 0) refuse(file, "mip levels in one EXR; save one file a level");
  if (header.is_tiled && (header.tile_width > largest_tile || header.tile_height > largest_tile)) {
    refuse(file, fmt::format("tiles of {}x{}; expected at most {}", header.tile_width, header.tile_height, largest_tile));
  }
  const auto& w = header.data_window;
  const std::int64_t width = std::int64_t{w[2]} - w[0] + 1, height = std::int64_t{w[3]} - w[1] + 1;
  if (width < 1 || height < 1) refuse(file, fmt::format("size {}x{}", width, height));
  return {static_cast<std::size_t>(width), static_cast<std::size_t>(height)};
}

EvidenceSize png_size(std::string_view file, std::span<const std::byte> bytes) {
  if (!png_is_whole(bytes)) refuse(file, "truncated: the end mark of the PNG is missing");
  const auto header = parse_png_header(bytes);
  if (!header) refuse(file, "damaged: a PNG that does not start with its header");
  if (header->colour_type == 3) refuse(file, "a PNG with a palette; save its codes as they are");
  if (header->bit_depth != 8) refuse(file, fmt::format("a PNG of {} bits; a buffer's 8-bit codes need 8", header->bit_depth));
  if (header->has_transparent_colour) refuse(file, "a PNG with a transparent colour (tRNS); save alpha as a channel");
  return {header->width, header->height};
}

Kind kind_of(std::string_view file, const StoredChannel& channel) {
  if (channel.type == "uint8") return Kind::unorm8;
  if (channel.type == "half") return Kind::float16;
  if (channel.type == "float") return Kind::float32;
  if (channel.type == "uint") return Kind::uint32;
  refuse(file, fmt::format("channel '{}' is of type {}", channel.name, channel.type));
}

/// All names are the first letters of `order`, in some order.
std::vector<std::size_t> in_order(std::span<const std::string> names, std::string_view order) {
  std::vector<std::size_t> out;
  for (std::size_t c = 0; c < names.size() && c < order.size(); ++c) {
    const auto found = std::ranges::find(names, order[c], letter_of);
    if (found == names.end()) return {};
    out.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  return out.size() == names.size() ? out : std::vector<std::size_t>();
}

void take_spec(std::string_view file, const StoredPicture& spec, bool exr, EvidenceSize size, Evidence& out) {
  if (spec.width < 1 || spec.height < 1 || static_cast<std::size_t>(spec.width) != size.width ||
      static_cast<std::size_t>(spec.height) != size.height || spec.depth > 1 || spec.deep) {
    refuse(file, "damaged: its header contradicts itself");
  }
  const std::size_t count = spec.channels.size();
  if (count < 1 || count > most_channels) refuse(file, fmt::format("{} channels; expected 1 to 4", count));
  out.width = size.width;
  out.height = size.height;
  out.texel_bytes = spec.texel_bytes();
  std::vector<std::string> names;
  for (const StoredChannel& channel : spec.channels) names.push_back(channel.name);
  std::vector<std::size_t> order;
  if (exr) order = channel_order(file, names);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t c = exr ? order[i] : i;
    out.channels.push_back({names[c], kind_of(file, spec.channels[c]), spec.texel_bytes(0, c)});
  }
}

}  // namespace

std::vector<std::size_t> channel_order(std::string_view file, std::span<const std::string> names) {
  for (const std::string& name : names) {
    if (layer_of(name) != layer_of(names.front()))
      refuse(file, fmt::format("several layers: {}; save one buffer a file", fmt::join(names, " ")));
  }
  if (names.size() == 1) return {0};
  for (const std::string_view order : {"RGBA", "XYZW", "UV", "YA"}) {
    if (auto found = in_order(names, order); !found.empty()) return found;
  }
  refuse(file, fmt::format("the order of channels {} cannot be told (EXR sorts them by name); name them R G B A or X Y Z W",
                           fmt::join(names, " ")));
}

EvidenceSize evidence_size(std::string_view file, std::span<const std::byte> bytes) {
  if (bytes.empty()) refuse(file, "empty file");
  if (starts_with(bytes, "\xff\xd8\xff")) refuse(file, "its content is JPEG, which is lossy: no evidence of a buffer's values");
  if (starts_with(bytes, "#?")) refuse(file, "its content is Radiance HDR, 8 bits and a shared exponent: no evidence of a buffer's values");
  if (!is_exr(bytes) && !is_png(bytes)) refuse(file, "not an EXR or PNG file");
  const EvidenceSize size = is_exr(bytes) ? exr_size(file, bytes) : png_size(file, bytes);
  if (size.width < 1 || size.height < 1 || size.width > std::size_t{max_side} || size.height > std::size_t{max_side}) {
    refuse(file, fmt::format("size {}x{}: each side must be from 1 to {}", size.width, size.height, max_side));
  }
  return size;
}

Evidence read_evidence(std::string_view file, std::span<const std::byte> bytes) try {
  const EvidenceSize size = evidence_size(file, bytes);
  const bool exr = is_exr(bytes);
  const auto reader = codec().open(exr ? "openexr" : "png", bytes);
  if (!reader) throw Error(ExitCode::internal, "this OpenImageIO cannot read EXR or PNG from memory");
  Evidence out;
  take_spec(file, reader->picture(), exr, size, out);
  const std::optional<std::size_t> size_in_memory = checked_product(out.width, out.height, out.texel_bytes);
  if (!size_in_memory)
    refuse(file, fmt::format("{}x{} texels of {} bytes are more than this build can hold", out.width, out.height, out.texel_bytes));
  out.texels.resize(*size_in_memory);
  reader->read(0, reader->picture().channels.size(), out.texels.data());
  return out;
} catch (const Error&) {
  throw;
} catch (const std::exception& error) {
  refuse(file, one_line(error.what()));
}

}  // namespace rainref::image_io
