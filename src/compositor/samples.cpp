#include "compositor/samples.h"

#include <array>

#include <fmt/format.h>

#include "rainref/error.h"

namespace rainref::compositor {
namespace {

// Sixteenths of a pixel from its centre. Source: Direct3D 11, D3D11_STANDARD_MULTISAMPLE_PATTERN; the Vulkan
// specification lists the same as its standard sample locations.
template <std::size_t n>
std::array<Sample, n> sixteenths(const int (&table)[n][2]) {
  std::array<Sample, n> out{};
  for (std::size_t i = 0; i < n; ++i) out[i] = {table[i][0] / 16.0, table[i][1] / 16.0};
  return out;
}
constexpr int one[][2] = {{0, 0}};
constexpr int four[][2] = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
constexpr int eight[][2] = {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
constexpr int sixteen[][2] = {{1, 1},  {-1, -3}, {-3, 2},  {4, -1}, {-5, -2}, {2, 5},  {5, 3}, {3, -5},
                              {-2, 6}, {0, -7},  {-4, -6}, {-6, 4}, {-8, 0},  {7, -4}, {6, 7}, {-7, -8}};

}  // namespace

std::span<const Sample> samples(int count) {
  static const auto a = sixteenths(one);
  static const auto b = sixteenths(four);
  static const auto c = sixteenths(eight);
  static const auto d = sixteenths(sixteen);
  switch (count) {
    case 1:
      return a;
    case 4:
      return b;
    case 8:
      return c;
    case 16:
      return d;
    default:
      throw Error(ExitCode::usage, fmt::format("compositor.samples: expected 1, 4, 8 or 16, found {}", count));
  }
}

}  // namespace rainref::compositor
