#include "night_street/antialias.h"

#include <memory>

namespace rainref::night_street {

namespace {

constexpr int tile_side = 32;

/// The result at the centre of a texel.
struct Centre {
  double radiance[3];
  float tone;  ///< perceived brightness, in [0, 1)
  std::uint32_t object;
  bool is_ground;
};
/// The first pass. Its memory is first touched by the threads that fill it, because one thread alone would take as long for that as all of
/// them for their rays.
struct Centres {
  int width, height;
  std::unique_ptr<Centre[]> all =
      std::make_unique_for_overwrite<Centre[]>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  Centre& at(int x, int y) const {
    return all[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

float tone_of(const Vec& radiance) {
  const double level = 3 * max_of(max_of(radiance.x, radiance.y), radiance.z);
  return static_cast<float>(std::sqrt(level / (1 + level)));
}

bool differs(const Centres& centres, int x, int y, Edge edge) {
  const Centre& here = centres.at(x, y);
  // Wet ground glitters, and more rays would improve it little.
  const float tolerance = here.is_ground ? 0.16f : 0.1f;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      int nx = x + i;
      const int ny = y + j;
      if (ny < 0 || ny >= centres.height) continue;
      if (edge == Edge::wrap) nx = (nx + centres.width) % centres.width;
      if (nx < 0 || nx >= centres.width) continue;
      const Centre& there = centres.at(nx, ny);
      if (here.object != there.object) return true;
      const float step = here.tone - there.tone;
      if (step > tolerance || step < -tolerance) return true;
    }
  }
  return false;
}

}  // namespace

Image antialiased(const City& city, int width, int height, Edge edge, Parts parts, const RayOfPart& ray_of, const AtCentre& at_centre,
                  const parallel::Executor& executor) {
  Image image(Format::rgba32f, width, height);
  const Centres centres{width, height};
  executor.for_tiles(width, height, tile_side, tile_side, [&](const parallel::Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        const Ray ray = ray_of(3 * x + 1, 3 * y + 1);
        const Seen seen = look(city, ray);
        const Vec& r = seen.radiance;
        const bool is_ground = seen.hit.kind == Hit::road || seen.hit.kind == Hit::pavement;
        centres.at(x, y) = {{r.x, r.y, r.z}, tone_of(r), seen.hit.object(), is_ground};
        at_centre(x, y, ray, seen);
      }
    }
  });
  executor.for_tiles(width, height, tile_side, tile_side, [&](const parallel::Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      float* out = image.row<float>(y) + static_cast<std::ptrdiff_t>(tile.x0) * 4;
      for (int x = tile.x0; x < tile.x1; ++x, out += 4) {
        const double* centre = centres.at(x, y).radiance;
        Vec radiance(centre[0], centre[1], centre[2]);
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
