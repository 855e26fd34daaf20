// Prints every golden line; scripts/accept_golden writes them to tests/golden/hashes.txt. With arguments, those of these effects alone
// ("compositor": traced pictures).
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "truth/golden_scenes.h"
#include "edge_splash/golden_scenes.h"
#include "puddle/golden_scenes.h"
#include "rainy_glass/golden_scenes.h"
#include "screen_drops/golden_scenes.h"
#include "windshield/golden_scenes.h"

int main(int argc, char** argv) {
  const rainref::parallel::Executor executor;
  const std::vector<std::string> wanted(argv + 1, argv + argc);
  const auto print = [&](const char* name, const auto& scenes) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), name) == wanted.end()) return;
    for (const auto& scene : scenes()) {
      for (const std::string& line : golden_lines(scene, executor)) fmt::print("{}\n", line);
    }
  };
  print("puddle", rainref::puddle::golden_scenes);
  print("windshield", rainref::windshield::golden_scenes);
  print("edge_splash", rainref::edge_splash::golden_scenes);
  print("screen_drops", rainref::screen_drops::golden_scenes);
  print("rainy_glass", rainref::rainy_glass::golden_scenes);
  print("compositor", rainref::truth::golden_scenes);
}
