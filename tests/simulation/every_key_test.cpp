// A key that changes while a scene runs: what is remembered of the scene before changes no bit of what comes, and is made again only where
// it reads the key.
#include <algorithm>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cache/kept_images.h"
#include "cache/prepared.h"
#include "rainref/error.h"
#include "rainref/simulation.h"
#include "simulation/every_state.h"
#include "simulation/other_value.h"

namespace rainref {
namespace {

constexpr std::size_t room = std::size_t{1} << 30;

/// Scenes in which each kind of prepared thing occurs; a street takes long where nothing is remembered, so that pictures stand for it.
std::vector<StateScene> scenes(bool with_street) {
  std::vector<StateScene> all;
  for (const std::string variant : {"as-published", "corrected"}) {
    const bool corrected = variant == "corrected";
    const auto add = [&](const std::string& effect, const std::string& name, std::vector<std::string> more) {
      more.push_back("run.frames=40");
      all.push_back({effect + (corrected ? "_corrected_" : "_published_") + name, small(effect, variant, std::move(more))});
    };
    const std::string depth = "scene.depth_image=" + picture_of("scene.depth_image", "base");
    const std::string image = "scene.image=" + picture_of("scene.image", "base");
    const std::string panorama = with_street ? "run.fps=60" : "scene.panorama=" + picture_of("scene.panorama", "base");
    std::vector<std::string> water{"environment.image=" + (with_street ? "" : picture_of("environment.image", "base"))};
    if (with_street) water.insert(water.end(), {"environment.width=64", "puddle.ground_image="});
    if (corrected) add("puddle", "basin", water);
    if (corrected) water.insert(water.end(), {"puddle.shape=natural", "puddle.bed_columns=64"});
    add("puddle", "pond", water);
    std::vector<std::string> edges{with_street ? "scene.source=street" : "scene.source=shapes"};
    if (with_street && corrected) edges.push_back("edge_splash.splashes=crowns");
    add("edge_splash", "scene", edges);
    add("screen_drops", "pane", {panorama, corrected ? "flow.warm_up=0.3" : "noise.size=16"});
    if (corrected) add("screen_drops", "dry", {panorama, "flow.on=false", "flow.warm_up=0.3"});
    for (const std::string storage : {"rgba8", "rgba16f"})
      add("rainy_glass", storage,
          {panorama, "maps.storage=" + storage, "maps.droplets=40", "scene.defocus=0.09",
           storage == "rgba8" ? "glass.background=grab" : "glass.background=probe"});
    std::vector<std::string> drive{"run.fps=30"};
    if (!with_street) drive = {"scene.image=" + tiny_film(), "sequence.first=7", "sequence.count=1", "sequence.end=hold"};
    add("windshield", "drive", drive);
    if (with_street) {
      add("windshield", "still", {"scene.moves=false"});
      continue;
    }
    add("edge_splash", "files", {"scene.source=files", "scene.depth_encoding=metres", "scene.depth_scale=100", image, depth});
    add("screen_drops", "files", {image});
    std::vector<std::string> own{image, "glass.shape=image", "glass.normal_image=" + picture_of("glass.normal_image", "base"),
                                 "glass.background=probe", "glass.probe_image=" + picture_of("glass.probe_image", "base")};
    if (corrected) own.push_back(depth);
    add("rainy_glass", "files", own);
    if (corrected) add("rainy_glass", "wall", {image, "scene.depth=7"});
    add("windshield", "files", {image, depth});
  }
  return all;
}

struct Changed {
  std::string effect, name, key;             ///< key: with its value
  std::vector<std::string> lines;            ///< of two frames, or what it was refused with
  std::map<std::string, std::int64_t> made;  ///< meanwhile
  bool is_refused = false;
};
/// From here on only memory keeps what is prepared. The first simulation of a process says where images are kept and what is remembered.
void remember_in_memory(const parallel::Executor& executor) {
  Simulation(small("edge_splash", "corrected"), executor);
  cache::keep_in({});
  cache::remember(0);
  cache::remember(room);
}

/// Every key of the scene, set at frame 3.
std::vector<Changed> every_change(const SceneText& text, const parallel::Executor& executor) {
  Simulation base(text, executor);
  for (int frame = 0; frame < 3; ++frame) base.next_frame();
  const std::vector<std::byte> state = base.save();
  const simulation::Opened opened(scene::parse(text, simulation::effect_table()), executor);
  std::vector<Changed> all;
  for (const scene::Config::Entry& e : opened.config().entries()) {
    const std::optional<std::string> value = other_value(e);
    // Another effect or variant is refused, whatever it makes before that.
    if (!value || e.parameter.key == "effect" || e.parameter.key == "variant") continue;
    Simulation running(text, executor);
    running.load(state);
    running.render();
    Changed& changed = all.emplace_back(Changed{opened.config().effect(), e.parameter.key, e.parameter.key + " = " + *value, {}, {}});
    const auto before = cache::times_made();
    try {
      running.set(e.parameter.key, *value);
      changed.lines = lines_of([&](Recorder* r) {
        running.next_frame(r);
        running.next_frame(r);
      });
    } catch (const Error& error) {
      changed.lines = {error.what()};
      changed.is_refused = true;
    }
    for (const auto& [what, times] : cache::times_made())
      if (const auto then = before.find(what); then == before.end() || then->second != times) changed.made[what] = times;
  }
  return all;
}

class EveryKey : public testing::TestWithParam<StateScene> {
 protected:
  ~EveryKey() override { cache::remember(0); }
  parallel::Executor executor{1};
};

TEST_P(EveryKey, HasTheBitsOfAProcessThatRemembersNothing) {
  remember_in_memory(executor);
  cache::remember(0);
  const std::vector<Changed> plain = every_change(GetParam().text, executor);
  cache::remember(room);
  const std::vector<Changed> remembered = every_change(GetParam().text, executor);
  ASSERT_EQ(remembered.size(), plain.size());
  std::size_t refused = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(remembered[i].lines, plain[i].lines) << plain[i].key;
    EXPECT_EQ(remembered[i].is_refused, plain[i].is_refused) << plain[i].key;
    refused += plain[i].is_refused;
  }
  EXPECT_GT(plain.size() - refused, 15u);
}
INSTANTIATE_TEST_SUITE_P(Scenes, EveryKey, testing::ValuesIn(scenes(false)), [](const auto& p) { return p.param.name; });

class SecondScene : public testing::TestWithParam<StateScene> {
 protected:
  SecondScene() { remember_in_memory(executor); }
  ~SecondScene() override { cache::remember(0); }
  parallel::Executor executor{1};
};

TEST_P(SecondScene, OfTheSameTextMakesNothing) {
  const auto lines = [&] {
    Simulation running(GetParam().text, executor);
    return lines_of([&](Recorder* r) {
      for (int frame = 0; frame < 3; ++frame) running.next_frame(r);
    });
  };
  const std::vector<std::string> first = lines();
  const auto made = cache::times_made();
  EXPECT_EQ(lines(), first);
  EXPECT_EQ(cache::times_made(), made);
}
INSTANTIATE_TEST_SUITE_P(Scenes, SecondScene, testing::ValuesIn(scenes(true)), [](const auto& p) { return p.param.name; });

// What `describe --json` says that a key makes again is what another value of it makes.
TEST(PreparedThings, AreMadeAgainByTheKeysThatAreDeclared) {
  const parallel::Executor executor(1);
  using Pairs = std::set<std::pair<std::string, std::string>>;  // a thing and a key
  std::map<std::string, Pairs> found;                           // by effect
  // What these scenes do not show: the width that a panorama takes by itself, at least 1024 texels; switches that all of them have on; a
  // change of less than a texel.
  std::map<std::string, Pairs> unseen;
  for (const char* thing : {"night_street panorama", "puddle sky"})
    for (const char* key : {"run.size", "run.supersample", "camera.vertical_fov_deg"}) unseen["puddle"].emplace(thing, key);
  unseen["edge_splash"] = {{"depth picture", "scene.depth_encoding"}};
  unseen["rainy_glass"] = {{"rainy_glass bars", "glass.shape"}, {"rainy_glass near depth", "scene.bar_width"}};
  for (const bool with_street : {true, false})
    for (const StateScene& scene : scenes(with_street)) {
      remember_in_memory(executor);
      for (const Changed& change : every_change(scene.text, executor))
        for (const auto& [what, times] : change.made) found[change.effect].emplace(what, change.name);
    }
  cache::remember(0);
  for (const effect::Effect* effect : registry::effects()) {
    Pairs declared;
    for (const effect::Prepared& thing : effect->prepared)
      for (const std::string& key : thing.keys) {
        EXPECT_TRUE(declared.emplace(thing.name, key).second) << effect->name << ": " << thing.name << " declares " << key << " twice";
      }
    const auto without = [](const Pairs& all, const Pairs& known) {
      Pairs rest;
      std::ranges::set_difference(all, known, std::inserter(rest, rest.end()));
      return rest;
    };
    EXPECT_EQ(without(found[effect->name], declared), Pairs()) << effect->name << " reads and does not declare";
    EXPECT_EQ(without(declared, found[effect->name]), unseen[effect->name]) << effect->name << " declares and does not read";
  }
}

}  // namespace
}  // namespace rainref
