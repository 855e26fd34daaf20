// Speed of the passes of rainy_glass through the shells that users run. What a row says: README.md.
#include <string>

#include "pass_row.h"
#include "rainref/rainy_glass.h"
#include "rainy_glass/parameters.h"
#include "scene/toml.h"
#include "thread_counts.h"

namespace rainref::rainy_glass {
namespace {

constexpr int picture_tile_rows = 8;  // as rainy_glass.cpp cuts its work

Settings settings(const std::string& variant, const std::string& shape, int width, int height) {
  const scene::EffectTable table{{{"rainy_glass", {"as-published", "corrected"}, parameters()}}};
  return settings_from(scene::parse(fmt::format("effect = 'rainy_glass'\nvariant = '{}'\nseed = 7\n", variant), "bench",
                                    {"glass.shape=" + shape, fmt::format("run.size=[{}, {}]", width, height), "maps.droplets=600"}, table));
}

Surroundings surroundings(const Settings& s) {
  Surroundings around;
  around.colour = bench::integers(s.width, s.height);
  around.depth = Image(Format::r32f, s.width, s.height);
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) around.depth.row<float>(y)[x] = static_cast<float>(2 + (x / 64 + y / 48) % 9);
  }
  return around;
}

void picture(benchmark::State& state, const std::string& variant, const std::string& shape, const std::string& pass, bench::Traffic traffic,
             int height, int threads) {
  const parallel::Executor executor(threads);
  const Settings s = settings(variant, shape, height * 16 / 9, height);
  RainyGlass glass(s, surroundings(s), executor);
  bench::pass_row(state, executor, s.width, s.height, picture_tile_rows, pass, traffic,
                  [&](Recorder* recorder) { glass.next_frame(recorder); });
}

const bool registered = [] {
  for (const std::string variant : {"as-published", "corrected"}) {
    for (const std::string shape : {"pane", "sphere"}) {
      // surface, orientation, the scene's texel and its depth are read, colour is written; the maps come from the caches.
      const std::vector<std::pair<std::string, bench::Traffic>> passes{{"rain_on_glass", {variant == "corrected" ? 36 : 32, 8}},
                                                                       {"display", {8, 4}}};
      for (const auto& [pass, traffic] : passes) {
        if (pass == "display" && shape == "sphere") continue;
        for (const int height : {720, 1080}) {
          for (const int threads : bench::thread_counts()) {
            benchmark::RegisterBenchmark(fmt::format("{}/{}/{}/{}p/threads:{}", pass, variant, shape, height, threads).c_str(),
                                         [=, name = pass, bytes = traffic](benchmark::State& state) {
                                           picture(state, variant, shape, name, bytes, height, threads);
                                         })
                ->UseManualTime()
                ->Unit(benchmark::kMillisecond);
          }
        }
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace rainref::rainy_glass
