// Speed of the passes of edge_splash through the shells that users run. What a row says: README.md.
#include <string>

#include "edge_splash/host.h"
#include "edge_splash/parameters.h"
#include "edge_splash/shapes.h"
#include "pass_row.h"
#include "rainref/edge_splash.h"
#include "scene/toml.h"
#include "thread_counts.h"

namespace rainref::edge_splash {
namespace {

constexpr int tile_rows = 8;  // as edge_splash.cpp cuts its work

void picture(benchmark::State& state, const std::string& variant, const std::string& pass, bench::Traffic traffic, int threads) {
  const parallel::Executor executor(threads);
  const scene::EffectTable table{{{"edge_splash", {"as-published", "corrected"}, parameters()}}};
  const Settings s = settings_from(
      scene::parse(fmt::format("effect = 'edge_splash'\nvariant = '{}'\nseed = 7\n", variant), "bench", {"run.size=[1920, 1080]"}, table));
  ShapesView view = render_shapes(camera(s), s.width, s.height, s.depth.far_plane, executor);
  Inputs in;
  in.colour = std::move(view.colour);
  in.depth = std::move(view.depth);
  in.depth_is_distance = true;
  EdgeSplash effect(s, in, executor);
  bench::pass_row(state, executor, s.width, s.height, tile_rows, pass, traffic, [&](Recorder* recorder) { effect.next_frame(recorder); });
}

const bool registered = [] {
  for (const std::string variant : {"as-published", "corrected"}) {
    // splash reads the scene and the depth, corrected the layer too, and writes three masks and the colour.
    const std::vector<std::pair<std::string, bench::Traffic>> passes{{"splash", {variant == "corrected" ? 13 : 12, 11}},
                                                                     {"display", {8, 4}}};
    for (const auto& [pass, traffic] : passes) {
      for (const int threads : bench::thread_counts()) {
        benchmark::RegisterBenchmark(
            fmt::format("edge_splash.{}/{}/1920x1080/threads:{}", pass, variant, threads).c_str(),
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
