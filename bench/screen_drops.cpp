// Speed of the passes of screen_drops through the shells that users run. What a row says: README.md.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>
#include <string>

#include <fmt/format.h>

#include "capture/hashing.h"
#include "rainref/screen_drops.h"
#include "scene/toml.h"
#include "screen_drops/parameters.h"
#include "stream.h"

namespace rainref::screen_drops {
namespace {

constexpr int picture_tile_rows = 8;  // as screen_drops.cpp cuts its work

// A scene of integers, so that no change of the street at night changes a hash here.
Inputs inputs(const Settings& s) {
  Inputs in;
  in.colour = Image(Format::rgba32f, s.width, s.height);
  for (int y = 0; y < s.height; ++y) {
    for (int i = 0; i < 4 * s.width; ++i) {
      in.colour.row<float>(y)[i] = static_cast<float>((static_cast<std::uint32_t>(i) * 37u + static_cast<std::uint32_t>(y * y) * 11u) >> 3 & 255u) / 128.0f;
    }
  }
  return in;
}

class PassTimes : public Recorder {
 public:
  void pass(const PassCall& call) override { seconds[std::string(call.pass)] = call.seconds; }
  std::map<std::string, double> seconds;
};

void picture(benchmark::State& state, const std::string& variant, const std::string& pass, bench::Traffic traffic, bool flows, int height, int threads) {
  const parallel::Executor executor(threads);
  const scene::EffectTable table{{{"screen_drops", {"as-published", "corrected"}, parameters()}}};
  std::vector<std::string> sets{fmt::format("run.size=[{}, {}]", height * 16 / 9, height)};
  if (variant == "corrected") sets.insert(sets.end(), {flows ? "flow.on=true" : "flow.on=false", "rain.rate=40", "flow.warm_up=20", "flow.height_size=[640, 360]"});
  const scene::Config config = scene::parse(fmt::format("effect = 'screen_drops'\nvariant = '{}'\nseed = 7\n", variant), "bench", sets, table);
  const Settings s = settings_from(config);
  const auto flow = flow_from(config, s);
  ScreenDrops window(s, inputs(s), executor, flow ? &*flow : nullptr);
  capture::HashRecorder recorder;
  window.render(&recorder);
  std::string hash;
  for (const capture::HashLine& line : recorder.take_lines()) {
    if (line.pass == pass) hash = fmt::format("{:.16}", line.hash.text());
  }
  const double bound = bench::stream_seconds(executor, s.width, s.height, picture_tile_rows, traffic);
  double best = 1e9;
  for (auto _ : state) {
    PassTimes times;
    window.render(&times);
    best = std::min(best, times.seconds.at(pass));
    state.SetIterationTime(times.seconds.at(pass));
  }
  state.counters["Mpix/s"] = 1e-6 * s.width * s.height / best;
  state.counters["stream_%"] = 100 * bound / best;
  state.SetLabel(hash);
}

const bool registered = [] {
  // The background's texel is read, water and colour are written; cells, noise and the scene come from the caches.
  const bench::Traffic window{8, 9}, shown{8, 4};
  const auto add = [](const std::string& name, const std::string& variant, const std::string& pass, bench::Traffic traffic, bool flows) {
    for (const int height : {720, 1080}) {
      for (const int threads : {1, 2}) {
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
