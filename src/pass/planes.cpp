#include "pass/planes.h"

#include "capture/bound_texture.h"

namespace rainref::pass {
namespace {

Half stored(float x, Half) { return to_half(x); }
float stored(float x, float) { return x; }
Unorm8 stored(float x, Unorm8) { return to_unorm8(x); }
constexpr Format format_of(Half) { return Format::r16f; }
constexpr Format format_of(float) { return Format::r32f; }
constexpr Format format_of(Unorm8) { return Format::r8; }

template <class Storage>
void fill(const capture::CaseInput& input, Planes& to) {
  const Format format = format_of(Storage());
  const capture::Array& a = input.array;
  const auto* from = reinterpret_cast<const Storage*>(a.levels.at(0).data());
  const Storage border = stored(input.border[0], Storage());
  const int channels = info(a.format).channels;
  for (int c = 0; c < channels; ++c) {
    Image& plane = to.channels.emplace_back(format, a.width, a.height);
    for (int y = 0; y < a.height; ++y) {
      Storage* row = plane.row<Storage>(y);
      for (int x = 0; x < a.width; ++x) row[x] = from[(static_cast<std::ptrdiff_t>(y) * a.width + x) * channels + c];
      fill_margins(row, a.width, input.address_u, border);
    }
  }
  to.border_row = Image(format, a.width, 1);
  Storage* row = to.border_row.row<Storage>(0);
  std::fill(row - Image::left_margin, row + a.width + Image::left_margin, border);
}

}  // namespace

Planes::Planes(const capture::CaseInput& input) : address(input.address_u) {
  capture::require_certain(input);
  in_storage(input.array.format, [&]<class Storage>(Storage) { fill<Storage>(input, *this); });
}

}  // namespace rainref::pass
