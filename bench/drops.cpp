// Speed of the passes that move drops, through the functions that effects call. What a row says: README.md.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/hash.h"
#include "drops/host.h"
#include "drops/motion/passes.h"
#include "goes.h"
#include "random/counter.h"
#include "stream.h"
#include "thread_counts.h"

namespace rainref::drops {
namespace {

constexpr PlaneFrame frame{1.4, 0, 0.8};
constexpr double coverage = 0.2;  // of the glass by bases, whatever the number of drops
constexpr double dt = 1e-3;       // short, so that the drops are still there after some thousand steps

std::vector<Drop> sprinkle(std::int64_t count, bool corrected) {
  const double radius = std::sqrt(coverage * frame[0] * frame[2] / (3.14159265 * static_cast<double>(count)));
  const double mean = std::pow(radius / radius_of_mass_unit({}), 3);
  std::vector<Drop> out(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto r = random::block(1, random::Purpose::drop_arrival, 0, static_cast<std::uint32_t>(i));
    const auto mass = static_cast<float>(corrected ? std::max(1.0, std::floor(mean * (0.5 + static_cast<double>(random::uniform(r[2])))))
                                                   : 0.5 + static_cast<double>(random::uniform(r[2])));
    out[i] = {
        {random::uniform(r[0]), random::uniform(r[1])}, {0, random::uniform(r[3]) - 0.5f}, mass, 500, static_cast<std::uint32_t>(i), 0};
  }
  return out;
}
std::string hash_of(const DropArrays& drops, const parallel::Executor& executor) {
  std::vector<Drop> records;
  drops.gather(records, executor);
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(records)));
  return hasher.finish().text().substr(0, 16);
}

// The arrays of integrate, moved without arithmetic: six are read, all but the mass are written back.
void move(float* __restrict u, float* __restrict v, float* __restrict p, float* __restrict q, float* __restrict life,
          const float* __restrict mass, std::int64_t count) {
  const auto turned = [](float x, float by) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) ^ std::bit_cast<std::uint32_t>(by));
  };
  for (std::int64_t i = 0; i < count; ++i) {
    u[i] = turned(u[i], mass[i]);
    v[i] = turned(v[i], mass[i]);
    p[i] = turned(p[i], mass[i]);
    q[i] = turned(q[i], mass[i]);
    life[i] = turned(life[i], mass[i]);
  }
}
double stream_seconds(const parallel::Executor& executor, DropArrays& drops) {
  const auto range = [&](std::int64_t begin, std::int64_t end) {
    move(drops.u().data() + begin, drops.v().data() + begin, drops.velocity_u().data() + begin, drops.velocity_v().data() + begin,
         drops.life().data() + begin, drops.mass().data() + begin, end - begin);
  };
  double best = 1e9, total = 0;
  for (int go = 0; go < 6 || go % 2 == 1 || (total < 0.2 && go < 2000); ++go) {  // an even number restores them
    const double seconds = bench::seconds_of([&] { executor.for_range(drops.extent(), chunk_of(drops.extent()), range); });
    best = std::min(best, seconds);
    total += seconds;
  }
  return best;
}

void integrate(benchmark::State& state, bool corrected, std::int64_t count, int threads) {
  const parallel::Executor executor(threads);
  DropArrays drops(count);
  drops.assign(sprinkle(count, corrected));
  Settings s;
  s.corrected = corrected;
  s.margin = 1;
  const IntegrateUniforms uniforms = integrate_uniforms(s, frame, dt);
  GlassFrame glass{};
  glass.gravity[1] = -5.5f;
  glass.wind[1] = 9;
  const auto step = [&] { drops::integrate(executor, drops, uniforms, glass, corrected); };
  const double bound = stream_seconds(executor, drops);
  for (int n = 0; n < 8; ++n) step();
  const std::string hash = hash_of(drops, executor);
  bench::Goes goes(state);
  for (auto _ : state) {
    goes.add([&] { return bench::seconds_of(step); });
  }
  const double best = goes.best();
  state.counters["Mdrop/s"] = static_cast<double>(count) * 1e-6 / best;
  state.counters["stream_%"] = 100 * bound / best;
  state.SetLabel(hash);
}

// crowded: drops that fell anywhere, many of which touch. settled: what is left when no more do.
void merge(benchmark::State& state, bool settled, std::int64_t count, int threads) {
  const parallel::Executor executor(threads);
  DropArrays drops(count);
  drops.assign(sprinkle(count, true));
  const MergeUniforms uniforms = merge_uniforms({}, frame, dt, 1024, 592, 0);
  Merger merger;
  while (settled && merger.merge(executor, drops, uniforms) > 0) {
  }
  std::vector<Drop> start;
  drops.gather(start, executor);
  merger.merge(executor, drops, uniforms);
  const std::string hash = hash_of(drops, executor);
  bench::Goes goes(state);
  for (auto _ : state) {
    goes.add([&] {
      drops.assign(start);
      return bench::seconds_of([&] { merger.merge(executor, drops, uniforms); });
    });
  }
  const double best = goes.best();
  state.counters["Mdrop/s"] = static_cast<double>(start.size()) * 1e-6 / best;
  state.SetLabel(hash);
}

const bool registered = [] {
  const auto add = [](const std::string& name, auto body) {
    benchmark::RegisterBenchmark(name.c_str(), body)->UseManualTime()->Unit(benchmark::kMillisecond);
  };
  for (const bool corrected : {false, true}) {
    for (const std::int64_t count : {100'000, 1'000'000, 10'000'000}) {
      for (const int threads : bench::thread_counts()) {
        add(fmt::format("integrate/{}/{}/threads:{}", corrected ? "corrected" : "as-published", count, threads),
            [=](benchmark::State& state) { integrate(state, corrected, count, threads); });
      }
    }
  }
  for (const bool settled : {false, true}) {
    for (const std::int64_t count : {100'000, 1'000'000, 10'000'000}) {
      for (const int threads : bench::thread_counts()) {
        add(fmt::format("merge/{}/{}/threads:{}", settled ? "settled" : "crowded", count, threads),
            [=](benchmark::State& state) { merge(state, settled, count, threads); });
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace rainref::drops
