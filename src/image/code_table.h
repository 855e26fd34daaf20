// A display pass by table. There are 65 536 halves, fewer than most pictures have values: a pass whose every code depends on one
// stored half alone is evaluated once for each of them. A picture of fewer values goes through the pass itself.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "rainref/image.h"

namespace rainref {

class CodeTable {
 public:
  /// The pass itself: rows [y0, y1) of an rgba16f image into an rgba8 one of its size. Red, green and blue must be treated
  /// alike, whatever else the texel holds and wherever it lies. What it captures must live as long as the table.
  using Pass = std::function<void(const Image& colour, Image& picture, int y0, int y1)>;

  CodeTable() = default;
  /// For pictures of this size.
  CodeTable(int width, int height, Pass pass);

  /// What the pass writes in rows [y0, y1); alpha is 1.
  void rows(const Image& colour, Image& picture, int y0, int y1) const;

 private:
  Pass pass_;
  std::vector<std::uint8_t> code_;  ///< of each half; empty: too few texels
};

}  // namespace rainref
