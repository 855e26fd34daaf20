// A display pass by table. There are 65 536 halves, fewer than the values of most pictures. If every code depends on one stored half alone,
// the pass is evaluated once for each half. A picture with fewer values runs the pass itself.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "rainref/image.h"

namespace rainref {

class CodeTable {
 public:
  /// The pass itself: rows [y0, y1) of an rgba16f image into an rgba8 image of the same size. It must treat red, green and blue alike,
  /// independent of the other channels and of the position. Its captures must outlive the table.
  using Pass = std::function<void(const Image& colour, Image& picture, int y0, int y1)>;

  CodeTable() = default;
  /// For pictures of this size.
  CodeTable(int width, int height, Pass pass);

  /// Writes rows [y0, y1) as the pass would; alpha is 1.
  void rows(const Image& colour, Image& picture, int y0, int y1) const;

 private:
  Pass pass_;
  std::vector<std::uint8_t> code_;  ///< code of each half; empty: too few texels
};

}  // namespace rainref
