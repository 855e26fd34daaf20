#include "windshield/parameters.h"

#include <algorithm>
#include <cmath>

#include "base/floating_point.h"
#include "drops/host.h"
#include "rain/rain.h"
#include "rainref/windshield.h"
#include "scene/scenery_memory.h"
#include "windshield/scene/street.h"
#include "windshield/wet_pane.h"

namespace rainref::windshield {
namespace {

/// Number of drops that arrive on a pane in this many frames, limited by the capacity.
std::int64_t most_drops(const Settings& s, const Vehicle& vehicle, const Weather& weather, int frames) {
  const Glass glass = make_glass(s.corners);
  const Shelter shelter(s.weather.shelter, vehicle, middle_of(glass));
  double arrivals = s.drops_share * shelter.rained(weather, frames / s.fps);
  if (s.corrected) {
    arrivals = 0;
    // In parts of about a second of the run, because the flux is a sum over sizes, and speed, wind and rain change slowly.
    const int parts = std::max(1, static_cast<int>(frames / s.fps));
    drops::Settings rain = s.drops;
    const double part = frames / s.fps / parts;
    for (int k = 0; k < parts; ++k) {
      const double t = (k + 0.5) / parts * frames / s.fps;
      const double open = shelter.open_share(k * part, (k + 1) * part);
      rain.rain_rate = weather.rain(t);
      arrivals +=
          drops::flux(rain, glass.normal[2], wind_along_normal(glass, vehicle.at(t), weather.wind(t))).drops * glass.area * open * part;
    }
  }
  return static_cast<std::int64_t>(std::min(std::ceil(arrivals), static_cast<double>(s.drops.capacity)));
}

}  // namespace

double most_falling(const Settings& s, double seconds) {
  if (!s.falling.on) return 0;
  const Weather weather(s.weather);
  double rate = s.corrected ? 0 : s.falling.rate;
  if (s.corrected)
    for (int second = 0; second <= seconds; ++second) rate = std::max(rate, weather.rain(second));
  const double half_height = camera(s.picture).half_height() * s.picture.scene_margin, aspect = 1.0 * s.picture.width / s.picture.height;
  return rain::DropSizes(rate, s.falling.smallest_drop).in_air(s.falling.smallest_drop) * (4.0 / 3) * half_height * half_height * aspect *
         s.falling.far * s.falling.far * s.falling.far;
}

MemoryPeak memory(const Settings& s, int frames, std::array<int, 2> scene) {
  const Vehicle vehicle(s.vehicle);
  const auto image = [](Format f, int width, int height) { return Image::memory_bytes(f, width, height); };
  const Weather weather(s.weather);
  MemoryPeak m;
  std::uint64_t wet_more = 0, wet_most = 0;  // arrivals of drops: on all panes; extra scratch of one pane's passes
  for (int k = 0; k <= static_cast<int>(s.panes.size()); ++k) {
    const Settings of = settings_of_pane(s, k);
    const int columns = of.surface.width, rows = of.surface.height;
    const bool lean = of.splat.keys.lean > 0;
    const MemoryPeak dry = drops::memory(of.drops, columns, rows, 0, lean),
                     wet = drops::memory(of.drops, columns, rows, most_drops(of, vehicle, weather, frames), lean);
    m.hold(dry.held());
    m.hold(2 * image(Format::r16f, columns, rows) + image(Format::rgba16f, columns, rows) +
           (s.corrected ? image(Format::r32f, columns, rows) : 0));  // height, mask, normal, wiped
    if (s.surface.height_tau > 0) m.hold(image(Format::r16f, columns, rows));
    if (s.condensation.on) m.hold(image(Format::r32f, columns, rows) + image(Format::r16f, columns, rows));      // clear_time, condensation
    if (s.smear.on && (k == 0 || !of.wipers.blades.empty())) m.hold(2 * image(Format::rgba16f, columns, rows));  // laid, smear
    wet_more += wet.held() - dry.held();
    wet_most = std::max(wet_most, wet.peak() - wet.held());
  }
  m.hold((s.panes.empty() ? 1 : 2) * image(Format::rgba16f, s.picture.width, s.picture.height) +
         image(Format::rgba8, s.picture.width, s.picture.height));
  if (s.interior.on) m.hold(image(Format::rgba16f, s.picture.width, s.picture.height));
  m.hold(static_cast<std::uint64_t>(most_falling(s, frames / s.fps)) * (sizeof(FallingDrop) + sizeof(Streak)));
  const bool own = scene[0] == 0;
  const auto [width, height] = own ? s.scene_size : scene;
  const std::uint64_t half = image(Format::rgba16f, width, height), view = half + image(Format::r32f, width, height);
  MemoryPeak rendered = scene::view_memory(width, height);
  rendered.pass(half);
  const bool moves = own && s.scene_moves;
  if (own && !moves) m.pass(rendered.peak());
  m.hold(s.shows_blades ? 2 * view : view);
  // The view is made from two pictures of the street; at the start from one, because the car has not moved. A car that reaches the next one
  // has both while that one is rendered.
  const double apart = StreetDrive::spacing / s.keyframes, way = vehicle.at((frames - 1) / s.fps).distance;
  if (moves) {
    m.pass(rendered.peak());
    m.hold(view);
  }
  std::uint64_t texels = 0;
  for (int l = 0; l < std::min(s.blur.levels, blur_pyramid::level_count(width, height)); ++l) {
    const auto [w, h] = blur_pyramid::level_size(width, height, l);
    m.hold(image(Format::rgba16f, w, h));
    texels += static_cast<std::uint64_t>(w) * static_cast<std::uint64_t>(h);
  }
  m.hold(4 * sizeof(Half) * texels);  // as stored for lookups
  m.pass(wet_more + wet_most);
  m.hold(wet_more);
  if (moves && way > 0) {
    m.pass(rendered.peak());
    m.hold(view);
  }
  if (moves && way > apart) m.pass(rendered.peak());
  return m;
}

std::uint64_t memory_bytes(const scene::Config& config) {
  const FloatingPointGuard guard;
  return memory(settings_from(config), static_cast<int>(config.integer("run.frames"))).peak();
}

}  // namespace rainref::windshield
