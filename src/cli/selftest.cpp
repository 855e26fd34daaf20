// `rainref selftest`: checks determinism on the user's machine.
#include <bit>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "capture/hashing.h"
#include "cli/commands.h"
#include "cli/selftest_golden.h"
#include "cli/terminal.h"
#include "math/half.h"
#include "math/half_array.h"
#include "math/simd_target.h"
#include "rainref/error.h"
#include "registry/registry.h"
#include "scene/test_card.h"
#include "scene/toml.h"
#include "simulation/opened.h"

namespace rainref::cli {
namespace {

bool report(bool good, const std::string& what) {
  say("{}  {}\n", good ? "pass" : "FAIL", what);
  return good;
}

bool floating_point_state() {
  FloatingPointReport found;
  parallel::Executor(2).for_range(2, 1, [&](std::int64_t begin, std::int64_t) {
    if (begin == 0) found = probe_floating_point();
  });
  return report(found.good(), "floating point: no contraction, no flush to zero, round to nearest");
}

bool half_conversion() {
  std::vector<Half> halves, back;
  std::vector<float> floats;
  for (std::uint32_t code = 0; code < 65536; ++code) {
    const Half h{static_cast<std::uint16_t>(code)};
    if ((code & 0x7c00u) == 0x7c00u) continue;  // infinities and NaN never occur in a field
    halves.push_back(h);
    floats.push_back(to_float(h));
  }
  bool good = true;
  std::vector<float> wide(halves.size());
  back.resize(halves.size());
  std::vector<float> samples;
  for (std::uint64_t bits = 0; bits < 0x100000000u; bits += 65521) {
    const float x = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    if ((bits & 0x7f800000u) != 0x7f800000u) samples.push_back(x);
  }
  std::vector<Half> codes(samples.size());
  for (const std::string& target : simd_targets()) {
    select_simd_target(target);
    to_float_array(halves.data(), wide.data(), halves.size());
    for (std::size_t i = 0; i < halves.size(); ++i)
      good = good && std::bit_cast<std::uint32_t>(wide[i]) == std::bit_cast<std::uint32_t>(floats[i]);
    for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
      to_half_array(samples.data(), codes.data(), samples.size(), rounding);
      for (std::size_t i = 0; i < samples.size(); ++i) good = good && codes[i].bits == to_half(samples[i] + 0.0f, rounding).bits;
    }
  }
  return report(good,
                fmt::format("binary16: every half and {} floats, both roundings, on {}", samples.size(), fmt::join(simd_targets(), " ")));
}

/// Few texels and many drops, so that the whole test takes seconds.
std::vector<std::string> overrides_of(const std::string& effect, bool corrected) {
  if (effect == "puddle" && corrected) return {"environment.width=64", "puddle.grid=[61, 45]", "puddle.shape=basin", "rain.rate=80"};
  if (effect == "puddle") return {"environment.width=64"};
  if (effect == "windshield")
    return {"windshield.height_size=[128, 72]", "scene.size=[64, 36]", "windshield.capacity=5000",
            corrected ? "rain.rate=100" : "windshield.spawn_rate=20000"};
  if (effect == "rainy_glass") return {"maps.size=64"};
  return {};
}

Hash128 scene_hash(const std::string& name, const std::string& variant, int threads, std::uint64_t shuffle) {
  const scene::Config config =
      scene::parse(fmt::format("effect = \"{}\"\nvariant = \"{}\"\n[run]\nframes = 3\nsize = [93, 61]\n", name, variant), "selftest",
                   overrides_of(name, variant == "corrected"), simulation::effect_table());
  parallel::Executor executor(threads);
  executor.shuffle_tiles(shuffle);
  simulation::Opened opened(config, executor, scene::TestCard::make);
  capture::HashRecorder recorder;
  for (int i = 0; i < 3; ++i) {
    opened.next_frame(&recorder);
    recorder.take_lines();
  }
  return recorder.scene_hash();
}

std::string golden_of(const std::string& effect, const std::string& variant) {
  for (const SelftestGolden& golden : selftest_goldens) {
    if (effect == golden.effect && variant == golden.variant) return golden.hash;
  }
  return "none";
}

bool scenes() {
  bool good = true;
  for (const effect::Effect* entry : registry::effects()) {
    for (const std::string& variant : entry->variants) {
      const std::string golden = golden_of(entry->name, variant);
      std::string other;
      for (const std::string& target : simd_targets()) {
        select_simd_target(target);
        for (const int threads : {1, 2, 3}) {
          const std::string found = scene_hash(entry->name, variant, threads, static_cast<std::uint64_t>(threads - 1)).text();
          if (found != golden) other = found;
        }
      }
      good &= report(other.empty(), fmt::format("{} {}: {} on {} with 1, 2 and 3 threads{}", entry->name, variant, golden,
                                                fmt::join(simd_targets(), " "), other.empty() ? "" : fmt::format("; found {}", other)));
    }
  }
  return good;
}

}  // namespace

int selftest() {
  const std::string before = selected_simd_target();
  bool good = floating_point_state();
  good &= half_conversion();
  good &= scenes();
  select_simd_target(before);
  say("{}\n", good ? "selftest passed" : "selftest FAILED");
  return static_cast<int>(good ? ExitCode::pass : ExitCode::fail);
}

}  // namespace rainref::cli
