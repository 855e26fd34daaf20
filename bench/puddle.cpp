// Speed of the puddle's passes through the shells that users run. What a row says: README.md.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "capture/hashing.h"
#include "goes.h"
#include "pass_row.h"
#include "puddle/host.h"
#include "puddle/kernels.h"
#include "puddle/parameters.h"
#include "puddle/rainfall.h"
#include "rainref/puddle.h"
#include "scene/toml.h"
#include "stream.h"
#include "thread_counts.h"

namespace rainref::puddle {
namespace {

constexpr int wave_tile_rows = 32, picture_tile_rows = 2;  // as puddle.cpp cuts its work

// The defaults of a scene, and these values.
Settings settings(const std::string& variant, const std::vector<std::string>& values) {
  const scene::EffectTable table{{{"puddle", {"as-published", "corrected"}, parameters()}}};
  return settings_from(scene::parse(fmt::format("effect = 'puddle'\nvariant = '{}'\nseed = 7\n", variant), "bench", values, table));
}

// Rate and share of the bound from the fastest go.
void report(benchmark::State& state, double best, double bound, double items, const char* unit, const std::string& hashes) {
  state.counters[unit] = items * 1e-9 / best;
  state.counters["stream_%"] = 100 * bound / best;
  state.SetLabel(hashes);
}

// Two levels of water that take turns.
class Water {
 public:
  Water(const Settings& s, int side) : settings_(s), side_(side), rest_(encoding(s).rest) {
    const Format format = s.storage == Format::rg16f ? Format::r16f : Format::r32f;
    newest_ = Image(format, side, side);
    previous_ = Image(format, side, side);
    rest_row_ = Image(format, side, 1);
    const bool corrected = s.variant == Variant::corrected;
    drops_ = corrected ? Rainfall(s, 1).drops(0) : raindrops_as_published(raindrops_uniforms(s, 7));
    // Waves of the height of a ripple, from integers.
    const float height = corrected ? 0x1p-18f : 0x1p-11f;
    start_.resize(static_cast<std::size_t>(side) * side);
    for (std::size_t i = 0; i < start_.size(); ++i) {
      const std::uint32_t x = static_cast<std::uint32_t>(i) % side, y = static_cast<std::uint32_t>(i) / side;
      start_[i] = rest_ + height * static_cast<float>(static_cast<int>((x * x + 3 * y * y) >> 4 & 255) - 128);
    }
    reset();
  }

  // Before the waves have died down to numbers that some processors are slow with.
  void reset() {
    encode_rows(start_.data(), newest_, settings_.boundary, rest_, settings_.rounding);
    encode_rows(start_.data(), previous_, settings_.boundary, rest_, settings_.rounding);
  }
  void step(const parallel::Executor& executor, int steps) {
    std::vector<WaveJob> jobs;
    for (int k = 0; k < steps; ++k) {
      Image* levels[2] = {&newest_, &previous_};
      jobs.push_back({wave_step_uniforms(settings_), settings_.variant == Variant::corrected, settings_.rounding, settings_.boundary,
                      levels[k % 2], levels[1 - k % 2], &rest_row_, nullptr, drops_});
      jobs.back().uniforms.drop_count = static_cast<std::int32_t>(drops_.size());
    }
    step_wave(jobs, executor);
    if (steps % 2 == 1) std::swap(newest_, previous_);
  }
  std::string hash() const { return capture::hash_of(BufferView(settings_.storage, {&newest_, &previous_})).text().substr(0, 16); }

 private:
  Settings settings_;
  int side_;
  float rest_;
  Image newest_, previous_, rest_row_;
  std::vector<Drop> drops_;
  std::vector<float> start_;
};

// steps: at a time, those of a frame.
void wave_step(benchmark::State& state, const std::string& variant, const std::string& storage, int side, int steps, int threads) {
  const parallel::Executor executor(threads);
  std::vector<std::string> values{"puddle.storage=" + storage, fmt::format("run.size=[{}, {}]", side, side)};
  if (variant == "corrected") {
    values[1] = fmt::format("puddle.grid=[{}, {}]", side, side);
    values.push_back("puddle.shape=basin");  // the shore of a natural puddle is one more plane to read
  }
  Water water(settings(variant, values), side);
  for (int step = 0; step < 8; ++step) water.step(executor, 1);
  const std::string hash = water.hash();
  const int bytes = storage == "rg16f" ? 2 : 4;
  const double bound = bench::stream_seconds(executor, side, side, wave_tile_rows, {bytes, bytes});
  bench::Goes goes(state);
  int made = 8;
  for (auto _ : state) {
    goes.add([&] {
      if (made % 64 < steps) water.reset();
      made += steps;
      return bench::seconds_of([&] { water.step(executor, steps); });
    });
  }
  report(state, goes.best(), steps * bound, static_cast<double>(side) * side * steps, "Gcell/s", hash);
}

void picture(benchmark::State& state, const std::string& variant, const std::string& pass, bench::Traffic traffic, int threads) {
  const parallel::Executor executor(threads);
  const Settings s = settings(variant, {"run.size=[1280, 720]"});
  Surroundings around;
  around.environment = bench::integers(1024, 512);
  Puddle puddle(s, around, executor);
  for (int frame = 0; frame < 8; ++frame) puddle.simulate();
  bench::pass_row(state, executor, s.width, s.height, picture_tile_rows, pass, traffic,
                  [&](Recorder* recorder) { puddle.render(recorder); });
}

const bool registered = [] {
  for (const std::string variant : {"as-published", "corrected"}) {
    for (const std::string storage : {"rg16f", "rg32f"}) {
      for (const int side : {1024, 2048, 4096}) {
        for (const int steps : {1, 5}) {
          if (steps > 1 && variant == "as-published") continue;  // takes one a frame
          for (const int threads : bench::thread_counts()) {
            const std::string many = steps > 1 ? fmt::format("/steps:{}", steps) : "";
            benchmark::RegisterBenchmark(fmt::format("wave_step/{}/{}/{}{}/threads:{}", variant, storage, side, many, threads).c_str(),
                                         [=](benchmark::State& state) { wave_step(state, variant, storage, side, steps, threads); })
                ->UseManualTime()
                ->Unit(benchmark::kMillisecond);
          }
        }
      }
    }
  }
  for (const std::string variant : {"as-published", "corrected"}) {
    const int noise = variant == "corrected" ? 0 : 4;
    const std::vector<std::pair<std::string, bench::Traffic>> passes{
        {"surface_hit", {0, 24}}, {"shade", {24 + noise, 8}}, {"display", {8, 4}}};
    for (const auto& [pass, traffic] : passes) {
      for (const int threads : bench::thread_counts()) {
        benchmark::RegisterBenchmark(
            fmt::format("{}/{}/1280x720/threads:{}", pass, variant, threads).c_str(),
            [=, name = pass, bytes = traffic](benchmark::State& state) { picture(state, variant, name, bytes, threads); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace rainref::puddle
