#include "image_io/quantity.h"

#include <cstdint>
#include <type_traits>

#include <fmt/format.h>

#include "math/half.h"
#include "rainref/error.h"

namespace rainref::image_io {
namespace {

template <class T>
float number_of(T stored) {
  if constexpr (std::is_same_v<T, Half>)
    return to_float(stored);
  else
    return stored;
}

template <class T>
void require_alike_of(std::string_view file, const Image& image, const std::array<std::string, 3>& names) {
  std::size_t first = 0;
  while (first < 3 && names[first].empty()) ++first;
  for (int y = 0; y < image.height(); ++y) {
    const T* texel = image.row<T>(y);
    for (int x = 0; x < image.width(); ++x, texel += 4) {
      for (std::size_t k = first + 1; k < 3; ++k) {
        if (names[k].empty() || names[k] == names[first]) continue;
        const float a = number_of(texel[first]), b = number_of(texel[k]);
        if (a == b) continue;
        throw Error(ExitCode::usage,
                    fmt::format("{}: expected one quantity, found {} {} beside {} {} at x {}, y {} (from the top); save one channel alone, "
                                "or a depth as channel Z",
                                file, names[first], a, names[k], b, x, y));
      }
    }
  }
}

}  // namespace

void require_alike(std::string_view file, const Image& image, const std::array<std::string, 3>& names) {
  switch (image.format()) {
    case Format::rgba8:
      return require_alike_of<std::uint8_t>(file, image, names);
    case Format::rgba16f:
      return require_alike_of<Half>(file, image, names);
    default:
      return require_alike_of<float>(file, image, names);
  }
}

}  // namespace rainref::image_io
