// A buffer outside the pass that computed it. Packs, captures and dumps of ports consist of such arrays.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "capture/bytes.h"
#include "math/uncertain.h"
#include "rainref/image.h"
#include "scene/uniform_block.h"

namespace rainref::capture {

/// Images: levels[l] holds the canonical bytes of mip level l (rows from row 0 = v 0, no padding, little endian) of max(1, width >> l) x
/// max(1, height >> l) texels. Records: levels[0] holds `width` records of `record.size` bytes, and height is 1; format is the texel format
/// with the same layout (record_format.h), and meaningless if there is none.
struct Array {
  bool is_records = false;
  Format format = Format::r8;
  scene::UniformBlock record;
  int width = 0, height = 0;
  std::vector<Bytes> levels;
  /// Intervals of the values of level 0, decoded, for an input that is not known exactly; null: it is.
  std::shared_ptr<const enclosed::Uncertain> uncertain = nullptr;

  int level_width(int level) const { return width >> level > 1 ? width >> level : 1; }
  int level_height(int level) const { return height >> level > 1 ? height >> level : 1; }
  /// Bytes of a texel or record.
  std::size_t element_bytes() const { return is_records ? record.size : static_cast<std::size_t>(info(format).texel_bytes()); }
};

}  // namespace rainref::capture
