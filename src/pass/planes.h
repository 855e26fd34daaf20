// Channels of an image as separate planes, readable beyond the ends by the image's address rule.
#pragma once

#include <algorithm>
#include <vector>

#include "capture/pass_case.h"
#include "math/half.h"
#include "math/unorm.h"
#include "pass/definition.h"

namespace rainref::pass {

/// Calls f(Storage()) with the type of a format's channels: half, float or code.
template <class F>
void in_storage(Format format, const F& f) {
  const FormatInfo::Kind kind = info(format).kind;
  return kind == FormatInfo::float16 ? f(Half()) : kind == FormatInfo::float32 ? f(float()) : f(Unorm8());
}
/// Fills the margins of a row by the address rule; a mirrored image is treated as clamped.
template <class Storage>
void fill_margins(Storage* row, int width, Address address, Storage border) {
  constexpr int margin = Image::left_margin;
  if (address != Address::repeat) {
    // Copies, because the loop might overwrite the number that it reads.
    const Storage before = address == Address::border ? border : row[0], after = address == Address::border ? border : row[width - 1];
    std::fill_n(row - margin, margin, before);
    std::fill_n(row + width, margin, after);
    return;
  }
  // Outwards, so that a row shorter than a margin repeats values already filled in.
  for (int k = 0; k < margin; ++k) {
    row[-1 - k] = row[width - 1 - k];
    row[width + k] = row[k];
  }
}
/// The row used for row y. border_row: a row of border values.
template <class Storage>
const Storage* row_at(const Image& plane, const Image& border_row, Address address, int y) {
  const int height = plane.height();
  if (0 <= y && y < height) return plane.row<Storage>(y);
  if (address == Address::border) return border_row.row<Storage>(0);
  if (address == Address::repeat) return plane.row<Storage>(((y % height) + height) % height);
  return plane.row<Storage>(y < 0 ? 0 : height - 1);
}

/// The channels of a captured image in their storage type, margins filled.
struct Planes {
  std::vector<Image> channels;
  Image border_row;
  Address address = Address::clamp;

  Planes() = default;
  explicit Planes(const capture::CaseInput& input);
};
/// The planes as a text sees them from row y.
struct PlanesPointer {
  const Planes* planes = nullptr;
  int y = 0;
  PlanesPointer(In) {}
  /// The row dy rows away, readable for Image::left_margin texels beyond both ends.
  template <class Storage>
  const Storage* row(int channel, int dy) const {
    return row_at<Storage>(planes->channels[static_cast<std::size_t>(channel)], planes->border_row, planes->address, y + dy);
  }
  /// Calls f(Storage()) with the type of the channels.
  template <class F>
  void in_storage(const F& f) const {
    pass::in_storage(planes->channels.front().format(), f);
  }
};

}  // namespace rainref::pass
