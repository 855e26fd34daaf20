// A run that is saved and loaded goes on with the bits of the run that was not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <set>

#include "night_street/night_street.h"
#include "simulation/every_state.h"
#include "state/file.h"
#include "windshield/instance.h"

namespace rainref {
namespace {

constexpr int starts[] = {0, 1, 7, 30};
constexpr int frames = 33, half_way = 7;

class EveryState : public testing::TestWithParam<StateScene> {
 protected:
  const parallel::Executor executor{1};
};

TEST_P(EveryState, GoesOnWithTheSameBits) {
  const StateScene& scene = GetParam();
  // Never saved, by frame; and render of one frame, apart.
  std::vector<std::vector<std::string>> whole;
  std::vector<std::string> rendered;
  const auto uninterrupted = open(scene, executor);
  for (int frame = 0; frame < frames; ++frame) {
    whole.push_back(lines_of([&](Recorder* r) { uninterrupted->simulate(r); }));
    const auto of_render = lines_of([&](Recorder* r) { uninterrupted->render(r); });
    if (frame == half_way) rendered = of_render;
    whole.back().insert(whole.back().end(), of_render.begin(), of_render.end());
  }

  // Saved on the way, which changes nothing.
  std::map<int, std::vector<std::byte>> states;
  std::vector<std::byte> simulated;  // between simulate and render of a frame
  const auto run = open(scene, executor);
  for (int frame = 0; frame < frames; ++frame) {
    if (std::ranges::find(starts, frame) != std::end(starts)) states[frame] = saved(*run);
    capture::HashRecorder recorder;
    run->simulate(&recorder);
    if (frame == half_way) simulated = saved(*run);
    run->render(&recorder);
    EXPECT_EQ(texts_of(recorder), whole[static_cast<std::size_t>(frame)]) << frame;
  }

  for (const int start : starts) {
    const auto fresh = open(scene, executor);
    const state::Saved state(states[start], "state");
    // One that did nothing yet, and one that is beyond.
    for (simulation::Opened* loaded : {fresh.get(), run.get()}) {
      loaded->load(state);
      EXPECT_EQ(loaded->frame(), start);
      EXPECT_EQ(saved(*loaded), states[start]) << start;
      for (int frame = start; frame < start + 3; ++frame)
        EXPECT_EQ(lines_of_frame(*loaded), whole[static_cast<std::size_t>(frame)]) << "from " << start << ", frame " << frame;
    }
  }
  const auto fresh = open(scene, executor);
  for (simulation::Opened* loaded : {fresh.get(), run.get()}) {
    loaded->load(state::Saved(simulated, "state"));
    EXPECT_EQ(loaded->frame(), half_way + 1);
    EXPECT_EQ(lines_of([&](Recorder* r) { loaded->render(r); }), rendered);
    EXPECT_EQ(lines_of_frame(*loaded), whole[half_way + 1]);
  }
}

// `pack` looks for the passes of pictures in the first ones alone.
TEST_P(EveryState, APassOfPicturesRunsInTheFirstOne) {
  struct Names : Recorder {
    std::set<std::string> names;
    bool reads(int, std::string_view) const override { return false; }
    void pass(const PassCall& call) override { names.emplace(call.pass); }
  } first, later;
  const auto run = open(GetParam(), executor);
  for (int frame = 0; frame < 12; ++frame) {
    run->simulate(nullptr);
    run->render(frame == 0 ? &first : &later);
  }
  EXPECT_FALSE(first.names.empty());
  for (const std::string& name : later.names) EXPECT_TRUE(first.names.contains(name)) << name;
}

// Frames that are skipped leave what rendered ones leave.
TEST_P(EveryState, SkippedFramesChangeNoPicture) {
  const StateScene& scene = GetParam();
  const auto all = open(scene, executor), some = open(scene, executor);
  for (int frame = 0; frame < 12; ++frame) {
    const std::vector<std::string> wanted = lines_of_frame(*all);
    some->simulate(nullptr);
    if (frame < 9) {
      some->skip(nullptr);
      continue;
    }
    const std::vector<std::string> found = lines_of([&](Recorder* r) { some->render(r); });
    for (const std::string& line : found) {
      // What a still scene gives once, it gives in the first frame that is rendered.
      if (frame == 9 && (line.find(" background ") != std::string::npos || line.find(" bake_") != std::string::npos)) continue;
      EXPECT_THAT(wanted, testing::Contains(line));
    }
    EXPECT_THAT(found.back(), testing::HasSubstr(" display picture "));
  }
}

using Bytes = std::vector<std::byte>;

/// An effect whose items a test can get at.
struct Reached {
  effect::Inputs inputs;
  std::unique_ptr<effect::Instance> instance;

