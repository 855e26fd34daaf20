#include <algorithm>

#include <fmt/format.h>

#include "drops/motion/passes.h"
#include "drops/motion/spawn.pass.h"
#include "rainref/error.h"
#include "random/draws.h"
#include "random/poisson.h"

namespace rainref::drops {

template <class W>
std::vector<Drop> arrivals_of(const SpawnUniforms& c, std::span<const CountThreshold> thresholds, std::span<const SpawnMass> masses,
                              bool all, const parallel::Executor* executor) {
  constexpr std::uint32_t most_parts = 1u << 12;
  constexpr std::int32_t most = 4 * static_cast<std::int32_t>(random::PoissonTable::max_mean);
  constexpr std::int32_t most_without_thresholds = 1 << 26;
  if (masses.size() != arrival_classes || c.threshold_count < 0 || static_cast<std::size_t>(c.threshold_count) > thresholds.size() ||
      c.threshold_count > most || c.parts > most_parts || c.first_count < 0 ||
      c.first_count > (c.threshold_count > 0 ? most : most_without_thresholds)) {
    throw Error(
        ExitCode::port_files,
        fmt::format("spawn: expected {} masses, at most {} thresholds and at most {} parts, found {} masses, {} thresholds, "
                    "threshold_count {}, first_count {}, parts {}",
                    arrival_classes, most, most_parts, masses.size(), thresholds.size(), c.threshold_count, c.first_count, c.parts));
  }
  const std::uint64_t seed = c.seed[0] | static_cast<std::uint64_t>(c.seed[1]) << 32;
  const auto used = thresholds.first(static_cast<std::size_t>(c.threshold_count));
  std::uint32_t count = 0;
  for (std::uint32_t part = 0; part < c.parts; ++part) {
    const auto word = W::block(seed, random::Purpose::drop_count, c.step, part)[0];
    count += static_cast<std::uint32_t>(W::count(word, c.first_count, used, &CountThreshold::threshold));
  }
  if (!all) count = std::min(count, c.room);
  std::vector<Drop> out(count);
  const auto arrive = [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::uint32_t>(begin); i < static_cast<std::uint32_t>(end); ++i) {
      const auto r = W::block(seed, random::Purpose::drop_arrival, c.step, i);
      out[i] = {{W::uniform(r[0]), W::uniform(r[1])}, {0, 0}, masses[r[2] >> 22].mass, c.life, c.first_id + i, 0};
    }
  };
  constexpr std::int64_t chunk = 128;
  if (executor != nullptr && count > chunk)
    executor->for_range(count, chunk, arrive);
  else
    arrive(0, count);
  return out;
}

template std::vector<Drop> arrivals_of<random::Words>(const SpawnUniforms&, std::span<const CountThreshold>, std::span<const SpawnMass>,
                                                      bool, const parallel::Executor*);
template std::vector<Drop> arrivals_of<random::PerturbedWords>(const SpawnUniforms&, std::span<const CountThreshold>,
                                                               std::span<const SpawnMass>, bool, const parallel::Executor*);

MassBalance spawn(const parallel::Executor& executor, DropArrays& drops, const SpawnUniforms& uniforms,
                  std::span<const CountThreshold> thresholds, std::span<const SpawnMass> masses, bool corrected) {
  const std::vector<Drop> arrivals = arrivals_of(uniforms, thresholds, masses, true, &executor);
  const std::size_t placed = drops.place(arrivals);
  MassBalance balance;
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    const std::int64_t water = corrected ? static_cast<std::int64_t>(arrivals[i].mass) : 1;
    balance.spawned += water;
    if (i >= placed) balance.removed += water;
  }
  return balance;
}

}  // namespace rainref::drops
