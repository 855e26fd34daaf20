// What a port stored and what was expected, as pictures for the eye.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "capture/pass_case.h"
#include "judge/verdict.h"

namespace rainref::reports {

/// Whole outputs are shown with at most this many columns and rows; a larger one is thinned, and gets a window of
/// `picture_window` texels at full size around its worst element.
inline constexpr int picture_side = 640, picture_window = 256;

/// One way to look at an output: colour, one channel, or a window of these. All pictures are PNG files of one size, row 0
/// of the buffer at the bottom.
struct View {
  std::string label;          ///< "colour", "x", "x, window"
  std::string scale;          ///< what black and white are, or the exposure
  int x0 = 0, y0 = 0;         ///< the first texel shown
  int width = 0, height = 0;  ///< texels shown
  int thinned = 1;            ///< texels in a pixel's side; reference and port show the first, the others the worst
  std::uint64_t largest = 0;  ///< difference in codes that has the strongest colour; 0: none differs
  bool has_nan = false;       ///< magenta
  std::vector<std::byte> reference, port, difference, verdict;

  std::size_t bytes() const { return reference.size() + port.size() + difference.size() + verdict.size(); }
};

/// The views of an image output, colour or a channel each. The arrays have the same shape as the judgement; unit and colour
/// space are those of `expected`.
///
/// Colour is shown as stored where it is display codes, else by a power of two that brings the reference's brightest
/// percent to white, sRGB-encoded. Data go from black, the reference's lowest percent, to white, its highest. Reference and
/// port share the scale. The difference is port - reference in ordered codes (image/code_range.h), of colour the channel
/// that differs most: blue where the port is lower, orange where it is higher, one step for each doubling.
std::vector<View> views_of(const judge::OutputJudgement& output, const capture::CaseOutput& expected, const capture::Array& port);

/// The colours of the verdict map, "#rrggbb": equal, inside, atypical, outside.
std::string verdict_colour(int verdict);
/// The colour of a difference of `codes` where `largest` has the strongest, "#rrggbb".
std::string difference_colour(std::int64_t codes, std::uint64_t largest);

}  // namespace rainref::reports
