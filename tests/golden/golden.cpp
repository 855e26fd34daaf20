// Prints every golden line; scripts/accept_golden writes them to tests/golden/hashes.txt.
#include <fmt/format.h>

#include "puddle/golden_scenes.h"
#include "rainy_glass/golden_scenes.h"
#include "windshield/golden_scenes.h"

int main() {
  const rainref::parallel::Executor executor;
  for (const auto& scene : rainref::puddle::golden_scenes()) {
    for (const std::string& line : rainref::puddle::golden_lines(scene, executor)) fmt::print("{}\n", line);
  }
  for (const auto& scene : rainref::windshield::golden_scenes()) {
    for (const std::string& line : rainref::windshield::golden_lines(scene, executor)) fmt::print("{}\n", line);
  }
  for (const auto& scene : rainref::rainy_glass::golden_scenes()) {
    for (const std::string& line : rainref::rainy_glass::golden_lines(scene, executor)) fmt::print("{}\n", line);
  }
}
