// EXR and PNG files as evidence of what a GPU stored: every bit as in the file, NaN and infinity too.
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
    FormatInfo::Kind kind;  ///< unorm8 for 8-bit codes, whatever encoding the file claims
    std::size_t offset;     ///< in a texel
  };
  std::size_t width = 0, height = 0;
  std::vector<Channel> channels;  ///< red first: see channel_order
  std::size_t texel_bytes = 0;
  std::vector<std::byte> texels;  ///< rows as they lie in the file, the first first, no padding
};

/// The size that the file's header claims, found before a library looks at the file, so that a hostile size is refused
/// before anything is allocated. `file` is quoted and starts every message. Throws Error(port_files) for bytes that are
/// no EXR or PNG (naming what they are instead, where known) or for one that is no evidence: lossy EXR compression,
/// deep data, several parts, mip levels, a crop; PNG of 16 or fewer than 8 bits, with a palette or a transparent
/// colour.
struct EvidenceSize {
  std::size_t width, height;
};
EvidenceSize evidence_size(std::string_view file, std::span<const std::byte> bytes);

/// Decodes a file whose size the caller has found right: memory goes with width x height. No colour or alpha
/// conversion. Throws Error(port_files) as evidence_size, and when the file is damaged, has more than four channels or
/// channels whose order cannot be told.
Evidence read_evidence(std::string_view file, std::span<const std::byte> bytes);

/// The indices of an EXR's channels as red, green, blue, alpha. EXR sorts channels by name, so names decide, upper or
/// lower case, a common layer prefix aside: R G B A, else X Y Z W, else U V, else Y A, each from the first letter on
/// without gaps; a single channel may have any name. Throws Error(port_files) for other names and for several layers.
std::vector<std::size_t> channel_order(std::string_view file, std::span<const std::string> names);

}  // namespace rainref::image_io
