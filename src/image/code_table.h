// A display pass by table. There are 65 536 halves, fewer than a picture has texels: a pass whose every code depends on one
// stored half alone is evaluated once for each of them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "rainref/image.h"

namespace rainref {

class CodeTable {
 public:
  /// The pass itself: rgba16f in, rgba8 of the same size out. Red, green and blue must be treated alike, whatever else the
  /// texel holds and wherever it lies.
  using Pass = std::function<void(const Image& colour, Image& picture)>;

  CodeTable() = default;
  explicit CodeTable(const Pass& pass);

  /// What the pass would write in rows [y0, y1); alpha is 1.
  void rows(const Image& colour, Image& picture, int y0, int y1) const;

 private:
  std::array<std::uint8_t, 65536> code_{};
};

}  // namespace rainref
