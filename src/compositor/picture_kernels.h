// Sums over the samples of pixels, and pixels as images store them, in lanes of doubles.
#pragma once

#include "compositor/picture.h"

namespace rainref::compositor {

/// Sums over the samples of each pixel of a tile. Arrays go on to whole lanes.
class SampleSums {
 public:
  void make_room(std::size_t pixels) { columns_.make_room(pixels); }
  VecArraysOut radiance() { return columns_.vectors(0); }
  VecArraysOut normal() { return columns_.vectors(3); }
  double* film() { return columns_[6]; }
  double* mask() { return columns_[7]; }
  double* met() { return columns_[8]; }    ///< how many met a surface
  double* depth() { return columns_[9]; }  ///< not a sum: the least

 private:
  Columns<10> columns_;
};

/// Adds a sample of each pixel, to nothing if it is the first.
void add_sample(std::size_t pixels, SeenColumns& seen, bool is_first, SampleSums& sums);
/// `pixels` of them from the first on, each sum multiplied by `share`, as floats: four channels for beauty and normal. Whole lanes are
/// written.
void develop(std::size_t first, std::size_t pixels, double share, SampleSums& sums, float* beauty, float* normal, float* film, float* mask,
             float* depth);

}  // namespace rainref::compositor
