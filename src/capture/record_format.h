// The storage format with the same layout as the records of a list. With it the list can be treated as an image of one row.
#pragma once

#include <algorithm>
#include <optional>

#include "rainref/image.h"
#include "scene/uniform_block.h"

namespace rainref::capture {

/// For records of one, two or four floats and nothing else; nothing for others.
inline std::optional<Format> record_format(const scene::UniformBlock& record) {
  const bool is_floats =
      std::all_of(record.members.begin(), record.members.end(), [](const scene::Member& m) { return m.scalar == scene::Scalar::float32; });
  if (!is_floats) return std::nullopt;
  switch (record.size) {
    case 4:
      return Format::r32f;
    case 8:
      return Format::rg32f;
    case 16:
      return Format::rgba32f;
    default:
      return std::nullopt;
  }
}

}  // namespace rainref::capture
