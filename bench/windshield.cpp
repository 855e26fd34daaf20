// Speed of the windshield's picture through the shells that users run. What a row says: README.md.
#include <string>

#include "pass_row.h"
#include "rainref/windshield.h"
#include "scene/toml.h"
#include "thread_counts.h"
#include "windshield/scene_images.h"
#include "windshield/scene_keys.h"

namespace rainref::windshield {
namespace {

constexpr int picture_tile_rows = 8;  // as windshield.cpp cuts its work

void picture(benchmark::State& state, const std::string& variant, const std::string& pass, bench::Traffic traffic, int height,
             int threads) {
  const parallel::Executor executor(threads);
  const auto own = parameters();
  const scene::EffectTable table{{{"windshield", {"as-published", "corrected"}, {own.begin(), own.end()}}}};
  const int width = height * 16 / 9;
  const scene::Config config = scene::parse(fmt::format("effect = 'windshield'\nvariant = '{}'\nseed = 7\n", variant), "bench",
                                            {fmt::format("run.size=[{}, {}]", width, height)}, table);
  Windshield windshield(config, {opaque_half(bench::integers(width, height)), far_depth(width, height)}, executor);
  // A second of rain wets the glass.
  for (int frame = 0; frame < 60; ++frame) {
    windshield.simulate();
    windshield.render();
  }
  windshield.simulate();
  bench::pass_row(state, executor, width, height, picture_tile_rows, pass, traffic,
                  [&](Recorder* recorder) { windshield.render(recorder); });
}

const bool registered = [] {
  // A texel each of normal, height, mask, the scene's colour and, corrected, its depth.
  for (const std::string variant : {"as-published", "corrected"}) {
    for (const int height : {720, 1080}) {
      for (const int threads : bench::thread_counts()) {
        benchmark::RegisterBenchmark(fmt::format("composite/{}/{}x{}/threads:{}", variant, height * 16 / 9, height, threads).c_str(),
                                     [=](benchmark::State& state) {
                                       picture(state, variant, "composite", {variant == "corrected" ? 24 : 20, 8}, height, threads);
                                     })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace rainref::windshield
