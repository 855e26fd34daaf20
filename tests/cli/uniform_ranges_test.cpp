// Whatever a scene may say, its uniforms lie in the ranges that the passes declare: a port that takes them is never refused for
// them. Random scenes, each key at an end of its range, near it, or anywhere between.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "capture/pass_info.h"
#include "registry/registry.h"
#include "simulation/opened.h"
#include "judge/support.h"
#include "rainref/error.h"
#include "scene/toml.h"
#include "shipped_packs.h"

namespace rainref::cli {
namespace {

using judge::test::Words;

double share(Words& words) { return static_cast<double>(words() >> 11) * 0x1p-53; }
double drawn(double low, double high, Words& words) {
  const double t = share(words);
  switch (words() % 5) {
    case 0:
      return low;
    case 1:
      return high;
    case 2:
      return low + (high - low) * t * t * t * t * t;
    case 3:
      return high - (high - low) * t * t * t * t * t;
    default:
      return low + (high - low) * t;
  }
}

/// Looks at each pass's uniforms before it runs.
class Ranges : public Recorder {
 public:
  Ranges(const capture::EffectInfo& effect, std::string variant) : effect_(effect), variant_(std::move(variant)) {}
  void before(const PassStart& start) override {
    const auto names = effect_.pass_names(variant_);
    if (std::find(names.begin(), names.end(), start.pass) == names.end()) return;
    const std::string fault = scene::value_fault(effect_.pass(start.pass).block(variant_), start.uniforms.data());
    if (!fault.empty()) faults.insert(fmt::format("{} {}.{}: {}", effect_.name, start.pass, variant_, fault));
    ++passes;
  }
  void pass(const PassCall&) override {}

  std::set<std::string> faults;
  int passes = 0;

 private:
  const capture::EffectInfo& effect_;
  std::string variant_;
};

class UniformRanges : public testing::TestWithParam<rainref::test::PackPasses> {};
INSTANTIATE_TEST_SUITE_P(Effects, UniformRanges, testing::ValuesIn([] {
                           std::vector<rainref::test::PackPasses> one_of_each_variant = rainref::test::shipped_packs();
                           std::erase_if(one_of_each_variant, [](const auto& p) { return p.name != p.effect_and_variant(); });
                           return one_of_each_variant;
                         }()),
                         rainref::test::name_of_pack_test);

TEST_P(UniformRanges, HoldWhateverASceneMaySay) {
  const std::string &name = GetParam().effect, &variant = GetParam().variant;
  const scene::Effect& entry = simulation::effect_table().find(name);
  const parallel::Executor executor(2);
  // What makes a run large or long, and what has nothing to do with uniforms, stays small.
  const std::map<std::string, std::string> fixed{{"maps.size", "8"},
                                                 {"maps.droplets", "20"},
                                                 {"maps.trails", "4"},
                                                 {"noise.size", "8"},
                                                 {"scene.size", "[16, 12]"},
                                                 {"scene.keyframes", "1"},
                                                 {"wipers.count", "2"},
                                                 {"puddle.grid", "[9, 7]"},
                                                 {"windshield.capacity", "500"},
                                                 {"flow.capacity", "500"},
                                                 {"windshield.height_size", "[12, 9]"},
                                                 {"flow.height_size", "[12, 9]"},
                                                 {"glass.shape", "'pane'"},
                                                 {"scene.source", "'shapes'"},
                                                 {"puddle.max_steps", "4"},
                                                 {"windshield.substeps", "2"},
                                                 {"flow.substeps", "2"},
                                                 {"flow.warm_up", "0.1"},
                                                 {"falling_rain.far", "1"},
                                                 {"falling_rain.smallest_drop", "4"}};
  const std::string packs = rainref::test::pack_sources().string() + "/", scene = rainref::test::pack_scene(GetParam().name);
  std::vector<std::string> always{"run.frames=2"};
  if (name == "windshield") always.push_back("vehicle.key_frames=''");
  if (name == "rainy_glass")
    always.insert(always.end(), {"scene.image=''", fmt::format("scene.panorama='{}sky.png'", packs)});  // a probe, too
  if (name == "rainy_glass" && variant == "corrected") always.push_back("scene.depth_image=''");
  Words words(7);
  int passes = 0, built = 0;
  std::set<std::string> faults;
  const std::int64_t rounds = judge::test::count_from("RAINREF_SCENES", 30);
  // Half of the panes that are drawn turn their outer side to the eye.
  const auto are_enough = [&] { return (name == "windshield" ? 12 : 6) * built > rounds && passes > rounds; };
  for (std::int64_t round = 0; round < rounds || (!are_enough() && round < 10 * rounds); ++round) {
    std::vector<std::string> overrides = always;
    // A frame of a whole second may take 100 000 steps of the wave: one of them is enough.
    overrides.push_back(fmt::format("run.fps={}", round == 0 ? 1 : drawn(10, 1000, words)));
    for (const scene::Parameter& p : entry.parameters) {
      if (!p.used_by(variant) || p.type == scene::Type::text || p.key.starts_with("compositor.") || p.key.starts_with("trace.") ||
          p.key.starts_with("sequence.") || p.key.starts_with("pane_") ||  // wipers of panes run the windshield's passes
          p.key == "picture.layer")                                        // some effects have none, and say so
        continue;
      if (const auto known = fixed.find(p.key); known != fixed.end()) {
        overrides.push_back(p.key + "=" + known->second);
        continue;
      }
      // Half of the keys stay as they are: with all of them wild nearly nothing can run.
      if (words() % 2 == 0) continue;
      const double low = std::max(p.minimum, -1e6), high = std::min(p.maximum, 1e6);
      const auto real = [&] { return fmt::format("{:e}", std::clamp(drawn(low, high, words), low, high)); };
      const auto whole = [&] { return fmt::format("{}", static_cast<std::int64_t>(drawn(low, std::min(high, 5000.0), words))); };
      switch (p.type) {
        case scene::Type::boolean:
          overrides.push_back(p.key + (words() % 2 ? "=true" : "=false"));
          break;
        case scene::Type::integer:
          overrides.push_back(p.key + "=" + whole());
          break;
        case scene::Type::integer2:
          break;
        case scene::Type::real:
          overrides.push_back(p.key + "=" + real());
          break;
        case scene::Type::real2:
          overrides.push_back(fmt::format("{}=[{}, {}]", p.key, real(), real()));
          break;
        // A direction or a corner: all three components anywhere.
        case scene::Type::real3:
          overrides.push_back(fmt::format("{}=[{}, {}, {}]", p.key, real(), real(), real()));
          break;
        case scene::Type::choice:
          overrides.push_back(fmt::format("{}='{}'", p.key, p.choices[words() % p.choices.size()]));
          break;
        case scene::Type::text:
          break;
      }
    }
    try {
      const scene::Config config = scene::load(scene, overrides, simulation::effect_table());
      simulation::Opened opened(simulation::config_of_passes(config), executor);
      Ranges ranges(*opened.effect().info, variant);
      ++built;
      opened.next_frame(&ranges);
      opened.next_frame(&ranges);
      passes += ranges.passes;
      faults.insert(ranges.faults.begin(), ranges.faults.end());
    } catch (const Error& e) {
      ASSERT_NE(e.code(), ExitCode::internal) << e.what();  // a scene that cannot run says so
    }
  }
  for (const std::string& fault : faults) ADD_FAILURE() << fault;
  EXPECT_TRUE(are_enough()) << built << " scenes, " << passes << " passes";
}

}  // namespace
}  // namespace rainref::cli
