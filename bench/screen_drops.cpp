// Speed of the passes of screen_drops through the shells that users run. What a row says: README.md.
#include <string>

#include "pass_row.h"
#include "rainref/screen_drops.h"
#include "scene/toml.h"
#include "thread_counts.h"
#include "screen_drops/parameters.h"

namespace rainref::screen_drops {
namespace {

constexpr int picture_tile_rows = 4;  // as screen_drops.cpp cuts its work

void picture(benchmark::State& state, const std::string& variant, const std::string& pass, bench::Traffic traffic, bool flows, int height,
             int threads) {
  const parallel::Executor executor(threads);
  const scene::EffectTable table{{{"screen_drops", {"as-published", "corrected"}, parameters()}}};
  std::vector<std::string> sets{fmt::format("run.size=[{}, {}]", height * 16 / 9, height)};
  if (variant == "corrected")
    sets.insert(sets.end(), {flows ? "flow.on=true" : "flow.on=false", "rain.rate=40", "flow.warm_up=20", "flow.height_size=[640, 360]"});
  const scene::Config config =
      scene::parse(fmt::format("effect = 'screen_drops'\nvariant = '{}'\nseed = 7\n", variant), "bench", sets, table);
  const Settings s = settings_from(config);
  const auto flow = flow_from(config, s);
  Inputs in;
  in.colour = bench::integers(s.width, s.height);
  ScreenDrops window(s, in, executor, flow ? &*flow : nullptr);
  bench::pass_row(state, executor, s.width, s.height, picture_tile_rows, pass, traffic,
                  [&](Recorder* recorder) { window.next_frame(recorder); });
}

const bool registered = [] {
  // The background's texel is read, water and colour are written; cells, noise and the scene come from the caches.
  const bench::Traffic window{8, 9}, shown{8, 4};
  const auto add = [](const std::string& name, const std::string& variant, const std::string& pass, bench::Traffic traffic, bool flows) {
    for (const int height : {720, 1080}) {
      for (const int threads : bench::thread_counts()) {
        benchmark::RegisterBenchmark(fmt::format("{}/{}p/threads:{}", name, height, threads).c_str(),
                                     [=](benchmark::State& state) { picture(state, variant, pass, traffic, flows, height, threads); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
      }
    }
  };
  add("screen_drops.drops/as-published", "as-published", "drops", window, false);
  add("screen_drops.drops/corrected/still", "corrected", "drops", window, false);
  add("screen_drops.drops/corrected/flow", "corrected", "drops", window, true);
  add("screen_drops.cells/corrected", "corrected", "cells", window, false);
  add("screen_drops.display/corrected", "corrected", "display", shown, false);
  return true;
}();

}  // namespace
}  // namespace rainref::screen_drops
