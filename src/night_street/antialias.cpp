#include "night_street/antialias.h"

#include <vector>

namespace rainref::night_street {

namespace {

constexpr int tile_side = 32;

/// The first pass: radiance and object at the centre of every texel.
struct Centres {
  int width, height;
  std::vector<Vec> radiance;
  std::vector<float> tone;  ///< brightness as an eye would rank it, in [0, 1)
  std::vector<std::uint32_t> object;
  std::vector<std::uint8_t> is_ground;
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

float tone_of(const Vec& radiance) {
  const double level = 3 * max_of(max_of(radiance.x, radiance.y), radiance.z);
  return static_cast<float>(std::sqrt(level / (1 + level)));
}

bool differs(const Centres& centres, int x, int y, Edge edge) {
  const std::size_t here = centres.index(x, y);
  // Wet ground glitters; more rays would buy little there.
  const float tolerance = centres.is_ground[here] ? 0.16f : 0.1f;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      int nx = x + i;
      const int ny = y + j;
      if (ny < 0 || ny >= centres.height) continue;
      if (edge == Edge::wrap) nx = (nx + centres.width) % centres.width;
      if (nx < 0 || nx >= centres.width) continue;
      const std::size_t there = centres.index(nx, ny);
      if (centres.object[here] != centres.object[there]) return true;
      const float step = centres.tone[here] - centres.tone[there];
      if (step > tolerance || step < -tolerance) return true;
    }
  }
  return false;
}

}  // namespace

Image antialiased(const City& city, int width, int height, Edge edge, Parts parts, const RayOfPart& ray_of, const AtCentre& at_centre,
                  const parallel::Executor& executor) {
  Image image(Format::rgba32f, width, height);
  const std::size_t texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Centres centres{width,
                  height,
                  std::vector<Vec>(texels),
                  std::vector<float>(texels),
                  std::vector<std::uint32_t>(texels),
                  std::vector<std::uint8_t>(texels)};
  executor.for_tiles(width, height, tile_side, tile_side, [&](const parallel::Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        const Ray ray = ray_of(3 * x + 1, 3 * y + 1);
        const Seen seen = look(city, ray);
        const std::size_t here = centres.index(x, y);
        centres.radiance[here] = seen.radiance;
        centres.tone[here] = tone_of(seen.radiance);
        centres.object[here] = seen.hit.object();
        centres.is_ground[here] = seen.hit.kind == Hit::road || seen.hit.kind == Hit::pavement;
        at_centre(x, y, ray, seen);
      }
    }
  });
  executor.for_tiles(width, height, tile_side, tile_side, [&](const parallel::Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      float* out = image.row<float>(y) + static_cast<std::ptrdiff_t>(tile.x0) * 4;
      for (int x = tile.x0; x < tile.x1; ++x, out += 4) {
        Vec radiance = centres.radiance[centres.index(x, y)];
        if (differs(centres, x, y, edge)) {
          Vec sum = radiance;
          const bool three = parts == Parts::three;
          for (int part = 0; part < 9; part += three ? 4 : 1) {
            if (part != 4) sum = sum + look(city, ray_of(3 * x + part % 3, 3 * y + part / 3)).radiance;
          }
          radiance = (three ? 1.0 / 3 : 1.0 / 9) * sum;
        }
        out[0] = static_cast<float>(radiance.x);
        out[1] = static_cast<float>(radiance.y);
        out[2] = static_cast<float>(radiance.z);
        out[3] = 1;
      }
    }
  });
  return image;
}

}  // namespace rainref::night_street
