// The whole picture of a traced windshield: the water of a frame as surfaces, tracing, the street behind. What a row says: README.md.
#include <benchmark/benchmark.h>

#include <algorithm>

#include <fmt/format.h>

#include "capture/hashing.h"
#include "goes.h"
#include "night_street/night_street.h"
#include "truth/windshield_view.h"
#include "scene/toml.h"
#include "stream.h"
#include "thread_counts.h"

namespace rainref::truth {
namespace {

// scenes/windshield/default.toml after 100 frames. `rays` are primary ones; each sees the street at least once, which is most of
// the work, so the same rays with nothing but the street stand beside it.
void picture(benchmark::State& state, double radius, const std::string& embree_config, int threads) {
  const scene::EffectTable table{{{"windshield", {"as-published", "corrected"}, windshield::parameters()}}};
  const scene::Config config =
      scene::parse("effect = 'windshield'\nvariant = 'corrected'\nseed = 1\n", "bench",
                   {"vehicle.speed=0", "wipers.count=0", "rain.rate=90", "rain.smallest_drop=0.8",
                    "windshield.corner_2=[1.386, 0.7, 1.613]", "windshield.height_size=[2048, 1168]", "camera.position=[0.6, 0, 1.32]",
                    "camera.target=[10, 0, 1.5]", "camera.vertical_fov_deg=24", "run.size=[640, 360]", "run.fps=30", "scene.size=[8, 8]"},
                   table);
  const parallel::Executor executor(threads);
  const windshield::Settings settings = windshield::settings_from(config);
  static const std::shared_ptr<const scene::Scenery> seen = night_street::Street::make({settings.seed, settings.clear_lane});
  static const auto rendered = [&] {
    static const parallel::Executor own;
    auto w = std::make_unique<windshield::Windshield>(config, windshield::Surroundings{{}, {}, seen}, own);
    for (int frame = 0; frame < 100; ++frame) w->simulate();
    w->render();
    return w;
  }();
  const WindshieldView view(settings, {5e-3, radius}, {embree_config}, seen, executor);
  const int width = settings.picture.width, height = settings.picture.height;
  bench::Goes goes(state);
  double best_update = 1e9, best_street = 1e9;
  std::string hash;
  for (auto _ : state) {
    goes.add([&] {
      std::unique_ptr<Scene> scene;
      const double update = bench::seconds_of([&] { scene = view.scene(*rendered); });
      Picture traced;
      const double seconds = bench::seconds_of([&] { traced = trace_picture(*scene, view.camera(), width, height, {}, executor); });
      const PrimaryRays primary(view.camera(), width, height);
      const double street = bench::seconds_of([&] {
        executor.for_tiles(width, height, 64, 16, [&](const parallel::Tile& tile) {
          Columns<7> escaped_rays;
          const auto count = static_cast<std::size_t>(tile.x1 - tile.x0) * static_cast<std::size_t>(tile.y1 - tile.y0);
          escaped_rays.make_room(count);
          std::size_t filled = 0;
          for (int y = tile.y0; y < tile.y1; ++y) {
            for (int x = tile.x0; x < tile.x1; ++x, ++filled) {
              const Ray ray = primary.through(x + 0.5, y + 0.5);
              const double length = __builtin_sqrt(dot(ray.direction, ray.direction));
              escaped_rays.vectors(0).put(filled, view.camera().position + 2.0 * ray.direction);
              escaped_rays.vectors(3).put(filled, ray.direction / length);
            }
          }
          std::vector<Vec> radiance(count);
          scene->environment().radiance({count, escaped_rays.vectors(0), escaped_rays.vectors(3), escaped_rays[6]}, radiance);
          benchmark::DoNotOptimize(radiance.data());
        });
      });
      best_update = std::min(best_update, update);
      best_street = std::min(best_street, street);
      if (hash.empty()) hash = capture::hash_of(traced.beauty).text().substr(0, 16);
      return update + seconds;
    });
  }
  const double best = goes.best();
  state.counters["update_ms"] = 1e3 * best_update;
  state.counters["street_ms"] = 1e3 * best_street;
  state.counters["over_street"] = best / best_street;
  state.counters["Mpix/s"] = 1e-6 * width * height / best;
  state.SetLabel(hash);
}

const bool registered = [] {
  for (const double radius : {0.0, 3.0}) {
    for (const int threads : bench::thread_counts()) {
      for (const std::string config : {"", "isa=sse2"}) {
        if (threads > 1 && !config.empty()) continue;
        benchmark::RegisterBenchmark(fmt::format("traced_windshield/640x360/{}/threads:{}{}", radius > 0 ? "bent" : "flat", threads,
                                                 config.empty() ? "" : "/" + config)
                                         .c_str(),
                                     [=](benchmark::State& state) { picture(state, radius, config, threads); })
            ->UseManualTime()
            ->Iterations(3)
            ->Unit(benchmark::kMillisecond);
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace rainref::truth
