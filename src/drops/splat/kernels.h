// The shells of splat: drops become stamps, sorted by bands of rows; then each band draws its stamps in slot order.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "drops/records.h"
#include "drops/splat/uniforms.h"
#include "rainref/image.h"

namespace rainref::drops {

/// A drop as splat_stamp returns it, and the texels that it may touch.
struct StampRecord {
  float x, y;
  float radius;  ///< of the enclosing circle
  float inverse_radius_sq, height;
  float half_width;                 ///< of the columns that it reaches [texel]
  std::int32_t first_row, end_row;  ///< half open
};
/// The lean of one, as splat_stamp returns it.
struct LeanRecord {
  float x, y, inverse_length, inverse_radius, taper, skew;
};
/// The neck of one, as neck_stamp returns it.
struct NeckRecord {
  float x, y, larger, larger_slope, smaller, smaller_slope, fillet, inverse_fillet, inverse_radius;
};
/// Division of the texture into bands of rows; depends on its height alone.
struct Bands {
  static constexpr int most = 64;
  int rows, count;
};
Bands splat_bands(int height);

/// The stamps of some consecutive drops, sorted by the bands that they reach and in slot order within each band. A stamp that reaches
/// several bands occurs in each of them.
struct StampChunk {
  std::vector<StampRecord> stamps;
  std::vector<LeanRecord> leans;      ///< for each stamp, if drops lean
  std::vector<std::int32_t> neck_of;  ///< for each stamp, if drops have necks: index in `necks`, or -1
  std::vector<NeckRecord> necks;
  std::array<std::uint32_t, Bands::most + 1> first;  ///< stamps [first[b], first[b + 1]) reach band b
};
constexpr int drops_of_chunk = 512;
/// Makes the stamps of at most drops_of_chunk drops.
void make_stamps(const SplatUniforms& uniforms, Bands bands, std::span<const Drop> drops, std::span<const Neck> necks, StampChunk& out);

struct SplatJob {
  SplatUniforms uniforms;
  bool half_accumulation;  ///< round to half after each drop
  Rounding rounding;
  const Image* film;  ///< null: no film
  Image* height;      ///< r16f
};
/// Draws one band of the height texture after clearing it.
void splat_band(const SplatJob& job, Bands bands, int band, std::span<const StampChunk> chunks);

}  // namespace rainref::drops
