// Reads EXR and PNG files as evidence of what a GPU stored: every bit unchanged, including NaN and infinity.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rainref/image.h"

namespace rainref::image_io {

struct Evidence {
  struct Channel {
    std::string name;
    FormatInfo::Kind kind;  ///< unorm8 for 8-bit codes, whatever encoding the file declares
    std::size_t offset;     ///< offset in a texel
  };
  std::size_t width = 0, height = 0;
  std::vector<Channel> channels;  ///< red first: see channel_order
  std::size_t texel_bytes = 0;
  std::vector<std::byte> texels;  ///< rows in the order of the file, no padding
};

/// Reads the size from the file's header before a library reads the file, so that a hostile size is refused before anything is allocated.
/// `file` is quoted and starts every message. Throws Error(port_files) for bytes that are no EXR or PNG (with their actual type if known),
/// and for files that are no evidence: lossy EXR compression, deep data, several parts, mip levels, a crop; PNG with 16 or fewer than 8
/// bits, a palette or a transparent colour.
struct EvidenceSize {
  std::size_t width, height;
};
EvidenceSize evidence_size(std::string_view file, std::span<const std::byte> bytes);

/// Decodes a file whose size the caller has checked: memory grows with width x height. No colour or alpha conversion. Throws
/// Error(port_files) as evidence_size does, and if the file is damaged, has more than four channels or channels in an unknown order.
Evidence read_evidence(std::string_view file, std::span<const std::byte> bytes);

/// The indices of an EXR's channels as red, green, blue, alpha. EXR sorts channels by name, so names decide, in upper or lower case and
/// without a common layer prefix: R G B A, else X Y Z W, else U V, else Y A, each from the first letter on without gaps; a single channel
/// may have any name. Throws Error(port_files) for other names and for several layers.
std::vector<std::size_t> channel_order(std::string_view file, std::span<const std::string> names);

}  // namespace rainref::image_io
