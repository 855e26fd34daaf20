#include "scene/test_card.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "math/constants.h"
#include "math/real64.h"
#include "rainref/error.h"

namespace rainref::scene {
namespace {

constexpr double wall = 7.5, roof = 9, tile_side = 1.5, horizon = 2000;  // m

/// A tile's radiance: an integer times a power of two, so that nothing is rounded.
Vector3 radiance_of(double along, double across, int surface) {
  const auto i = static_cast<std::int64_t>(std::floor(along / tile_side + 0.25)) & 0xff,
             j = static_cast<std::int64_t>(std::floor(across / tile_side + 0.25)) & 0xff;
  const double light = (3 * i + 5 * j + surface) % 13 == 4 ? 0.5 : 0.015625;
  Vector3 out;
  for (int k = 0; k < 3; ++k) out[k] = light * static_cast<double>(1 + (7 * i + 11 * j + 5 * k + 3 * surface) % 17);
  return out;
}
void put(Image& image, int x, int y, const Vector3& rgb) {
  float* const to = image.row<float>(y) + 4 * x;
  for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(rgb[k]);
  to[3] = 1;
}

}  // namespace

std::shared_ptr<const Scenery> TestCard::make(const SceneryOptions&) { return std::make_shared<const TestCard>(); }

Scenery::Sight TestCard::look(const Vector3& origin, const Vector3& direction) const {
  constexpr double none = std::numeric_limits<double>::infinity();
  const double down = direction.y < 0 ? -origin.y / direction.y : none;
  const double side = direction.x < 0 ? -wall : wall;
  const double aside = direction.x < 0 || direction.x > 0 ? (side - origin.x) / direction.x : none;
  const double height = origin.y + aside * direction.y;
  if (aside > 0 && aside < down && aside < horizon && height >= 0 && height < roof) {
    const double z = origin.z + aside * direction.z;
    return {radiance_of(z, height, direction.x < 0 ? 1 : 2), aside};
  }
  if (down > 0 && down < horizon) return {radiance_of(origin.z + down * direction.z, origin.x + down * direction.x, 0), down};
  const double up = direction.y < 0 ? 0 : direction.y;
  return {Vector3(0.03, 0.025, 0.0375) * (1.25 - up), none};
}

Image TestCard::panorama(int width, int height, const Vector3& eye, const parallel::Executor& executor) const {
  Image out(Format::rgba32f, width, height);
  executor.for_tiles(width, height, width, 8, [&](const parallel::Tile& t) {
    for (int y = t.y0; y < t.y1; ++y) {
      const Real64 elevation(pi * ((y + 0.5) / height - 0.5));
      const double level = cos_real(elevation).v;
      for (int x = t.x0; x < t.x1; ++x) {
        const Real64 azimuth(2 * pi * ((x + 0.5) / width - 0.5));
        put(out, x, y, look(eye, {level * cos_real(azimuth).v, sin_real(elevation).v, level * sin_real(azimuth).v}).radiance);
      }
    }
  });
  return out;
}

Scenery::View TestCard::view(const Camera& camera, int width, int height, double far, const parallel::Executor& executor, Parts) const {
  if (!(far > 0 && far < 1e300)) throw Error(ExitCode::usage, fmt::format("far: expected a positive distance in metres, found {}", far));
  const Camera::Basis basis = camera.basis();
  const double half_height = camera.half_height(), half_width = half_height * width / height;
  View out{Image(Format::rgba32f, width, height), Image(Format::r32f, width, height)};
  executor.for_tiles(width, height, width, 8, [&](const parallel::Tile& t) {
    for (int y = t.y0; y < t.y1; ++y) {
      for (int x = t.x0; x < t.x1; ++x) {
        const double u = half_width * ((2 * x + 1.0) / width - 1), v = half_height * ((2 * y + 1.0) / height - 1);
        const Vector3 direction = normalized(basis.forward + u * basis.right + v * basis.up);
        const Sight seen = look(camera.position, direction);
        const double depth = seen.distance * dot(direction, basis.forward);
        put(out.colour, x, y, seen.radiance);
        out.depth.row<float>(y)[x] = static_cast<float>(depth < far ? depth : far);
      }
    }
  });
  return out;
}

}  // namespace rainref::scene
