#include "windshield/motion/glass.h"

#include <fmt/format.h>

#include "base/number_text.h"
#include "rainref/error.h"
#include "scene/rows_of_text.h"

namespace rainref::windshield {
namespace {

Real3 minus(const Real3& a, const Real3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double length(const Real3& a) { return __builtin_sqrt(dot(a, a)); }
std::string place_text(const Real3& a) { return fmt::format("[{:g}, {:g}, {:g}]", a[0], a[1], a[2]); }

}  // namespace

double dot(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Real3 cross(const Real3& a, const Real3& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }

Glass make_glass(const Corners& corners, std::string_view keys) {
  Glass g{};
  g.origin = corners[0];
  g.e_u = minus(corners[1], corners[0]);
  g.e_v = minus(corners[2], corners[0]);
  const Real3 across = cross(g.e_u, g.e_v);
  const double determinant = dot(across, across);  // determinant of the metric, without cancellation
  g.area = __builtin_sqrt(determinant);
  if (!(g.area > 1e-6 * length(g.e_u) * length(g.e_v))) {
    throw Error(ExitCode::usage, fmt::format("{}: expected three corners of a plane, found {}, {}, {}, which lie on one line", keys,
                                             place_text(corners[0]), place_text(corners[1]), place_text(corners[2])));
  }
  // Seen from inside, u runs to the right and v up, so their cross product points into the car.
  g.normal = {0 - across[0] / g.area, 0 - across[1] / g.area, 0 - across[2] / g.area};
  g.metric = {dot(g.e_u, g.e_u), dot(g.e_u, g.e_v), dot(g.e_v, g.e_v)};
  g.inverse_metric = {g.metric[2] / determinant, (0 - g.metric[1]) / determinant, g.metric[0] / determinant};
  return g;
}

PlaneFrame Glass::plane() const {
  const double width = length(e_u), f1 = metric[1] / width, f2 = area / width;
  return {{width, f1, f2}, {1 / width, (0 - f1) / area, 1 / f2}};
}
PlaneFrame Glass::axes() const {
  const double width = length(e_u), height = length(e_v);
  return {{width, 0, height}, {1 / width, 0, 1 / height}};
}

namespace {

constexpr double largest_coordinate = 100;  // m, as windshield.corner_0

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

}  // namespace rainref::windshield
