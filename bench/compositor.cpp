// Rays through water among other things, beside Embree's own triangles in the same process. What a row says: README.md.
#include <benchmark/benchmark.h>

#include <time.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>

#include <fmt/format.h>

#include "base/hash.h"
#include "compositor/native.h"
#include "compositor/world.h"
#include "goes.h"
#include "stream.h"
#include "thread_counts.h"
#include "widen.h"

namespace rainref::compositor {
namespace {

constexpr int width = 1920, height = 1080;
constexpr std::int64_t chunk_packets = 128;  // a task, of ours and of theirs
// What ours widens at a time, and then traces: it stays in the nearest cache, and asks for as many later ones as a core can wait for.
constexpr std::int64_t block_packets = 4;

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

// With one thread, the processor's time of that thread: other programs do not lengthen it. With more, the wall's.
double seconds_of(int threads, const auto& work) {
  if (threads > 1) return bench::seconds_of(work);
  const auto now = [] {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double start = now();
  work();
  return now() - start;
}

// Built once for each number of threads.
struct Race {
  explicit Race(int count) : threads(count) {
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

  int threads;
  parallel::Executor executor{threads};
  test::World world;
  Tracer tracer{{fmt::format("threads={}", threads)}};
  test::NativeWorld native{world, fmt::format("threads={}", threads).c_str()};
  std::vector<std::vector<float>> frames;
  std::map<std::string, std::vector<Ray>> rays;
};
Race& race(int threads) {
  static std::unique_ptr<Race> now;
  if (!now || now->threads != threads) now.reset(), now = std::make_unique<Race>(threads);
  return *now;
}

// Each go measures both, one right after the other, so that what else runs on the machine slows both; the medians of the
// ratios of the goes count.
void compare(benchmark::State& state, const std::string& set, int threads, bool as_records) {
  Race& r = race(threads);
  const auto packets = test::native_packets(r.rays.at(set));
  const auto count = static_cast<std::int64_t>(packets.size()) * 16;
  const bool coherent = set != "reflection";
  // Both take the same packets of floats, 2048 rays at a time, and leave their hits where a shader would find them: in the
  // cache; both ask for later packets ahead. Ours first widens the rays to arrays of doubles, or to records (Ray), and that is part of
  // its time.
  constexpr std::size_t chunk = chunk_packets * 16, block = block_packets * 16;
  const auto by_blocks = [&](const auto& trace_block) {
    r.executor.for_range(count / 16, chunk_packets, [&](std::int64_t begin, std::int64_t end) {
      thread_local std::vector<Hit> hits(chunk);
      for (std::int64_t p = begin; p < end; p += block_packets) {
        const auto packets_here = static_cast<std::size_t>(std::min(block_packets, end - p));
        trace_block(std::span(packets).subspan(static_cast<std::size_t>(p), packets_here),
                    std::span(hits).subspan(static_cast<std::size_t>(p - begin) * 16, packets_here * 16));
      }
      benchmark::DoNotOptimize(hits.data());
    });
  };
  const auto trace = [&] {
    by_blocks([&](std::span<const test::NativePacket> from, std::span<Hit> hits) {
      alignas(64) double rays[8][block];
      std::fill_n(rays[6], block, 0.0);
      std::fill_n(rays[7], block, std::numeric_limits<double>::infinity());
      for (std::size_t p = 0; p < from.size(); ++p) {
        from[p].ask_for_a_later_one();
        bench::widen_packet(from[p].origin, from[p].direction, &rays[0][p * 16], block);
      }
      r.tracer.first_hits(RayArrays{{rays[0], rays[1], rays[2]}, {rays[3], rays[4], rays[5]}, rays[6], rays[7]}, hits);
    });
  };
  const auto trace_records = [&] {
    by_blocks([&](std::span<const test::NativePacket> from, std::span<Hit> hits) {
      thread_local std::vector<Ray> rays(block);
      for (const test::NativePacket& packet : from) packet.ask_for_a_later_one();
      for (std::size_t k = 0; k < hits.size(); ++k) rays[k] = from[k / 16].ray(k % 16);
      r.tracer.first_hits(std::span(rays).first(hits.size()), hits);
    });
  };
  const auto trace_native = [&] {
    r.executor.for_range(count / 16, chunk_packets, [&](std::int64_t begin, std::int64_t end) {
      thread_local std::vector<test::NativeHit> hits(chunk_packets * 16);
      r.native.trace(std::span(packets).subspan(begin, end - begin), coherent, hits.data());
      benchmark::DoNotOptimize(hits.data());
    });
  };
  std::vector<double> ours, theirs, ratio, ratio_with_update, our_update, their_update;
  for (auto _ : state) {
    // The update makes another frame; the frame that is traced is always the first, for which the rays were made.
    const double u = seconds_of(threads, [&] { r.update(ours.size() % 3 + 1); });
    const double nu = seconds_of(threads, [&] { r.native.update(r.frames[ours.size() % 3 + 1]); });
    r.update(0);
    r.native.update(r.frames[0]);
    const double t = as_records ? seconds_of(threads, trace_records) : seconds_of(threads, trace), nt = seconds_of(threads, trace_native);
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
  const std::pair<const char*, const std::vector<double>&> times[]{{"", ours}, {"native_", theirs}};
  for (const auto& [whose, seconds] : times) {
    state.counters[fmt::format("{}q1_ms", whose)] = 1e3 * bench::quantile(seconds, 0.25);
    state.counters[fmt::format("{}median_ms", whose)] = 1e3 * bench::quantile(seconds, 0.5);
    state.counters[fmt::format("{}q3_ms", whose)] = 1e3 * bench::quantile(seconds, 0.75);
  }
  state.counters["goes"] = static_cast<double>(ours.size());
  state.counters["ratio"] = median(ratio);
  state.counters["ratio_with_update"] = median(ratio_with_update);
  Hasher hasher;
  for (const Hit& hit : test::first_hits(r.tracer, r.rays.at(set))) {
    hasher.add(std::as_bytes(std::span(&hit.t, 1)));
    hasher.add(std::as_bytes(std::span(&hit.surface, 2)));
  }
  state.SetLabel(hasher.finish().text().substr(0, 16));
}

const bool registered = [] {
  for (const int threads : bench::thread_counts()) {
    for (const bool as_records : {false, true}) {
      for (const std::string set : {"camera", "grazing", "reflection"}) {
        benchmark::RegisterBenchmark(
            fmt::format("{}/{}/{}x{}/threads:{}", as_records ? "rays_as_records" : "rays", set, width, height, threads).c_str(),
            [=](benchmark::State& state) { compare(state, set, threads, as_records); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond)
            ->Iterations(15);
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace rainref::compositor