  Reached(const StateScene& scene, const parallel::Executor& executor) {
    const scene::Config config = scene::parse(scene.text, simulation::effect_table());
    inputs.street = night_street::Street::make;
    instance = registry::find(config.effect())->open(config, executor, inputs);
  }
  state::Items items() const {
    state::Items listed;
    instance->list_state(listed);
    return listed;
  }
  static Bytes bytes_of(const state::Item& item) {
    Bytes bytes;
    for (std::uint64_t row = 0; row < item.rows; ++row) bytes.insert(bytes.end(), item.row(row), item.row(row) + item.row_bytes());
    return bytes;
  }
  Bytes save() const {
    Bytes bytes;
    state::write({}, items(), [&](std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); });
    return bytes;
  }
  void load(const Bytes& bytes) const { state::load(state::Saved(bytes, "state"), items()); }
};

/// A moment of a run, and what it records from there on.
struct Moment {
  const char* name;
  Bytes state;
  std::vector<std::string> after;
};
std::vector<std::string> after(const std::string& moment, effect::Instance& instance, bool renders_twice) {
  return lines_of([&](Recorder* r) {
    if (moment != "between frames" && (moment == "simulated" || renders_twice)) instance.render(r);
    for (int frame = 0; frame < 4; ++frame) {
      instance.simulate(r);
      instance.render(r);
    }
  });
}

/// The moments of a scene that a state may be of.
std::vector<Moment> moments_of(const StateScene& scene, const parallel::Executor& executor, bool renders_twice) {
  std::vector<Moment> moments;
  for (const char* moment : {"between frames", "simulated", "rendered"}) {
    Reached run(scene, executor);
    for (int frame = 0; frame < 12; ++frame) {
      run.instance->simulate(nullptr);
      run.instance->render(nullptr);
    }
    run.instance->simulate(nullptr);
    if (std::string(moment) != "simulated") run.instance->render(nullptr);
    Bytes state = run.save();
    moments.push_back({moment, std::move(state), after(moment, *run.instance, renders_twice)});
  }
  return moments;
}
/// Loads a state, but an item as it was in the beginning; of drops that were not there then, zero.
void load_without(const Reached& run, const Bytes& state, const Bytes& beginning, std::size_t item) {
  run.load(beginning);
  const Bytes before = Reached::bytes_of(run.items().all()[item]);
  run.load(state);
  const state::Items items = run.items();
  const state::Item& left_out = items.all()[item];
  const std::size_t bytes = left_out.row_bytes();
  for (std::uint64_t row = 0; row < left_out.rows && bytes > 0; ++row) {
    std::memset(left_out.row(row), 0, bytes);
    if (before.size() == bytes * left_out.rows) std::memcpy(left_out.row(row), before.data() + row * bytes, bytes);
  }
  items.finish();
}

class EveryItem : public testing::TestWithParam<std::string> {};

// Negative controls: in some scene of the effect and variant each item that is left out changes what is recorded later.
TEST_P(EveryItem, IsNotIdle) {
  const parallel::Executor executor(1);
  std::map<std::string, bool> seen;  // by name
  for (const StateScene& scene : state_scenes()) {
    if (!scene.name.starts_with(GetParam())) continue;
    const bool renders_twice = !scene.name.starts_with("windshield");
    const Reached run(scene, executor);
    const Bytes beginning = run.save();
    const state::Items items = run.items();
    if (std::all_of(items.all().begin(), items.all().end(), [&](const state::Item& item) { return seen[item.name]; })) continue;
    const std::vector<Moment> moments = moments_of(scene, executor, renders_twice);
    for (const Moment& moment : moments) {
      run.load(moment.state);
      EXPECT_EQ(after(moment.name, *run.instance, renders_twice), moment.after) << scene.name << ", " << moment.name;
    }
    for (std::size_t i = 0; i < items.all().size(); ++i) {
      bool& is_seen = seen[items.all()[i].name];
      for (const Moment& moment : moments) {
        if (is_seen) break;
        load_without(run, moment.state, beginning, i);
        is_seen = after(moment.name, *run.instance, renders_twice) != moment.after;
      }
    }
  }
  EXPECT_FALSE(seen.empty());
  for (const auto& [name, is_seen] : seen) {
    // Sums of water change what is said of it. On glass that stands upright nothing moves sideways.
    const std::string last = name.substr(name.rfind('.') + 1);
    const bool is_told_alone = last == "spawned" || last == "evaporated" || last == "removed" || last == "to_film";
    EXPECT_EQ(is_seen, !is_told_alone && name != "flow.velocity_u") << name;
  }
}
INSTANTIATE_TEST_SUITE_P(Effects, EveryItem,
                         testing::Values("puddle_published", "puddle_corrected", "edge_splash_published", "edge_splash_corrected",
                                         "screen_drops_published", "screen_drops_corrected", "rainy_glass_published",
                                         "rainy_glass_corrected", "windshield_published", "windshield_corrected"),
                         [](const auto& p) { return p.param; });

// What passes declare to read of a run before is among the items, under its own name or as what it is made of.
TEST(StateItems, HoldWhatPassesReadOfBefore) {
  const parallel::Executor executor(1);
  const std::map<std::string, std::string> made_of{
      {"wave", "previous"}, {"drops", "life"}, {"previous_height", "height"}, {"necks", "neck_left"}};
  std::map<std::string, std::set<std::string>> listed, wanted;  // by effect and variant
  for (const StateScene& scene : state_scenes()) {
    const scene::Config config = scene::parse(scene.text, simulation::effect_table());
    const std::string which = config.effect() + " " + config.variant();
    const Reached run(scene, executor);
    const state::Items items = run.items();
    for (const state::Item& item : items.all()) listed[which].insert(item.name.substr(item.name.rfind('.') + 1));
    for (const capture::PassInfo& pass : registry::find(config.effect())->info->passes) {
      for (const capture::ReadInfo& read : pass.reads) {
        if (!read.previous || !pass.variant(config.variant()) || (!read.variant.empty() && read.variant != config.variant())) continue;
        wanted[which].insert(made_of.contains(read.buffer) ? made_of.at(read.buffer) : read.buffer);
      }
    }
  }
  EXPECT_EQ(wanted["windshield corrected"], (std::set<std::string>{"clear_time", "film", "laid", "life", "neck_left", "wiped"}));
  for (const auto& [which, names] : wanted) {
    for (const std::string& name : names) EXPECT_TRUE(listed[which].contains(name)) << which << ": " << name;
  }
}

// What the sums of water say goes on.
TEST(WindshieldState, BalancesItsWater) {
  const parallel::Executor executor(1);
  const StateScene scene{"", small("windshield", "corrected", {"scene.moves=false", "run.fps=30", "rain.rate=200"})};
  const Reached whole(scene, executor), loaded(scene, executor);
  const auto balance = [](const Reached& run) { return dynamic_cast<const windshield::Instance&>(*run.instance).running().mass_balance(); };
  const auto play = [](const Reached& run) {
    for (int frame = 0; frame < 6; ++frame) {
      run.instance->simulate(nullptr);
      run.instance->render(nullptr);
    }
  };
  play(whole);
  loaded.load(whole.save());
  play(whole);
  play(loaded);
  const windshield::MassBalance a = balance(whole), b = balance(loaded);
  EXPECT_GT(a.spawned, 0);
  EXPECT_EQ(a.residual(), 0);
  EXPECT_EQ(b.residual(), 0);
  EXPECT_EQ((std::array{a.spawned, a.evaporated, a.removed, a.film, a.drops}),
            (std::array{b.spawned, b.evaporated, b.removed, b.film, b.drops}));
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryState, testing::ValuesIn(state_scenes()), [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace rainref
