// The shells of splat: drops to stamps, then bands of rows, each of which offers itself every stamp in slot order.
#pragma once

#include <span>

#include "drops/records.h"
#include "drops/splat_uniforms.h"
#include "rainref/image.h"

namespace rainref::drops {

/// A drop as splat_stamp gives it, and the texels that it may touch.
struct StampRecord {
  float x, y, radius, inverse_radius_sq, height;
  float half_width;                     ///< of the columns that it reaches [texel]
  std::int32_t first_row, end_row;      ///< half open; empty for what is dead or beside the texture
};
/// Rows of one band, and the bands that a stamp reaches, for a quick choice of those that reach a given one.
struct Bands {
  int rows, count;
};
struct StampedDrops {
  std::span<StampRecord> stamps;
  std::span<std::int8_t> first_band, last_band;  ///< last < first: none
};
/// Bands depend on the height of the texture alone.
Bands splat_bands(int height);

/// Stamps of drops [begin, end).
void make_stamps(const SplatUniforms& uniforms, Bands bands, std::span<const Drop> drops, std::int64_t begin, std::int64_t end,
                 const StampedDrops& out);

struct SplatJob {
  SplatUniforms uniforms;
  bool half_accumulation;  ///< round to half after each drop
  Rounding rounding;
  const Image* film;  ///< null: none
  Image* height;      ///< r16f
};
/// One band of the height texture, cleared first.
void splat_band(const SplatJob& job, Bands bands, int band, const StampedDrops& drops);

}  // namespace rainref::drops
