// The shells of splat: drops to stamps, sorted by bands of rows; then bands, each of which draws its own in slot order.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "drops/records.h"
#include "drops/splat/uniforms.h"
#include "rainref/image.h"

namespace rainref::drops {

/// A drop as splat_stamp gives it, and the texels that it may touch.
struct StampRecord {
  float x, y;
  float radius;  ///< of the circle that holds it
  float inverse_radius_sq, height;
  float half_width;                 ///< of the columns that it reaches [texel]
  std::int32_t first_row, end_row;  ///< half open
};
/// How one leans, as splat_stamp gives it.
struct LeanRecord {
  float x, y, inverse_length, inverse_radius, taper, skew;
};
/// The neck of one, as neck_stamp gives it.
struct NeckRecord {
  float x, y, larger, larger_slope, smaller, smaller_slope, fillet, inverse_fillet, inverse_radius;
};
/// Bands of rows cut the texture by its height alone.
struct Bands {
  static constexpr int most = 64;
  int rows, count;
};
Bands splat_bands(int height);

/// The stamps of some consecutive drops, sorted by the bands that they reach and in slot order within each; one that
/// reaches several stands in each of them.
struct StampChunk {
  std::vector<StampRecord> stamps;
  std::vector<LeanRecord> leans;      ///< of each of them, where drops lean
  std::vector<std::int32_t> neck_of;  ///< of each of them, where drops have necks: its place in `necks`, or -1
  std::vector<NeckRecord> necks;
  std::array<std::uint32_t, Bands::most + 1> first;  ///< stamps [first[b], first[b + 1]) reach band b
};
constexpr int drops_of_chunk = 512;
/// Stamps of at most drops_of_chunk drops.
void make_stamps(const SplatUniforms& uniforms, Bands bands, std::span<const Drop> drops, std::span<const Neck> necks, StampChunk& out);

struct SplatJob {
  SplatUniforms uniforms;
  bool half_accumulation;  ///< round to half after each drop
  Rounding rounding;
  const Image* film;  ///< null: none
  Image* height;      ///< r16f
};
/// One band of the height texture, cleared first.
void splat_band(const SplatJob& job, Bands bands, int band, std::span<const StampChunk> chunks);

}  // namespace rainref::drops
