#include "windshield/memory.h"

#include <algorithm>
#include <cmath>

#include "base/floating_point.h"
#include "drops/host.h"
#include "drops/memory.h"
#include "night_street/memory.h"
#include "rainref/windshield.h"
#include "windshield/street.h"

namespace rainref::windshield {
namespace {

/// Drops that arrive in so many frames, of which there is room for some.
std::int64_t most_drops(const Settings& s, const Vehicle& vehicle, int frames) {
  double arrivals = s.drops.spawn_rate * frames / s.fps;
  if (s.corrected) {
    const Glass glass = make_glass(s.corners);
    arrivals = 0;
    // In parts of the run of about a second: the flux is a sum over sizes, and a car's speed changes slowly.
    const int parts = std::max(1, static_cast<int>(frames / s.fps));
    for (int k = 0; k < parts; ++k) {
      const VehicleState car = vehicle.at((k + 0.5) / parts * frames / s.fps);
      const Real3 apparent{s.wind[0] - car.velocity[0], s.wind[1] - car.velocity[1], s.wind[2] - car.velocity[2]};
      const Real3 in_car{car.direction[0] * apparent[0] + car.direction[1] * apparent[1],
                         car.direction[0] * apparent[1] - car.direction[1] * apparent[0], apparent[2]};
      arrivals += drops::flux(s.drops, glass.normal[2], dot(in_car, glass.normal)).drops * glass.area * frames / s.fps / parts;
    }
  }
  return static_cast<std::int64_t>(std::min(std::ceil(arrivals), static_cast<double>(s.drops.capacity)));
}

}  // namespace

MemoryPeak memory(const Settings& s, int frames, std::array<int, 2> scene) {
  const Vehicle vehicle(s.vehicle);
  const auto image = [](Format f, int width, int height) { return Image::memory_bytes(f, width, height); };
  const int columns = s.surface.width, rows = s.surface.height;
  MemoryPeak m;
  const MemoryPeak dry = drops::memory(s.drops, columns, rows, 0),
                   wet = drops::memory(s.drops, columns, rows, most_drops(s, vehicle, frames));
  m.hold(dry.held());
  m.hold(2 * image(Format::r16f, columns, rows) + image(Format::rgba16f, columns, rows) +
         (s.corrected ? image(Format::r32f, columns, rows) : 0));  // height, mask, normal, wiped
  m.hold(image(Format::rgba16f, s.picture.width, s.picture.height) + image(Format::rgba8, s.picture.width, s.picture.height));
  const bool own = scene[0] == 0;
  const auto [width, height] = own ? s.scene_size : scene;
  const std::size_t half = image(Format::rgba16f, width, height), view = half + image(Format::r32f, width, height);
  MemoryPeak rendered = night_street::view_memory(width, height);
  rendered.pass(half);
  const bool moves = own && s.scene_moves;
  if (own && !moves) m.pass(rendered.peak());
  m.hold(view);
  // Two pictures of the street, of which the view is made: at the start one alone, for there is no way yet. A car that comes to the next
  // one has both while that is rendered.
  const double apart = StreetDrive::spacing / s.keyframes, way = vehicle.at((frames - 1) / s.fps).distance;
  if (moves) {
    m.pass(rendered.peak());
    m.hold(view);
  }
  std::size_t texels = 0;
  for (int l = 0; l < std::min(s.blur.levels, blur_pyramid::level_count(width, height)); ++l) {
    const auto [w, h] = blur_pyramid::level_size(width, height, l);
    m.hold(image(Format::rgba16f, w, h));
    texels += static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
  }
  m.hold(4 * sizeof(Half) * texels);  // as they are looked up
  m.pass(wet.peak() - dry.held());
  m.hold(wet.held() - dry.held());
  if (moves && way > 0) {
    m.pass(rendered.peak());
    m.hold(view);
  }
  if (moves && way > apart) m.pass(rendered.peak());
  return m;
}

std::size_t memory_bytes(const scene::Config& config) {
  const FloatingPointGuard guard;
  return memory(settings_from(config), static_cast<int>(config.integer("run.frames"))).peak();
}

}  // namespace rainref::windshield
