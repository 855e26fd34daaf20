// The texels that a lookup with interval coordinates may read, and its possible results.
#pragma once

#include <concepts>
#include <cstdint>

#include "image/texture.h"
#include "math/enclosure.h"

namespace rainref::enclosed {

/// One mip level of a texture with its address rules, for lookups of enclosures.
struct Texels {
  const float* texels;  ///< first texel of the level
  int channels, width, height;
  Address address_u, address_v;
  const float* border;
  TexelPrecision precision = TexelPrecision::float32;
};

/// The coordinates [texel] that a lookup may compute along one side. For repeat they are not reduced: indices wrap.
struct Span {
  double lo, hi;  ///< finite, lo <= hi
  int size;
  Address address;
  bool vacuous;
  Span moved(int texels) const { return {lo + texels, hi + texels, size, address, vacuous}; }
  /// Index of texel i by the address rule; -1 for the border.
  int index(std::int64_t i) const;
};
/// x = a(u) size - 1/2 for filtered lookups and x = a(u) size for unfiltered ones, as in sampling-inl.h: computed by the profile's
/// arithmetic, or by a sampler if the profile has one, and valid on either side of a border of the address rule.
Span filtered_span(Address address, Enclosure u, int size);
Span nearest_span(Address address, Enclosure u, int size);

/// A lookup that may read more texels is vacuous; visiting this many takes 10 to 100 microseconds.
inline constexpr std::int64_t most_texels = 1 << 16;

/// Bilinear filtering over everything that the spans hold, with each formula of mix: the hull over the cells; over more than 16 cells, the
/// hull of their texels. The result lies within the touched texels, except for the roundings of mix. If the profile has a sampler, its four
/// weights may be rounded to the subtexel bits (rows and columns keep their sums), and its result to the precision of the texels. An NVIDIA
/// H100 does both.
Enclosure filtered(const Texels& t, const Span& x, const Span& y, int channel);

/// Change of the value of one level if a sampler rounds all eight weights of a lookup between two levels together, including the level's
/// share. The share is multiplied by f_x first, then each of the two parts by f_y; every product is rounded to the nearest step, and the
/// rest goes to the other side. Or y before x. An NVIDIA H100 does the first.
struct JointRounding {
  double slack = 0;             ///< added to the sum of the two levels, for any share
  double below = 0, above = 0;  ///< margin that filtered() has added for the level alone, at either end
  TexelPrecision precision = TexelPrecision::float32;
  double least = 0, greatest = 0;  ///< of the level's texels
};
Enclosure filtered(const Texels& t, const Span& x, const Span& y, int channel, JointRounding& joint);
/// Mixes the level `fine` and the one below it by a share of the coarse one in [low, high], with the weights rounded either way.
Enclosure between_levels(Enclosure fine, const JointRounding& fine_rounding, Enclosure coarse, const JointRounding& coarse_rounding,
                         float low, float high);

/// The texel that an unfiltered lookup reads. If the spans leave at most PathEnumeration::max_runs choices, one is decided.
struct Pick {
  std::int64_t x0, x1, y0,
      y1;  ///< indices before the address rule; a range only if there are too many choices
  bool vacuous;
};
Pick pick(const Span& x, const Span& y);
/// The texel, or the hull of the remaining texels.
Enclosure picked(const Texels& t, const Span& x, const Span& y, const Pick& p, int channel);

/// Levels of detail that a sampler may compute for lod, clamped to [0, levels - 1].
Enclosure level_range(Enclosure lod, int levels);

}  // namespace rainref::enclosed
