#include "windshield/panes.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/number_text.h"
#include "rainref/error.h"
#include "scene/rows_of_text.h"

namespace rainref::windshield {
namespace {

constexpr double largest_coordinate = 100;  // m, as windshield.corner_0
constexpr int fewest_texels = 8, most_texels = 16384;
// Odd, so that panes of one scene, and of scenes with seeds beside one another, draw other numbers.
constexpr std::uint64_t next_seed = 0x9e3779b97f4a7c15;

int texels(double of_windshield, double metres, double metres_of_windshield) {
  return std::clamp(static_cast<int>(of_windshield * metres / metres_of_windshield + 0.5), fewest_texels, most_texels);
}

}  // namespace

std::string pane_name(int number) { return number == 0 ? "the glass" : fmt::format("windshield.panes, pane {}", number); }

std::vector<Corners> parse_panes(std::string_view text) {
  std::vector<Corners> panes;
  for (const std::string_view pane : scene::split(text, ';')) {
    if (pane.empty()) continue;
    const auto fail = [&] {
      throw Error(ExitCode::usage, fmt::format("{}: expected \"x y z, x y z, x y z\", numbers of at most {:g} m, found '{}'",
                                               pane_name(static_cast<int>(panes.size()) + 1), largest_coordinate, pane));
    };
    const std::vector<std::string_view> points = scene::split(pane, ',');
    if (points.size() != 3) fail();
    Corners corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::vector<std::string_view> numbers = scene::words_of(points[i]);
      if (numbers.size() != 3) fail();
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = number_from<double>(numbers[k]).value_or(2 * largest_coordinate);
        if (!(-largest_coordinate <= x && x <= largest_coordinate)) fail();
        corners[i][k] = x;
      }
    }
    panes.push_back(corners);
    make_glass(corners, pane_name(static_cast<int>(panes.size())));  // refuses corners on a line
  }
  return panes;
}

Settings settings_of_pane(const Settings& car, int number) {
  Settings s = car;
  if (number == 0) return s;
  s.corners = car.panes[static_cast<std::size_t>(number) - 1];
  const Glass glass = make_glass(s.corners, pane_name(number)), windshield = make_glass(car.corners);
  const PaneWipers& own = car.pane_wipers[static_cast<std::size_t>(number) - 1];
  s.wipers = own.wipers;
  s.capture = own.capture;
  s.surface.half_width = own.wipers.half_width;
  s.drops.seed += static_cast<std::uint64_t>(number) * next_seed;
  s.drops_share = glass.area / windshield.area;
  s.drops.spawn_rate *= s.drops_share;
  const PlaneFrame plane = s.corrected ? glass.plane() : glass.axes(), of_windshield = s.corrected ? windshield.plane() : windshield.axes();
  s.surface.frame = s.splat.frame = plane.frame;
  s.surface.width = s.splat.keys.width = texels(car.surface.width, plane.frame[0], of_windshield.frame[0]);
  s.surface.height = s.splat.keys.height = texels(car.surface.height, plane.frame[2], of_windshield.frame[2]);
  return s;
}

}  // namespace rainref::windshield
