// The texels that a lookup may touch when its coordinates are intervals, and what it may make of them.
#pragma once

#include <concepts>
#include <cstdint>

#include "image/texture.h"
#include "math/enclosure.h"

namespace rainref::enclosed {

/// One mip level of a texture, with its address rules: what lookups of enclosures read.
struct Texels {
  const float* texels;  ///< of the level's first texel
  int channels, width, height;
  Address address_u, address_v;
  const float* border;
  TexelPrecision precision = TexelPrecision::float32;
};

/// The coordinates, in texels, that a lookup may compute along one side. For repeat they are not reduced: indices wrap.
struct Span {
  double lo, hi;  ///< finite, lo <= hi
  int size;
  Address address;
  bool vacuous;
  Span moved(int texels) const { return {lo + texels, hi + texels, size, address, vacuous}; }
  /// The index of texel i by the address rule, -1 for the border.
  int index(std::int64_t i) const;
};
/// x = a(u) size - 1/2 of filtered lookups, and x = a(u) size of unfiltered ones, as sampling-inl.h has them: by the
/// arithmetic of the profile, by a sampler where the profile has one, on either side of a border of the address rule.
Span filtered_span(Address address, Enclosure u, int size);
Span nearest_span(Address address, Enclosure u, int size);

/// Texels beyond this count make a lookup vacuous; it takes 10 to 100 microseconds to look at them.
inline constexpr std::int64_t most_texels = 1 << 16;

/// Bilinear filtering over all that the spans hold, each formula of mix: the hull over the cells; over more than 16
/// cells the hull of their texels. It lies within the texels touched, but for the roundings of mix. Where the profile has a
/// sampler, its four weights may be rounded to the subtexel bits (rows and columns keep their sums), and its result to the
/// precision of the texels: an NVIDIA H100 does both.
Enclosure filtered(const Texels& t, const Span& x, const Span& y, int channel);

/// How far the value of one level moves where a sampler rounds all eight weights of a lookup between two levels together, the
/// level's share in them: the share times f_x first, each of the two parts times f_y then, every product to the nearest step, the
/// rest beside it; or y before x. An NVIDIA H100 does the first.
struct JointRounding {
  double slack = 0;             ///< added to the sum of the two levels, whatever the share
  double below = 0, above = 0;  ///< what filtered() has added for the level alone, at either end
  TexelPrecision precision = TexelPrecision::float32;
  double least = 0, greatest = 0;  ///< of the level's texels
};
Enclosure filtered(const Texels& t, const Span& x, const Span& y, int channel, JointRounding& joint);
/// The level `fine` and the one below it, mixed by a share of the coarse one in [low, high], with the weights rounded either way.
Enclosure between_levels(Enclosure fine, const JointRounding& fine_rounding, Enclosure coarse, const JointRounding& coarse_rounding,
                         float low, float high);

/// The texel that an unfiltered lookup takes: decided where the spans leave up to PathEnumeration::max_runs open.
struct Pick {
  std::int64_t x0, x1, y0,
      y1;  ///< indices before the address rule; more than one only where there are too many to decide
  bool vacuous;
};
Pick pick(const Span& x, const Span& y);
/// The texel, or the hull of those that are left.
Enclosure picked(const Texels& t, const Span& x, const Span& y, const Pick& p, int channel);

/// Levels of detail that a sampler may compute for lod, held in [0, levels - 1].
Enclosure level_range(Enclosure lod, int levels);

}  // namespace rainref::enclosed
