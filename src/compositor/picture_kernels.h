// Sums over the samples of pixels, and conversion of pixels to stored form, in lanes of doubles.
#pragma once

#include "compositor/picture.h"

namespace rainref::compositor {

/// Sums over the samples of each pixel of a tile. Arrays are padded to whole lanes.
class SampleSums {
 public:
  void make_room(std::size_t pixels) { columns_.make_room(pixels); }
  VecArraysOut radiance() { return columns_.vectors(0); }
  VecArraysOut normal() { return columns_.vectors(3); }
  double* film() { return columns_[6]; }
  double* mask() { return columns_[7]; }
  double* met() { return columns_[8]; }    ///< number of samples that hit a surface
  double* depth() { return columns_[9]; }  ///< not a sum: the minimum

 private:
  Columns<10> columns_;
};

/// Adds a sample of each pixel; the first one replaces the sums.
void add_sample(std::size_t pixels, SeenColumns& seen, bool is_first, SampleSums& sums);
/// Converts `pixels` pixels from the first on to floats, with each sum multiplied by `share`: four channels for beauty and normal. Writes
/// whole lanes.
void develop(std::size_t first, std::size_t pixels, double share, SampleSums& sums, float* beauty, float* normal, float* film, float* mask,
             float* depth);

}  // namespace rainref::compositor
