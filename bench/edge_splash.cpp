// Speed of the passes of edge_splash through the shells that users run. What a row says: README.md.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>
#include <string>

#include <fmt/format.h>

#include "capture/hashing.h"
#include "edge_splash/host.h"
#include "edge_splash/parameters.h"
#include "edge_splash/shapes.h"
#include "rainref/edge_splash.h"
#include "scene/toml.h"
#include "stream.h"

namespace rainref::edge_splash {
namespace {

constexpr int tile_rows = 8;  // as edge_splash.cpp cuts its work

class PassTimes : public Recorder {
 public:
  void pass(const PassCall& call) override { seconds[std::string(call.pass)] = call.seconds; }
  std::map<std::string, double> seconds;
};

void picture(benchmark::State& state, const std::string& variant, const std::string& pass, bench::Traffic traffic, int threads) {
  const parallel::Executor executor(threads);
  const scene::EffectTable table{{{"edge_splash", {"as-published", "corrected"}, parameters()}}};
  const Settings s = settings_from(scene::parse(fmt::format("effect = 'edge_splash'\nvariant = '{}'\nseed = 7\n", variant), "bench", {"run.size=[1920, 1080]"}, table));
  ShapesView view = render_shapes(camera(s), s.width, s.height, s.depth.far_plane, executor);
  Inputs in;
  in.colour = std::move(view.colour);
  in.depth = std::move(view.depth);
  in.depth_is_distance = true;
  EdgeSplash effect(s, in, executor);
  capture::HashRecorder recorder;
  effect.render(&recorder);
  std::string hashes;
  for (const capture::HashLine& line : recorder.take_lines()) {
    if (line.pass == pass) hashes += fmt::format("{}{:.16}", hashes.empty() ? "" : " ", line.hash.text());
  }
  const double bound = bench::stream_seconds(executor, s.width, s.height, tile_rows, traffic);
  double best = 1e9;
  for (auto _ : state) {
    PassTimes times;
    effect.render(&times);
    best = std::min(best, times.seconds.at(pass));
    state.SetIterationTime(times.seconds.at(pass));
  }
  state.counters["Mpix/s"] = 1e-6 * s.width * s.height / best;
  state.counters["stream_%"] = 100 * bound / best;
  state.SetLabel(hashes);
}

const bool registered = [] {
  for (const std::string variant : {"as-published", "corrected"}) {
    // splash reads the scene and the depth, corrected the layer too, and writes three masks and the colour.
    const std::vector<std::pair<std::string, bench::Traffic>> passes{{"splash", {variant == "corrected" ? 13 : 12, 11}}, {"display", {8, 4}}};
    for (const auto& [pass, traffic] : passes) {
      for (const int threads : {1, 2}) {
        benchmark::RegisterBenchmark(fmt::format("edge_splash.{}/{}/1920x1080/threads:{}", pass, variant, threads).c_str(),
                                     [=, name = pass, bytes = traffic](benchmark::State& state) { picture(state, variant, name, bytes, threads); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace rainref::edge_splash
