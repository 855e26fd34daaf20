#include "windshield/motion/panes.h"

#include <fmt/format.h>

#include "base/number_text.h"
#include "rainref/error.h"
#include "scene/rows_of_text.h"

namespace rainref::windshield {
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
