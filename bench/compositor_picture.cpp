// The whole picture of a traced puddle: update of the water, tracing, shading. What a row says: README.md.
#include <benchmark/benchmark.h>

#include <algorithm>

#include <fmt/format.h>

#include "capture/hashing.h"
#include "goes.h"
#include "truth/puddle_scene.h"
#include "night_street/night_street.h"
#include "puddle/parameters.h"
#include "scene/toml.h"
#include "stream.h"
#include "thread_counts.h"

namespace rainref::truth {
namespace {

// scenes/puddle/default.toml, whose street is made once for all rows.
struct Street {
  puddle::Settings settings;
  puddle::Surroundings around;
  Street() {
    const scene::EffectTable table{{{"puddle", {"as-published", "corrected"}, puddle::parameters()}}};
    settings =
        puddle::settings_from(scene::parse("effect = 'puddle'\nvariant = 'corrected'\nseed = 7\n", "bench",
                                           {"rain.rate=4", "rain.smallest_drop=2", "puddle.drop_intensity=2", "puddle.damping=0.97",
                                            "camera.position=[0.3, 0.4, 1.6]", "camera.target=[0.1, 0.03, 0]", "run.size=[1280, 720]"},
                                           table));
    around.environment = night_street::Street().panorama(1024, 512, {0, 0.05, 0}, parallel::Executor());
  }
};

void picture(benchmark::State& state, int samples, const std::string& embree_config, int threads) {
  static const Street street;
  const puddle::Settings& s = street.settings;
  const parallel::Executor executor(threads);
  puddle::Puddle puddle(s, street.around, executor);
  for (int frame = 0; frame < 30; ++frame) puddle.simulate();
  PuddleScene traced(s, street.around, {{embree_config}, nullptr, samples}, executor);
  bench::Goes goes(state);
  double best_update = 1e9;
  std::string hash;
  for (auto _ : state) {
    goes.add([&] {
      const double update = bench::seconds_of([&] { traced.update(puddle, executor); });
      Picture picture;
      const double seconds = bench::seconds_of([&] {
        picture = trace_picture(traced.scene(), traced.camera(), s.width, s.height, {{}, samples}, executor);
      });
      best_update = std::min(best_update, update);
      if (hash.empty()) hash = capture::hash_of(picture.beauty).text().substr(0, 16);
      return update + seconds;
    });
  }
  const double best = goes.best();
  state.counters["update_ms"] = 1e3 * best_update;
  state.counters["Mpix/s"] = 1e-6 * s.width * s.height * samples / best;
  state.SetLabel(hash);
}

const bool registered = [] {
  for (const int samples : {1, 4}) {
    for (const int threads : bench::thread_counts()) {
      for (const std::string config : {"", "isa=sse2"}) {
        if (samples > 1 && !config.empty()) continue;
        benchmark::RegisterBenchmark(
            fmt::format("traced_puddle/1280x720/samples:{}/threads:{}{}", samples, threads, config.empty() ? "" : "/" + config).c_str(),
            [=](benchmark::State& state) { picture(state, samples, config, threads); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace rainref::truth
