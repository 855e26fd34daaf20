// Pictures of stored and expected outputs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "capture/pass_case.h"
#include "judge/verdict.h"

namespace rainref::reports {

/// Largest number of columns and rows in which a whole output is shown. A larger one is thinned, and gets a window of `picture_window`
/// texels at full size around its worst element.
inline constexpr int picture_side = 640, picture_window = 256;

/// One view of an output: colour, one channel, or a window of these. All pictures are PNG files of one size, row 0 of the buffer at the
/// bottom.
struct View {
  std::string label;          ///< "colour", "x", "x, window"
  std::string scale;          ///< values of black and white, or the exposure
  int x0 = 0, y0 = 0;         ///< the first texel shown
  int width = 0, height = 0;  ///< number of texels shown
  int thinned = 1;            ///< texels per pixel side; reference and port show the first, the others the worst
  std::uint64_t largest = 0;  ///< difference in codes that has the strongest colour; 0: no difference
  bool has_nan = false;       ///< NaN is shown in magenta
  std::vector<std::byte> reference, port, difference, verdict;

  std::size_t bytes() const { return reference.size() + port.size() + difference.size() + verdict.size(); }
};

/// The views of an image output, one of its colour or of each channel. The arrays have the same shape as the judgement; unit and colour
/// space are those of `expected`.
///
/// Display codes are shown as stored; other colours are sRGB-encoded after scaling by a power of two that brings the reference's brightest
/// percent to white. Data range from black, the reference's lowest percent, to white, its highest. Reference and port share the scale. The
/// difference is port - reference in ordered codes (image/code_range.h), for colour in the channel that differs most: blue where the port
/// is lower, orange where it is higher, one step for each doubling.
std::vector<View> views_of(const judge::OutputJudgement& output, const capture::CaseOutput& expected, const capture::Array& port);

/// The colours of the verdict map, "#rrggbb": equal, inside, atypical, outside.
std::string verdict_colour(int verdict);
/// The colour of a difference of `codes` if `largest` has the strongest colour, "#rrggbb".
std::string difference_colour(std::int64_t codes, std::uint64_t largest);

}  // namespace rainref::reports
