// Rays through water among other things, beside Embree's own triangles in the same process. What a row says: README.md.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>

#include <fmt/format.h>

#include "base/hash.h"
#include "compositor/native.h"
#include "compositor/world.h"
#include "stream.h"

namespace rainref::compositor {
namespace {

constexpr int width = 1920, height = 1080, threads = 2;
constexpr std::int64_t chunk_rays = 2048;  // a task, of ours and of theirs

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

// Built once, for all rows.
struct Race {
  parallel::Executor executor{threads};
  test::World world;
  Tracer tracer{{fmt::format("threads={}", threads)}};
  test::NativeWorld native{world, fmt::format("threads={}", threads).c_str()};
  std::vector<std::vector<float>> frames;
  std::map<std::string, std::vector<Ray>> rays;

  Race() {
    for (int k = 0; k < 4; ++k) frames.push_back(test::water_heights(1 + 0.1 * k));
    world.add_to(tracer);
    rays["camera"] = test::camera_rays(width, height);
    rays["grazing"] = test::grazing_rays(width, height);
    rays["reflection"] = test::reflection_rays(world, rays["camera"], test::first_hits(tracer, rays["camera"]));
  }
  void update(std::size_t frame) {
    world.water->assign(frames[frame], executor);
    tracer.commit();
  }
};
Race& race() {
  static Race one;
  return one;
}

// Each go measures both, one right after the other, so that what else runs on the machine slows both; the medians of the
// ratios of the goes count.
void compare(benchmark::State& state, const std::string& set) {
  Race& r = race();
  const std::vector<Ray>& rays = r.rays.at(set);
  const auto packets = test::native_packets(rays);
  const auto count = static_cast<std::int64_t>(rays.size());
  std::vector<Hit> hits(rays.size());
  std::vector<test::NativeHit> native_hits(rays.size());
  const bool coherent = set != "reflection";
  const auto trace = [&] {
    r.executor.for_range(count, chunk_rays, [&](std::int64_t begin, std::int64_t end) {
      r.tracer.first_hits(std::span(rays).subspan(begin, end - begin), std::span(hits).subspan(begin, end - begin));
    });
  };
  const auto trace_native = [&] {
    r.executor.for_range(count / 16, chunk_rays / 16, [&](std::int64_t begin, std::int64_t end) {
      r.native.trace(std::span(packets).subspan(begin, end - begin), coherent, native_hits.data() + begin * 16);
    });
  };
  std::vector<double> ours, theirs, ratio, ratio_with_update, our_update, their_update;
  for (auto _ : state) {
    // The update makes another frame; the frame that is traced is always the first, for which the rays were made.
    const double u = bench::seconds_of([&] { r.update(ours.size() % 3 + 1); });
    const double nu = bench::seconds_of([&] { r.native.update(r.frames[ours.size() % 3 + 1]); });
    r.update(0);
    r.native.update(r.frames[0]);
    const double t = bench::seconds_of(trace), nt = bench::seconds_of(trace_native);
    ours.push_back(t);
    theirs.push_back(nt);
    our_update.push_back(u);
    their_update.push_back(nu);
    ratio.push_back(nt / t);
    ratio_with_update.push_back((nt + nu) / (t + u));
    state.SetIterationTime(t);
  }
  const double n = static_cast<double>(count) * 1e-6;
  state.counters["Mray/s"] = n / median(ours);
  state.counters["native_Mray/s"] = n / median(theirs);
  state.counters["update_ms"] = 1e3 * median(our_update);
  state.counters["native_update_ms"] = 1e3 * median(their_update);
  state.counters["ratio"] = median(ratio);
  state.counters["ratio_with_update"] = median(ratio_with_update);
  Hasher hasher;
  for (const Hit& hit : hits) {
    hasher.add(std::as_bytes(std::span(&hit.t, 1)));
    hasher.add(std::as_bytes(std::span(&hit.surface, 2)));
  }
  state.SetLabel(hasher.finish().text().substr(0, 16));
}

const bool registered = [] {
  for (const std::string set : {"camera", "grazing", "reflection"}) {
    benchmark::RegisterBenchmark(fmt::format("rays/{}/{}x{}/threads:{}", set, width, height, threads).c_str(), [=](benchmark::State& state) { compare(state, set); })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(25);
  }
  return true;
}();

}  // namespace
}  // namespace rainref::compositor
