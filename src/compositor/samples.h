// Where the rays of a pixel go through it: fixed tables, so that a picture is a pure function of its scene.
#pragma once

#include <array>
#include <span>

namespace rainref::compositor {

/// A place in a pixel, from its centre, in pixels: x to the right, y up, both in [-1/2, 1/2).
struct Sample {
  double x, y;
};
/// The numbers of samples that have a pattern.
inline constexpr std::array<int, 4> sample_counts{1, 4, 8, 16};
/// The pattern of so many samples, of equal weight (box filter). They are the standard multisample positions of
/// Direct3D 11 and Vulkan, in sixteenths of a pixel: one at the centre, or a grid turned so that no two share a row or a
/// column. Throws Error(usage) for another count.
std::span<const Sample> samples(int count);

}  // namespace rainref::compositor
