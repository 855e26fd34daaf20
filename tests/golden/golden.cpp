// Prints every golden line; scripts/accept_golden writes them to tests/golden/hashes.txt. With arguments, those of these effects alone
// ("compositor": traced pictures).
#include <algorithm>

#include "golden/scenes.h"

int main(int argc, char** argv) {
  const rainref::parallel::Executor executor;
  const std::vector<std::string> wanted(argv + 1, argv + argc);
  for (const auto& [name, scenes] : rainref::golden::scenes()) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), name) == wanted.end()) continue;
    for (const rainref::golden::Scene& scene : scenes) {
      for (const std::string& line : scene.lines(executor, 60, rainref::golden::call_plainly)) fmt::print("{}\n", line);
    }
  }
}
