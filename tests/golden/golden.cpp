// Prints every golden line; scripts/accept_golden writes them to tests/golden/hashes.txt.
#include <fmt/format.h>

#include "truth/golden_scenes.h"
#include "edge_splash/golden_scenes.h"
#include "puddle/golden_scenes.h"
#include "rainy_glass/golden_scenes.h"
#include "screen_drops/golden_scenes.h"
#include "windshield/golden_scenes.h"

int main() {
  const rainref::parallel::Executor executor;
  const auto print = [](const std::vector<std::string>& lines) {
    for (const std::string& line : lines) fmt::print("{}\n", line);
  };
  for (const auto& scene : rainref::puddle::golden_scenes()) print(rainref::puddle::golden_lines(scene, executor));
  for (const auto& scene : rainref::windshield::golden_scenes()) print(rainref::windshield::golden_lines(scene, executor));
  for (const auto& scene : rainref::edge_splash::golden_scenes()) print(rainref::edge_splash::golden_lines(scene, executor));
  for (const auto& scene : rainref::screen_drops::golden_scenes()) print(rainref::screen_drops::golden_lines(scene, executor));
  for (const auto& scene : rainref::rainy_glass::golden_scenes()) print(rainref::rainy_glass::golden_lines(scene, executor));
  for (const auto& scene : rainref::truth::golden_scenes()) print(rainref::truth::golden_lines(scene, executor));
}
