// What threads of this machine come to where nothing is fetched, stored or waited for: the most that any pass can gain by them. Cores that
// share a power budget, or that are halves of one, do not come to their number; with wide vectors they run slower the more of them run.
#include <benchmark/benchmark.h>

#include <cstdint>

#include "chains.h"
#include "goes.h"
#include "rainref/executor.h"
#include "stream.h"
#include "thread_counts.h"

namespace rainref::bench {
namespace {

// Long enough that handing out chunks does not show; and about as long as one step of a wave, in as many chunks.
constexpr std::int64_t many = 4096, rounds_of_many = 4000, few = 128, rounds_of_few = 2000;

void registers(benchmark::State& state, std::int64_t chunks, std::int64_t rounds) {
  const parallel::Executor executor(static_cast<int>(state.range(0)));
  Goes goes(state);
  const auto chunk = [&](std::int64_t, std::int64_t) { benchmark::DoNotOptimize(chains(rounds)); };
  for ([[maybe_unused]] auto _ : state) goes.add([&] { return seconds_of([&] { executor.for_range(chunks, 1, chunk); }); });
  state.counters["Gop/s"] = 1e-9 * operations_of_round() * rounds * chunks / goes.best();
}
const int registered = [] {
  auto* whole = benchmark::RegisterBenchmark("registers", registers, many, rounds_of_many)->UseManualTime()->ArgName("threads");
  auto* brief = benchmark::RegisterBenchmark("registers/brief", registers, few, rounds_of_few)->UseManualTime()->ArgName("threads");
  for (const int threads : thread_counts()) whole->Arg(threads), brief->Arg(threads);
  return 0;
}();

}  // namespace
}  // namespace rainref::bench
