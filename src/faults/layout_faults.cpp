// How the bytes of a finished image lie: rows of another pitch, half a turn.
#include <algorithm>
#include <cstring>
#include <set>
#include <string>

#include "faults/generators.h"
#include "faults/image_faults.h"
#include "judge/rearrange.h"

namespace rainref::faults {
namespace {

using capture::Array;

/// Bytes from row to row that devices and APIs choose for rows of so many bytes.
std::set<std::size_t> usual_pitches(std::size_t row, std::size_t texel) {
  std::set<std::size_t> out;
  const auto add = [&](std::size_t multiple) {
    const std::size_t pitch = (row + multiple - 1) / multiple * multiple;
    if (pitch > row && pitch % texel == 0) out.insert(pitch);
  };
  for (const std::size_t bytes : {16, 32, 64, 128, 256, 512, 1024, 4096}) add(bytes);
  for (const std::size_t texels : {4, 8, 16, 32, 64, 128}) add(texels * texel);
  std::size_t texels = 1;
  while (texels * texel < row) texels *= 2;
  add(texels * texel);
  return out;
}

/// Memory whose rows lie `pitch` bytes apart, zeros between, copied as if they followed each other.
void take_as_tight(Array& a, std::size_t pitch) {
  const std::vector<std::byte> right = a.levels[0];
  std::vector<std::byte>& out = a.levels[0];
  const std::size_t row = static_cast<std::size_t>(a.width) * a.element_bytes();
  std::fill(out.begin(), out.end(), std::byte{0});
  for (std::size_t y = 0; y * pitch < out.size(); ++y)
    std::memcpy(out.data() + y * pitch, right.data() + y * row, std::min(row, out.size() - y * pitch));
}
/// Memory without padding, copied as if its rows lay `pitch` bytes apart. Behind its end are zeros.
void take_as_padded(Array& a, std::size_t pitch) {
  const std::vector<std::byte> right = a.levels[0];
  std::vector<std::byte>& out = a.levels[0];
  const std::size_t row = static_cast<std::size_t>(a.width) * a.element_bytes();
  std::fill(out.begin(), out.end(), std::byte{0});
  for (std::size_t y = 0; y * row < out.size() && y * pitch < right.size(); ++y)
    std::memcpy(out.data() + y * row, right.data() + y * pitch, std::min(row, right.size() - y * pitch));
}

}  // namespace

void add_layout_faults(std::vector<Fault>& out, const capture::PassCase& c, const std::vector<Array>& port) {
  std::set<std::size_t> pitches;  // of all images
  for (const std::size_t o : enveloped_images(c)) {
    const Array& a = c.outputs[o].array;
    pitches.merge(usual_pitches(static_cast<std::size_t>(a.width) * a.element_bytes(), a.element_bytes()));
  }
  const auto has = [](const Array& a, std::size_t pitch) {
    const std::size_t row = static_cast<std::size_t>(a.width) * a.element_bytes();
    return usual_pitches(row, a.element_bytes()).contains(pitch);
  };
  const auto row_text = [](const Array& a) { return std::to_string(static_cast<std::size_t>(a.width) * a.element_bytes()); };
  for (const std::size_t pitch : pitches) {
    const auto add = [&](Kind kind, void (*relaid)(Array&, std::size_t)) {
      add_to_images(
          out, c, port,
          [=](const Array& a) {
            return What{kind, {std::to_string(pitch), row_text(a)}};
          },
          [=](Array& a, const Array&) {
            if (!has(a, pitch)) return false;
            relaid(a, pitch);
            return true;
          });
    };
    add(Kind::rows_taken_as_tight, take_as_tight);
    add(Kind::rows_taken_as_padded, take_as_padded);
  }
  add_to_images(out, c, port, Kind::half_a_turn, [](Array& a, const Array&) {
    judge::flip_rows(a);
    judge::flip_columns(a);
    return true;
  });
}

}  // namespace rainref::faults
