#include "simulation/supersampling.h"

#include <cstdint>
#include <span>

#include <fmt/format.h>

#include "rainref/error.h"
#include "simulation/light_mean.h"

namespace rainref::simulation {

scene::Config config_at_pass_size(const scene::Config& config) {
  const std::int64_t n = config.integer("run.supersample");
  const scene::Config::Entry& e = config.entry("run.size");
  scene::Integer2 size = config.integer2("run.size");
  for (std::int64_t& side : size) {
    side *= n;
    if (static_cast<double>(side) > e.parameter.maximum)
      throw Error(ExitCode::usage, fmt::format("run.supersample: expected at most {:.0f} texels a side of run.size times it, found {}",
                                               e.parameter.maximum, side));
  }
  scene::Config larger = config;
  larger.set("run.size", size, e.origin);
  return larger;
}

Image tent_mean(const Image& picture, int n, const parallel::Executor& executor) {
  const auto row_of = [&](int y, std::span<double> light) {
    const Unorm8* row = picture.row<Unorm8>(y);
    for (std::size_t x = 0; x < light.size() / 3; ++x)
      for (std::size_t c = 0; c < 3; ++c) light[3 * x + c] = light_of(row[4 * x + c].code);
  };
  const auto codes_of = [](int, int, const double* light, std::uint8_t* codes) {
    for (int c = 0; c < 3; ++c) codes[c] = nearest_code(light[c]);
  };
  return picture_of_means(picture.width() / n, picture.height() / n, n, row_of, codes_of, executor);
}

}  // namespace rainref::simulation
