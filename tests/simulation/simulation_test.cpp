// One interface over all effects: what it holds is what the passes gave, and it shows what the command line shows.
#include "rainref/simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>

#include "base/error_of.h"
#include "callers/states.h"
#include "capture/hashing.h"
#include "image/images.h"
#include "rainref/error.h"
#include "rainref/windshield.h"
#include "registry/registry.h"
#include "scene/uniform_block.h"
#include "simulation/small_scenes.h"
#include "source_folder.h"
#include "base/temporary_folder.h"

namespace rainref {
namespace {

using testing::HasSubstr;

/// The last contents that passes gave, by buffer.
class Given : public Recorder {
 public:
  void pass(const PassCall& call) override {
    for (const PassOutput& output : call.outputs) last[std::string(output.name)] = bytes_of(output.content);
  }
  static std::string bytes_of(const std::variant<BufferView, RecordView>& content) {
    if (const auto* records = std::get_if<RecordView>(&content))
      return {reinterpret_cast<const char*>(records->bytes().data()), records->bytes().size()};
    return rainref::bytes_of(std::get<BufferView>(content));
  }
  std::map<std::string, std::string> last;
};

class EveryEffect : public testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(EveryEffect, HoldsWhatItsPassesGave) {
  const auto& [effect, variant] = GetParam();
  const parallel::Executor executor(2);
  Simulation scene(small(effect, variant), executor);
  EXPECT_EQ(scene.effect(), effect);
  EXPECT_EQ(name(scene.variant()), variant);
  EXPECT_EQ(scene.frame(), 0);
  Given given;
  for (int frame = 0; frame < 3; ++frame) scene.next_frame(&given);
  EXPECT_EQ(scene.frame(), 3);
  const capture::EffectInfo& info = *registry::find(effect)->info;
  int compared = 0;
  for (const std::string& name : scene.buffers()) {
    const capture::BufferInfo& declared = info.buffer(name, variant);
    const auto held = scene.buffer(name);
    EXPECT_EQ(std::holds_alternative<RecordView>(held), declared.format == "records") << name;
    if (!given.last.contains(name)) {
      // What the host makes, and no pass.
      EXPECT_THAT(name, testing::AnyOf("surface", "orientation", "height")) << "no pass gave " << name;
      continue;
    }
    EXPECT_EQ(Given::bytes_of(held), given.last[name]) << name;
    ++compared;
  }
  EXPECT_GE(compared, 3);
  EXPECT_EQ(Given::bytes_of(scene.picture()), given.last["picture"]);
}

// Buffers that passes name are declared, once in a variant, and every layout is one in each language.
TEST_P(EveryEffect, DeclaresWhatItsPassesName) {
  const auto& [effect, variant] = GetParam();
  const capture::EffectInfo& info = *registry::find(effect)->info;
  std::set<std::string> declared;
  for (const capture::BufferInfo& buffer : info.buffers) {
    if (!buffer.variant.empty() && buffer.variant != variant) continue;
    EXPECT_TRUE(declared.insert(buffer.name).second) << buffer.name << " is declared twice";
    if (buffer.format == "records") {
      EXPECT_NO_THROW(scene::validate_record(info.record(buffer.record))) << buffer.name;
    }
  }
  for (const std::string& name : info.pass_names(variant)) {
    const capture::PassInfo& pass = info.pass(name);
    EXPECT_NO_THROW(scene::validate(pass.block(variant))) << name;
    EXPECT_FALSE(info.writes(pass, variant).empty()) << name;
    for (const capture::ReadInfo& read : pass.reads)
      EXPECT_TRUE((!read.variant.empty() && read.variant != variant) || declared.contains(read.buffer)) << name << ' ' << read.buffer;
  }
}

// What has no past shows the same whether the frames before were rendered or not.
TEST_P(EveryEffect, AdvancesWithoutRendering) {
  const auto& [effect, variant] = GetParam();
  const parallel::Executor executor(1);
  Simulation all(small(effect, variant), executor), last(small(effect, variant), executor);
  for (int frame = 0; frame < 4; ++frame) {
    all.next_frame();
    last.simulate();
  }
  last.render();
  const std::string held = effect == "windshield" ? "drops" : "picture";  // its mask has a past
  EXPECT_EQ(Given::bytes_of(all.buffer(held)), Given::bytes_of(last.buffer(held)));
  if (effect != "windshield") {
    last.render();  // and once more
    EXPECT_EQ(Given::bytes_of(all.buffer(held)), Given::bytes_of(last.buffer(held)));
  }
}

std::vector<std::pair<std::string, std::string>> all() {
  std::vector<std::pair<std::string, std::string>> out;
  for (const effect::Effect* e : registry::effects()) {
    for (const std::string& variant : e->variants) out.emplace_back(e->name, variant);
  }
  return out;
}
INSTANTIATE_TEST_SUITE_P(Simulation, EveryEffect, testing::ValuesIn(all()),
                         [](const auto& p) { return p.param.first + (p.param.second == "corrected" ? "_corrected" : "_as_published"); });

std::string refusal(const auto& body) {
  const std::string error = error_of(body);
  EXPECT_TRUE(error.starts_with("2 ")) << error;
  return error.substr(2);
}

TEST(Simulation, WhatCannotBeIsRefused) {
  const parallel::Executor executor(1);
  const auto open = [&](const SceneText& scene) { return refusal([&] { Simulation(scene, executor); }); };
  EXPECT_THAT(open({}), HasSubstr("effect"));
  EXPECT_THAT(open({"", {"effect=pudle"}}), HasSubstr("did you mean 'puddle'?"));
  EXPECT_THAT(open({"effect = 'puddle'\n[wave]\nspeeed = 1\n", {}, "mine.toml"}), HasSubstr("mine.toml:3:1: wave.speeed: "));
  Simulation scene(small("puddle", "corrected"), executor);
  EXPECT_THAT(refusal([&] { static_cast<void>(scene.buffer("colours")); }),
              HasSubstr("puddle has no buffer 'colours'; did you mean 'colour'?"));
}

TEST(Simulation, EffectsAreListedAndDescribed) {
  std::vector<std::string> names;
  for (const effect::Effect* e : registry::effects()) names.push_back(e->name);
  EXPECT_EQ(effect_names(), names);
  for (const std::string& name : effect_names()) EXPECT_THAT(describe(name), HasSubstr("\"effect\": \"" + name + "\""));
  EXPECT_THAT(refusal([] { static_cast<void>(describe("pudle")); }), HasSubstr("did you mean 'puddle'?"));
}

TEST(Simulation, GivesTheLinesOfHash) {
  const parallel::Executor executor(1);
  Simulation scene(small("puddle", "corrected"), executor), other(small("puddle", "corrected"), executor);
  capture::HashRecorder recorder;
  for (int frame = 0; frame < 2; ++frame) {
    other.next_frame(&recorder);
    std::vector<std::string> expected;
    for (const capture::HashLine& line : recorder.take_lines()) expected.push_back(line.text());
    EXPECT_EQ(scene.next_frame_hashes(), expected);
    EXPECT_GT(expected.size(), 3u);
    EXPECT_TRUE(expected[0].starts_with(std::to_string(frame) + " "));
  }
  EXPECT_EQ(scene.frame(), 2);
  for (const test::CallerState& state : test::decisive_states()) {
    Simulation fresh(small("puddle", "corrected"), executor), hostile(small("puddle", "corrected"), executor);
    std::vector<std::string> found;
    test::CalledIn called(state);
    called([&] { found = hostile.next_frame_hashes(); });
    EXPECT_EQ(found, fresh.next_frame_hashes()) << state.name;
    EXPECT_TRUE(called.kept()) << state.name;
  }
}

TEST(Simulation, AFilmIsWholeOrNotThere) {
  const TemporaryFolder folder;
  const parallel::Executor executor(1);
  Simulation scene(small("edge_splash", "corrected", {"run.frames=4"}), executor);
  const auto refused = [&](const std::string& name, const FilmOptions& options) {
    const std::string why = refusal([&] { scene.film(folder / name, options); });
    EXPECT_EQ(scene.frame(), 0) << name;
    return why;
  };
  EXPECT_THAT(refused("a.avi", {}), HasSubstr("expected a name that ends in .mp4, .webm or .gif"));
  EXPECT_THAT(refused("a.mp4", {.frames = -3}), HasSubstr("film: frames: expected 0 or more, found -3"));
  EXPECT_THAT(refused("a.mp4", {.every = 0}), HasSubstr("film: every: expected 1 or more, found 0"));
  for (int frame = 0; frame < 3; ++frame) scene.next_frame();
  EXPECT_THAT(refusal([&] { scene.film(folder / "a.mp4", {.frames = 1, .every = 5}); }), HasSubstr("none from 3 to 3 that 5 divides"));
  scene.next_frame();
  EXPECT_THAT(refusal([&] { scene.film(folder / "a.mp4"); }), HasSubstr("film: frames: expected some that remain of run.frames, found 0"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Simulation, TheVariantIsCorrectedUnlessSaid) {
  const parallel::Executor executor(1);
  EXPECT_EQ(Simulation({"effect = 'edge_splash'\n[run]\nsize = [16, 9]\n"}, executor).variant(), Variant::corrected);
  EXPECT_EQ(Simulation({"effect = 'edge_splash'\nvariant = 'as-published'\n[run]\nsize = [16, 9]\n"}, executor).variant(),
            Variant::as_published);
}

TEST(Simulation, ReadsSceneFilesAndWritesPictures) {
  const TemporaryFolder folder;
  const parallel::Executor executor(1);
  Simulation scene(read_scene(test::source_folder() + "/scenes/edge_splash/default.toml", {"run.size=[16, 9]", "run.frames=7"}), executor);
  EXPECT_EQ(scene.frames(), 7);
  EXPECT_THAT(scene.scene_json(), HasSubstr("\"effect\": \"edge_splash\""));
  EXPECT_TRUE(scene.warnings().empty());
  scene.next_frame();
  scene.write_png(folder / "a.png");
  scene.write_exr(folder / "a.exr");
  const auto start = [&](const char* name) {
    std::string bytes(4, '\0');
    std::ifstream(folder / name, std::ios::binary).read(bytes.data(), 4);
    return bytes;
  };
  EXPECT_EQ(start("a.png"), "\x89PNG");
  EXPECT_EQ(start("a.exr"), "\x76\x2f\x31\x01");
  EXPECT_THROW(read_scene(folder / "none.toml"), Error);
  // A picture is a scene too.
  for (const char* name : {"a.png", "a.exr"}) {
    Simulation again(read_scene(folder / name), executor);
    EXPECT_EQ(again.frames(), 1);
    again.next_frame();
    again.write_png(folder / "again.png");
    EXPECT_TRUE(contents(folder / "again.png") == contents(folder / "a.png")) << name;
  }
}

TEST(StreetAtNight, IsTheOneThatSimulationsDriveAlong) {
  const parallel::Executor executor(2);
  const SceneText scene = small("windshield", "corrected", {"seed=3", "vehicle.speed=10"});
  Simulation simulation(scene, executor);
  windshield::Windshield alone(scene, {{}, {}, street_at_night(3)}, executor), elsewhere(scene, {{}, {}, street_at_night(4)}, executor);
  for (int frame = 0; frame < 2; ++frame) {
    simulation.next_frame();
    alone.next_frame();
    elsewhere.next_frame();
  }
  const auto hash = [](const Image& picture) { return capture::hash_of(picture).text(); };
  EXPECT_EQ(hash(alone.picture()), hash(simulation.picture()));
  EXPECT_NE(hash(elsewhere.picture()), hash(simulation.picture()));
}

}  // namespace
}  // namespace rainref
