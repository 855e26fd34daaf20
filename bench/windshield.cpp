// Speed of the windshield's picture through the shells that users run. What a row says: README.md.
#include <memory>
#include <string>

#include "pass_row.h"
#include "rainref/windshield.h"
#include "scene/toml.h"
#include "thread_counts.h"
#include "windshield/instance.h"
#include "windshield/parameters.h"

namespace rainref::windshield {
namespace {

constexpr int picture_tile_rows = 8;  // as windshield.cpp cuts its work

// A second of rain wets the glass. Google Benchmark asks for a row several times, with more goes each time: the last one is kept.
Windshield& wet_windshield(const std::string& variant, int width, int height, int threads) {
  struct Made {
    Made(std::string name, int threads) : of(std::move(name)), executor(threads) {}
    std::string of;
    parallel::Executor executor;
    std::unique_ptr<Windshield> windshield;
  };
  static std::unique_ptr<Made> made;
  const std::string of = fmt::format("{} {}x{} {}", variant, width, height, threads);
  if (made && made->of == of) return *made->windshield;
  made.reset();
  made = std::make_unique<Made>(of, threads);
  const auto own = parameters();
  const scene::EffectTable table{{{"windshield", {"as-published", "corrected"}, {own.begin(), own.end()}}}};
  const scene::Config config = scene::parse(fmt::format("effect = 'windshield'\nvariant = '{}'\nseed = 7\n", variant), "bench",
                                            {fmt::format("run.size=[{}, {}]", width, height)}, table);
  made->windshield = std::make_unique<Windshield>(config, surroundings_of(bench::integers(width, height)), made->executor);
  for (int frame = 0; frame < 60; ++frame) {
    made->windshield->simulate();
    made->windshield->render();
  }
  made->windshield->simulate();
  return *made->windshield;
}

void picture(benchmark::State& state, const std::string& variant, const std::string& pass, bench::Traffic traffic, int height,
             int threads) {
  const int width = height * 16 / 9;
  Windshield& windshield = wet_windshield(variant, width, height, threads);
  bench::pass_row(state, parallel::Executor(threads), width, height, picture_tile_rows, pass, traffic,
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
