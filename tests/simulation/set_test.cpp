// Simulation: states as bytes, and keys that change while it runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "base/error_of.h"
#include "base/hash.h"
#include "base/hostile_state.h"
#include "rainref/error.h"
#include "rainref/simulation.h"
#include "simulation/every_state.h"

namespace rainref {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

std::vector<std::string> next_lines(Simulation& running, int frames = 1) {
  return lines_of([&](Recorder* r) {
    for (int k = 0; k < frames; ++k) running.next_frame(r);
  });
}
void advance(Simulation& running, int frames) {
  for (int k = 0; k < frames; ++k) running.next_frame();
}
std::string refusal(const auto& body) {
  const std::string error = error_of(body);
  EXPECT_TRUE(error.starts_with("2 ")) << error;
  return error.substr(2);
}

class EverySet : public testing::TestWithParam<StateScene> {};

// A value in a scene that says it already, set anew while the scene runs.
TEST_P(EverySet, TheSameValueChangesNoBit) {
  const parallel::Executor executor(1);
  Simulation plain(GetParam().text, executor), changed(GetParam().text, executor);
  advance(plain, 6);
  advance(changed, 6);
  changed.set("run.size", "[33, 21]");
  EXPECT_EQ(changed.frame(), 6);
  EXPECT_EQ(changed.save(), plain.save());
  EXPECT_EQ(next_lines(changed, 2), next_lines(plain, 2));
}
INSTANTIATE_TEST_SUITE_P(Scenes, EverySet, testing::ValuesIn(state_scenes()), [](const auto& p) { return p.param.name; });

TEST(Set, ChangesWhatComes) {
  const parallel::Executor executor(1);
  const SceneText dry = small("puddle", "corrected", {"rain.rate=0"});
  Simulation changed(dry, executor), plain(dry, executor), rainy(small("puddle", "corrected", {"rain.rate=60"}), executor);
  advance(changed, 5);
  advance(plain, 5);
  changed.set("rain.rate", "60");
  EXPECT_THAT(changed.scene_json(), HasSubstr("\"rain.rate\": 60"));
  // Of still water the rain is that of a scene that began dry: drops are a function of seed and step.
  for (int frame = 0; frame < 5; ++frame) rainy.simulate();
  EXPECT_NE(next_lines(changed), next_lines(plain));
  EXPECT_EQ(changed.frame(), 6);
  changed.set("rain.rate", "0");
  changed.set("rain.rate", "60");
  EXPECT_EQ(changed.frame(), 6);
}

TEST(Set, WhatCannotBeCarriedIsNamed) {
  const parallel::Executor executor(1);
  Simulation puddle(small("puddle", "corrected"), executor), pane(small("windshield", "corrected", {"scene.moves=false"}), executor);
  advance(puddle, 2);
  advance(pane, 8);
  const auto refused = [](Simulation& running, const std::string& key, const std::string& value) {
    const Bytes before = running.save();
    const std::string what = refusal([&] { running.set(key, value); });
    EXPECT_EQ(running.save(), before) << key;
    return what;
  };
  EXPECT_THAT(
      refused(puddle, "puddle.storage", "rgba8"),
      HasSubstr(
          "puddle.storage: cannot change while the simulation runs: state: expected newest u8 [45, 61, 1], found newest f16 [45, 61, 1]"));
  EXPECT_THAT(refused(puddle, "puddle.grid", "[62, 45]"), HasSubstr("puddle.grid: cannot change while the simulation runs"));
  EXPECT_THAT(refused(puddle, "effect", "windshield"), HasSubstr("unknown key of 'windshield'"));
  EXPECT_THAT(refused(pane, "windshield.height_size", "[65, 36]"), HasSubstr("windshield.height_size: cannot change"));
  EXPECT_THAT(refused(pane, "windshield.capacity", "1"),
              HasSubstr("windshield.capacity: cannot change while the simulation runs: state: expected "
                        "windshield.u f32 [up to 1, as long as its neighbours], found windshield.u f32 ["));
  EXPECT_THAT(refused(pane, "windshield.panes", "1.0 0.75 0.95, 1.9 0.8 1.0, 1.1 0.7 1.4"), HasSubstr("windshield.panes: cannot change"));
  EXPECT_THAT(refused(pane, "variant", "as-published"), HasSubstr("rain.rate"));
  EXPECT_THAT(refused(pane, "rain.rte", "1"), HasSubstr("did you mean 'rain.rate'?"));
  EXPECT_THAT(refused(pane, "rain.rate", "a lot"), HasSubstr("rain.rate"));
  EXPECT_THAT(refused(pane, "seed=5 #", "1"), HasSubstr("'seed=5 #': expected a key such as seed"));
  pane.set("windshield.capacity", "4000");  // more room is no matter
  Simulation splash(small("edge_splash", "corrected"), executor);
  EXPECT_THAT(refused(splash, "variant", "as-published"),
              HasSubstr("variant: cannot change while the simulation runs: expected \"corrected\", found \"as-published\""));
  EXPECT_THAT(refused(splash, "effect", "screen_drops"), HasSubstr("effect: cannot change while the simulation runs"));
}

TEST(SavedSimulation, IsOfItsSceneAndPictures) {
  const parallel::Executor executor(1);
  Simulation running(small("puddle", "corrected", {"run.frames=5"}), executor);
  advance(running, 3);
  const Bytes state = running.save();
  Simulation longer(small("puddle", "corrected", {"run.frames=50"}), executor);
  longer.load(state);  // where a run ends says nothing of its beginning
  EXPECT_EQ(longer.frame(), 3);
  EXPECT_EQ(next_lines(longer), next_lines(running));

  const auto refused = [&](const std::string& effect, const std::string& variant, std::vector<std::string> more) {
    Simulation other(small(effect, variant, std::move(more)), executor);
    advance(other, 1);
    const Bytes before = other.save();
    const std::string what = refusal([&] { other.load(state); });
    EXPECT_EQ(other.save(), before);
    return what;
  };
  EXPECT_THAT(refused("puddle", "corrected", {"rain.rate=5"}), HasSubstr("state: of another scene: expected 'rain.rate = 5"));
  EXPECT_THAT(refused("puddle", "corrected", {"seed=9"}), HasSubstr("expected 'seed = 9', found 'seed = 0'"));
  EXPECT_THAT(refused("edge_splash", "corrected", {}), HasSubstr("expected 'effect = \"edge_splash\"', found 'effect = \"puddle\"'"));
  EXPECT_THAT(refused("puddle", "as-published", {}), HasSubstr("variant"));
}

TEST(SavedSimulation, KnowsItsPictures) {
  const parallel::Executor executor(1);
  const TemporaryFolder folder;
  const std::string name = (folder / "sky.npy").string();
  const auto put_texel = [&](char texel) { put(name, npy("'|u1'", "(1, 2, 3)", std::string(6, texel))); };
  const SceneText scene = small("puddle", "corrected", {"environment.image=" + name});
  put_texel(30);
  const Bytes state = Simulation(scene, executor).save();
  Simulation(scene, executor).load(state);
  put_texel(31);
  EXPECT_THAT(refusal([&] { Simulation(scene, executor).load(state); }), HasSubstr("of another picture: expected 'environment.image "));
}

TEST(SavedSimulation, IsTheSameInEveryFloatingPointState) {
  const parallel::Executor executor(1);
  const SceneText scene = small("windshield", "corrected", {"scene.moves=false", "falling_rain.on=true", "run.fps=30"});
  const auto play = [&](Simulation& first, Simulation& second) {
    for (int frame = 0; frame < 5; ++frame) {
      first.simulate();
      first.skip();
    }
    second.load(first.save());
    second.set("rain.rate", "33.3");
    advance(second, 2);
    return second.save();
  };
  Simulation a(scene, executor), b(scene, executor);
  const Bytes wanted = play(a, b);
  const test::KeepFloatingPoint keep;
  for (const test::HostileState& state : test::hostile_states()) {
    Simulation first(scene, executor), second(scene, executor);
    set_floating_point_control(state.control);
    const Bytes found = play(first, second);
    EXPECT_EQ(floating_point_control(), state.control);
    set_floating_point_control(pinned_floating_point_control);
    EXPECT_EQ(found, wanted) << state.name;
  }
}

// What nobody saved: bytes changed and sealed anew are refused, or run.
TEST(SavedSimulation, CraftedStatesRunOrAreRefused) {
  const parallel::Executor executor(1);
  std::mt19937 random(3);
  for (const StateScene& scene : state_scenes()) {
    if (!scene.name.ends_with("rg16f") && !scene.name.ends_with("flow") && !scene.name.ends_with("panes") &&
        !scene.name.ends_with("trails"))
      continue;
    Simulation running(scene.text, executor);
    advance(running, 9);
    const Bytes state = running.save();
    int refused = 0, taken = 0;
    for (int k = 0; k < 60; ++k) {
      Bytes other = state;
      const std::size_t body = 40, changes = 1 + random() % 8;
      for (std::size_t c = 0; c < changes; ++c) other[body + random() % (other.size() - 16 - body)] = static_cast<std::byte>(random());
      Hasher hasher(0);
      hasher.add(std::span(other).first(other.size() - 16));
      const Hash128 hash = hasher.finish();
      std::memcpy(other.data() + other.size() - 16, &hash.low, 8);
      std::memcpy(other.data() + other.size() - 8, &hash.high, 8);
      try {
        running.load(other);
        ++taken;
      } catch (const Error& e) {
        EXPECT_EQ(e.code(), ExitCode::usage) << e.what();
        ++refused;
      }
      advance(running, 1);
    }
    EXPECT_GT(refused, 0) << scene.name;
    EXPECT_GT(taken, 0) << scene.name;
    running.load(state);
    EXPECT_EQ(running.save(), state);
  }
}

}  // namespace
}  // namespace rainref
