// A port's own run, judged one step at a time.
#include "judge/shadow.h"

#include "faults/diagnose.h"
#include "registry/registry.h"
#include "judge/mini_port.h"
#include "judge/port_files.h"
#include "judge/rearrange.h"

#include <cmath>
#include <cstring>

#include <gmock/gmock.h>

namespace rainref::judge {
namespace {

using capture::Array;
using capture::PassCase;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

/// The two frames of a small pack as a run of its own, two wave steps in each.
class ShadowTest : public testing::Test {
 protected:
  explicit ShadowTest(const std::string& name = "puddle-corrected") : port(name) { port.free_running = true; }

  PortJudgement shadow_of(const std::vector<std::string>& only = {}) {
    port.run(folder.path());
    return judge_dump(only);
  }
  PortJudgement judge_dump(const std::vector<std::string>& only = {}) const {
    const ShadowPlan plan = is_of_scene ? of_scene() : ShadowPlan::of_manifest(port.pack, false);
    std::vector<std::string> passes;
    for (const capture::PackPass& p : plan.passes) passes.push_back(p.name);
    ValidateOptions options;
    options.executor = &test_executor();
    options.explain = faults::diagnose;
    options.only = only;
    options.foreign_host = is_foreign;
    return shadow(plan, folder.path(), dumped_runs(folder.path(), plan.effect, passes), options);
  }
  /// The pack's first frame as the scene's first.
  int first_frame() const { return port.pack.cases.front().frame; }
  ShadowPlan of_scene() const {
    const capture::EffectInfo& info = *registry::find(port.pack.effect)->info;
    ShadowPlan plan = ShadowPlan::of_effect(info, port.pack.variant, "scene.toml");
    for (const capture::PackCase& entry : port.pack.cases) {
      PassCase c = port.pack.read(entry);
      c.frame -= first_frame();
      plan.add(c, info);
    }
    return plan;
  }
  std::filesystem::path file(const std::string& name) const { return folder / name; }
  MiniPort port;
  TemporaryFolder folder;
  bool is_foreign = false, is_of_scene = false;
};

/// A port that runs the scene from its first frame on, whose host makes mistakes: what follows from them is right.
class HostShadowTest : public ShadowTest {
 protected:
  explicit HostShadowTest(const std::string& name = "puddle-corrected") : ShadowTest(name) {
    is_of_scene = true;
    port.before = [this](PassCase& c) {
      c.frame -= first_frame();
      loosen_bounds(c);
      if (mistake) mistake(c);
    };
  }
  std::function<void(PassCase&)> mistake;

  /// The host makes bounds of the port's own water, which a mistake may have raised above the pack's: theirs are four times as large.
  void loosen_bounds(PassCase& c) const {
    if (c.pass != "surface_hit") return;
    const auto scale = [](std::byte* at) { change_at<float>(at, [](float value) { return 4 * value; }); };
    for (const char* name : {"surface_top", "surface_slope"}) scale(c.uniforms.data() + uniform_offset(port.pack, "surface_hit", name));
    std::vector<std::byte>& texels = input_of(c, "bounds").array.levels[0].edit();
    for (std::size_t at = 0; at < texels.size(); at += 4) scale(&texels[at]);
  }
  /// Makes of a float of every run of a pass what `change` gives.
  void change(const std::string& pass, const std::string& name, const std::function<float(float)>& change) {
    const std::size_t at = uniform_offset(port.pack, pass, name);
    mistake = [=](PassCase& c) {
      if (c.pass == pass) change_at<float>(c.uniforms.data() + at, change);
    };
  }
  /// Fails for the host alone, in that pass first; a foreign host is forgiven with a note.
  void expect_only_foreign(const std::string& pass, const std::string& reason, const std::string& note) {
    PortJudgement j = shadow_of();
    EXPECT_EQ(j.status, Status::fail) << why(j);
    EXPECT_EQ(j.first_bad_pass, pass) << why(j);
    EXPECT_THAT(pass_of(j, pass).reason, AllOf(HasSubstr(reason), HasSubstr("--foreign-host")));
    for (const PassJudgement& p : j.passes)
      for (const CaseJudgement& c : p.cases) EXPECT_EQ(c.failing, 0) << c.id;
    is_foreign = true;
    j = judge_dump();
    EXPECT_NE(j.status, Status::fail) << why(j);
    EXPECT_THAT(j.notes, Contains(HasSubstr(note))) << why(j);
  }
  /// Is no failure, and told.
  void expect_noted(const std::string& note) {
    const PortJudgement j = shadow_of();
    EXPECT_EQ(j.status, Status::pass) << why(j);
    EXPECT_THAT(j.notes, Contains(HasSubstr(note))) << why(j);
  }
};

// A step is computed from what the port took. A form that rounds does not tell it, and no record is expected that would give an id.
TEST_F(ShadowTest, AFormThatLeavesAnInputOpenJudgesNothing) {
  port.run(folder.path());
  put(file("port.json"), R"({"encodings": {"wave": ["x+1", "y+1"]}})");
  const PortJudgement j = judge_dump();
  EXPECT_EQ(pass_of(j, "wave_step").status, Status::untested) << why(j);
  EXPECT_THAT(pass_of(j, "wave_step").reason + pass_of(j, "wave_step").cases.front().reason,
              HasSubstr("encodings.wave: its form rounds, so what the run took is not known to the bit"));
  EXPECT_EQ(pass_of(j, "display").status, Status::pass) << why(j);
  put(file("port.json"), R"({"encodings": {"drops": {"members": ["x"]}}})");
  EXPECT_THAT(error_of([&] { judge_dump(); }),
              AllOf(StartsWith("3 "), HasSubstr("encodings.drops: expected whole records, found some members")));
}

// Truncating stores and fused products: after four steps its water is not the reference's, and every step is right.
TEST_F(ShadowTest, AFreeRunOfAConformingDevicePasses) {
  port.stores = HalfMode::rtz;
  port.behaviour.fault = perturbed::Fault::fused;
  const PortJudgement j = shadow_of();
  EXPECT_EQ(j.status, Status::pass) << why(j);
  // Against the pack, whose water is the reference's, the same dump fails: that is what the shadow is for.
  EXPECT_EQ(judge(port.pack, folder.path()).status, Status::fail);
  EXPECT_EQ(pass_of(j, "wave_step").half_mode, HalfMode::rtz);
  EXPECT_TRUE(pass_of(j, "display").inputs_are_good);
  EXPECT_THAT(j.notes, Contains(HasSubstr("wave_step was not compared with the output of wave_step, which is not there in 1 run")));
}

TEST_F(ShadowTest, TheFirstBadRunIsNamedAndWhatFollowsFromItIsNot) {
  port.after = [](const PassCase& c, std::vector<Array>& out) {
    if (c.folder() != "puddle.wave_step/0011.1") return;
    const std::uint16_t height = 0x2c00;  // 1/16 m where the water moves by millimetres
    std::memcpy(out[0].levels[0].edit().data() + 4 * (9 * 29 + 14), &height, 2);
  };
  const PortJudgement j = shadow_of();
  EXPECT_EQ(j.first_bad_pass, "wave_step") << why(j);
  EXPECT_THAT(j.notes, Contains("the first bad run is puddle.wave_step/0011.1"));
  const PassJudgement& wave = pass_of(j, "wave_step");
  EXPECT_TRUE(wave.inputs_are_good);
  EXPECT_EQ(wave.cases[0].failing + wave.cases[2].failing + wave.cases[3].failing, 0);
  ASSERT_EQ(wave.cases[1].outputs[0].failing, 1);
  EXPECT_EQ(wave.cases[1].outputs[0].worst[0].x, 14);
  // Two steps and the picture follow from the wrong water, rightly.
  for (const char* pass : {"shade", "display"}) {
    EXPECT_EQ(pass_of(j, pass).status, Status::pass) << why(j);
    EXPECT_FALSE(pass_of(j, pass).inputs_are_good);
  }
}

TEST_F(ShadowTest, ABadPassBehindGoodOnesHasGoodInputs) {
  port.after = [](const PassCase& c, std::vector<Array>& out) {
    if (c.pass == "display") flip_rows(out[0]);
  };
  const PortJudgement j = shadow_of();
  EXPECT_EQ(j.first_bad_pass, "display");
  EXPECT_TRUE(pass_of(j, "display").inputs_are_good) << why(j);
  ASSERT_FALSE(pass_of(j, "display").causes.empty());
  EXPECT_EQ(pass_of(j, "display").causes[0].name, "upside down");
}

TEST_F(ShadowTest, SwappedChannelsOfAnInputAreNamed) {
  port.before = [](PassCase& c) {
    if (c.folder() == "puddle.wave_step/0012.0") swap_channels(input_of(c, "wave").array, 0, 1);
  };
  const PortJudgement j = shadow_of();
  const PassJudgement& wave = pass_of(j, "wave_step");
  EXPECT_EQ(wave.status, Status::fail);
  EXPECT_THAT(wave.reason,
              AllOf(HasSubstr("input puddle.wave_step/0012.0/in.wave is not the previous output puddle.wave_step/0011.1/out.wave"),
                    HasSubstr("with its first two channels swapped: ping-pong order")));
  EXPECT_FALSE(wave.inputs_are_good);
  for (const CaseJudgement& c : wave.cases) EXPECT_EQ(c.failing, 0) << c.id;  // its arithmetic is right
}

TEST_F(ShadowTest, AStaleInputIsNamed) {
  Array old;
  port.before = [&](PassCase& c) {
    if (c.folder() == "puddle.wave_step/0011.1") old = input_of(c, "wave").array;
    if (c.folder() == "puddle.wave_step/0012.0") input_of(c, "wave").array = old;
  };
  const PortJudgement j = shadow_of();
  EXPECT_THAT(pass_of(j, "wave_step").reason,
              HasSubstr("it is puddle.wave_step/0011.1/in.wave, the state before that run: a missing swap or a stale frame"));
}

TEST_F(ShadowTest, APictureOfTheFrameBeforeIsNamed) {
  Array old;
  port.before = [&](PassCase& c) {
    if (c.folder() == "puddle.display/0011.0") old = input_of(c, "colour").array;
    if (c.folder() == "puddle.display/0012.0") input_of(c, "colour").array = old;
  };
  const PortJudgement j = shadow_of();
  EXPECT_THAT(pass_of(j, "display").reason, HasSubstr("it is puddle.shade/0011.0/out.colour: a stale frame"));
}

TEST_F(ShadowTest, AHiddenPassIsSeen) {
  port.before = [](PassCase& c) {
    if (c.folder() == "puddle.shade/0012.0") input_of(c, "hit").array.levels[0].edit()[16 * 40] ^= std::byte{1};
  };
  const PortJudgement j = shadow_of();
  EXPECT_EQ(j.first_bad_pass, "shade");
  EXPECT_THAT(pass_of(j, "shade").reason,
              AllOf(HasSubstr("1 of 2940 values differ, first at x 5, y 1, channel 0"), HasSubstr("a pass between them")));
}

// The input that is dumped is right, but the pass took another.
TEST_F(ShadowTest, AnOutputThatDoesNotFollowFromTheInputsFails) {
  port.before = [](PassCase& c) {
    if (c.folder() == "puddle.shade/0012.0") flip_rows(input_of(c, "normal").array);
  };
  port.dumped = [](PassCase& c) {
    if (c.folder() == "puddle.shade/0012.0") flip_rows(input_of(c, "normal").array);
  };
  const PortJudgement j = shadow_of();
  EXPECT_EQ(j.first_bad_pass, "shade") << why(j);
  EXPECT_TRUE(pass_of(j, "shade").inputs_are_good);
  ASSERT_FALSE(pass_of(j, "shade").causes.empty());
  EXPECT_EQ(pass_of(j, "shade").causes[0].name, "input normal upside down");
}

TEST_F(ShadowTest, RaindropsAreRecomputedFromThePortsUniforms) {
  port.after = [](const PassCase& c, std::vector<Array>& out) {
    if (c.folder() == "puddle.raindrops/0012.0") out[0].levels[0].edit()[0] ^= std::byte{1};
  };
  const PortJudgement j = shadow_of();
  EXPECT_EQ(j.first_bad_pass, "raindrops");
  EXPECT_EQ(pass_of(j, "raindrops").cases[2].outputs[0].worst[0].x, 0);
}

// What the host makes of the water for the march must hold for the port's own water.
TEST_F(ShadowTest, BoundsOfAnotherFrameFail) {
  port.before = [](PassCase& c) {
    if (c.folder() != "puddle.surface_hit/0012.0") return;
    Array& bounds = input_of(c, "bounds").array;
    const float flat[2] = {1e-4f, 1e-3f};  // of water at rest
    std::memcpy(bounds.levels[0].edit().data(), flat, sizeof flat);
  };
  const PortJudgement j = shadow_of();
  EXPECT_EQ(j.first_bad_pass, "surface_hit") << why(j);
  EXPECT_THAT(pass_of(j, "surface_hit").reason,
              AllOf(HasSubstr("in.bounds at (0, 0) says height 0.0001 m"), HasSubstr("of another frame?")));
}

TEST_F(ShadowTest, ACounterOfAnotherRunFails) {
  std::vector<std::byte> old;
  port.before = [&](PassCase& c) {
    if (c.folder() == "puddle.raindrops/0012.0") old = c.uniforms;
    if (c.folder() == "puddle.raindrops/0012.1") c.uniforms = old;
  };
  const PortJudgement j = shadow_of();
  EXPECT_THAT(pass_of(j, "raindrops").reason,
              AllOf(HasSubstr("uniform step is 24"), HasSubstr("expected 25"), HasSubstr("it is that of puddle.raindrops/0012.0")));
}

TEST_F(ShadowTest, AConstantThatThePortChoseFails) {
  port.before = [](PassCase& c) {
    const float exposure = 1.5f;
    if (c.pass == "display") std::memcpy(c.uniforms.data() + 4, &exposure, 4);
  };
  PortJudgement j = shadow_of();
  EXPECT_EQ(j.status, Status::fail) << why(j);
  EXPECT_THAT(pass_of(j, "display").reason,
              AllOf(HasSubstr("uniform exposure is 1.5 0x3fc00000, expected 1.6245048"), HasSubstr("--foreign-host")));
  is_foreign = true;
  j = judge_dump();
  EXPECT_EQ(j.status, Status::pass) << why(j);
  EXPECT_THAT(j.notes, Contains(AllOf(HasSubstr("uniform exposure of display is not the manifest's in 2 runs"),
                                      HasSubstr("1.5 0x3fc00000, expected 1.6245048"))));
}

TEST_F(ShadowTest, AUniformThatIsNoNumberFails) {
  port.dumped = [](PassCase& c) {
    const std::uint32_t nan = 0x7fc00000;
    if (c.folder() == "puddle.display/0012.0") std::memcpy(c.uniforms.data() + 4, &nan, 4);
  };
  const PortJudgement j = shadow_of();
  EXPECT_EQ(pass_of(j, "display").status, Status::fail);
  EXPECT_EQ(pass_of(j, "display").reason, "uniform exposure is nan, expected 0 to 1.04858e+06");
}

TEST_F(ShadowTest, WhatIsNotThereIsNotJudgedAndTheRestIs) {
  port.run(folder.path());
  std::filesystem::remove(file("puddle.display/0012.0/uniforms.bin"));
  PortJudgement j = judge_dump();
  ASSERT_EQ(j.files.size(), 1u);
  EXPECT_THAT(j.files[0].text, HasSubstr("uniforms.bin' is missing"));
  std::filesystem::remove(file("puddle.shade/0011.0/in.hit.npy"));
  j = judge_dump();
  ASSERT_EQ(j.files.size(), 2u);
  EXPECT_EQ(std::tuple(j.files[0].id, j.files[0].output), std::tuple("puddle.shade/0011.0", "in.hit"));
  EXPECT_EQ(files_error(j.files).code(), ExitCode::port_files);
  EXPECT_EQ(j.status, Status::untested) << why(j);
  for (const char* pass : {"shade", "display"}) EXPECT_EQ(pass_of(j, pass).status, Status::not_judged) << why(j);
  EXPECT_EQ(pass_of(j, "shade").reason, "in.hit: missing, or cannot be used");
  EXPECT_EQ(pass_of(j, "shade").cases.at(1).status, Status::pass);  // the other frame
  for (const char* pass : {"raindrops", "wave_step", "surface_hit"}) EXPECT_EQ(pass_of(j, pass).status, Status::pass) << why(j);
  EXPECT_TRUE(judge_dump({"wave_step", "surface_hit"}).files.empty());  // its own files are there

  std::filesystem::remove_all(file("puddle.display"));
  std::filesystem::remove_all(file("puddle.shade/0011.0"));
  j = judge_dump();
  EXPECT_TRUE(j.files.empty());
  EXPECT_EQ(j.status, Status::untested) << why(j);
  EXPECT_EQ(pass_of(j, "display").status, Status::not_judged);
  EXPECT_EQ(pass_of(j, "display").reason, "the port has dumped no run of this pass");
  EXPECT_EQ(pass_of(j, "shade").status, Status::not_judged);
  EXPECT_EQ(pass_of(j, "shade").reason, "the port has not dumped this run");
}

TEST_F(ShadowTest, FoldersOfOtherNamesAreRefused) {
  port.run(folder.path());
  std::filesystem::rename(file("puddle.shade/0011.0"), file("puddle.shade/11.0"));
  EXPECT_THAT(error_of([&] { judge_dump(); }), AllOf(StartsWith("3 "), HasSubstr("expected <frame>.<step> with four digits or more")));
  std::filesystem::rename(file("puddle.shade"), file("puddle.shad"));
  EXPECT_THAT(error_of([&] { judge_dump(); }), AllOf(StartsWith("3 "), HasSubstr("did you mean 'puddle.shade'?")));
}

// ---- the host's mistakes -----------------------------------------------------------------------------------------------
// Its bounds are not the scene's, and hold for its own water.
TEST_F(HostShadowTest, ARightHostHasNoNotes) {
  const PortJudgement j = shadow_of();
  EXPECT_EQ(j.status, Status::pass) << why(j);
  EXPECT_TRUE(j.notes.empty()) << why(j);
}
TEST_F(HostShadowTest, AStateThatIsNotResetFails) {
  mistake = [](PassCase& c) {
    if (c.folder() == "puddle.wave_step/0000.0") flip_rows(input_of(c, "wave").array);  // of a run before
  };
  expect_only_foreign("wave_step", "input puddle.wave_step/0000.0/in.wave is not the state that the scene begins with",
                      "input wave of wave_step is not the scene's in 1 run");
}
TEST_F(HostShadowTest, ABufferClearedToZeroFails) {
  mistake = [](PassCase& c) {
    if (c.folder() != "puddle.wave_step/0000.0") return;
    for (std::byte& b : input_of(c, "wave").array.levels[0].edit()) b = std::byte{0};
  };
  expect_only_foreign("wave_step", "is not the state that the scene begins with", "input wave of wave_step");
}
TEST_F(HostShadowTest, AnotherDampingFails) {
  change("wave_step", "damping", [](float d) { return std::sqrt(d); });
  expect_only_foreign("wave_step", "uniform damping is ", "uniform damping of wave_step is not the scene's in 4 runs");
}
TEST_F(HostShadowTest, AnotherCameraFails) {
  change("surface_hit", "camera_plane_left", [](float left) { return 0.95f * left; });
  expect_only_foreign("surface_hit", "uniform camera_plane_left is ", "uniform camera_plane_left of surface_hit");
}
TEST_F(HostShadowTest, APictureOfTheHostsOwnFails) {
  mistake = [](PassCase& c) {
    if (c.pass == "shade") flip_rows(input_of(c, "environment").array);
  };
  expect_only_foreign("shade", "in.environment is not the scene's: ", "input environment of shade is not the scene's");
}
// Both sides of what a host in floats may give.
TEST_F(HostShadowTest, ANumberRoundedOtherwiseIsANote) {
  change("wave_step", "damping", [](float d) { return d * (1 + 0x1p-20f); });
  expect_noted("uniform damping of wave_step differs by rounding from the scene's in 4 runs");
  change("wave_step", "damping", [](float d) { return d * (1 + 0x1p-16f); });
  EXPECT_EQ(shadow_of().status, Status::fail);
}
TEST_F(HostShadowTest, APictureRoundedOtherwiseIsANote) {
  const auto scale = [this](float by) {
    mistake = [by](PassCase& c) {
      if (c.pass != "shade") return;
      std::vector<std::byte>& bytes = input_of(c, "environment").array.levels[0].edit();
      for (std::size_t at = 0; at < bytes.size(); at += 4) change_at<float>(&bytes[at], [by](float value) { return value * by; });
    };
  };
  scale(1 + 0x1p-20f);
  expect_noted("input environment of shade differs by rounding from the scene's");
  scale(1 + 0x1p-14f);
  EXPECT_EQ(shadow_of().status, Status::fail);
}

class WindshieldHostShadowTest : public HostShadowTest {
 protected:
  WindshieldHostShadowTest() : HostShadowTest("windshield-corrected") {}
};
TEST_F(WindshieldHostShadowTest, ADoubledTimeStepFails) {
  const std::size_t dt = uniform_offset(port.pack, "integrate", "dt"), count = uniform_offset(port.pack, "splat", "drop_count");
  mistake = [=](PassCase& c) {
    if (c.pass == "splat") {  // of the list that it has
      const auto drops = static_cast<std::int32_t>(c.input("drops")->array.width);
      std::memcpy(c.uniforms.data() + count, &drops, 4);
    }
    if (c.pass == "integrate" && c.frame != 0) change_at<float>(c.uniforms.data() + dt, [](float value) { return 2 * value; });
  };
  expect_only_foreign("integrate", "uniform dt is ", "uniform dt of integrate is not the scene's in 1 run");
}
// Free slots and ids hang on how many drops live, and that on the port's arithmetic.
TEST_F(WindshieldHostShadowTest, FreeSlotsAreThePortsOwn) {
  const std::size_t at = uniform_offset(port.pack, "spawn", "room");
  mistake = [at](PassCase& c) {
    if (c.pass == "spawn") change_at<std::uint32_t>(c.uniforms.data() + at, [](std::uint32_t room) { return room - 1; });
  };
  const PortJudgement j = shadow_of();
  EXPECT_NE(j.status, Status::fail) << why(j);
  EXPECT_THAT(j.notes, Contains(HasSubstr("uniform room of spawn hangs on the port's own state and is not the scene's")));
}

class PublishedShadowTest : public ShadowTest {
 protected:
  PublishedShadowTest() : ShadowTest("puddle-as-published") {}
};

TEST_F(PublishedShadowTest, WhatNoGpuReproducesIsTakenAsData) {
  port.after = [](const PassCase& c, std::vector<Array>& out) {
    if (c.pass == "ground_noise") std::memset(out[0].levels[0].edit().data(), 0, 400);  // another sine
  };
  const PortJudgement j = shadow_of();
  EXPECT_NE(j.status, Status::fail) << why(j);
  EXPECT_EQ(pass_of(j, "shade").status, Status::pass);
}

TEST_F(PublishedShadowTest, TheTimeOfAnotherFrameFails) {
  std::vector<std::byte> old;
  port.dumped = [&](PassCase& c) {
    if (c.folder() == "puddle.raindrops/0011.0") old = c.uniforms;
    if (c.folder() == "puddle.raindrops/0012.0") c.uniforms = old;
  };
  const PortJudgement j = shadow_of();
  EXPECT_EQ(j.first_bad_pass, "raindrops") << why(j);
  EXPECT_THAT(pass_of(j, "raindrops").reason, AllOf(HasSubstr("uniform time is 0.18333334"), HasSubstr("expected 0.2"),
                                                    HasSubstr("it is that of puddle.raindrops/0011.0")));
}

// The other effects: lists of drops that are handed from pass to pass, and a picture whose mip levels come from a run each.
class WindshieldShadowTest : public ShadowTest {
 protected:
  WindshieldShadowTest() : ShadowTest("windshield-corrected") {}
};
class FreeRun : public ShadowTest, public testing::WithParamInterface<std::pair<const char*, HalfMode>> {
 protected:
  FreeRun() : ShadowTest(GetParam().first) {}
};
INSTANTIATE_TEST_SUITE_P(Packs, FreeRun,
                         testing::Values(std::pair{"windshield-corrected", HalfMode::rtz},
                                         std::pair{"windshield-as-published", HalfMode::either},
                                         std::pair{"screen_drops-corrected", HalfMode::rtz},
                                         std::pair{"rainy_glass-corrected", HalfMode::rtz},
                                         std::pair{"edge_splash-corrected", HalfMode::rtz}),
                         [](const auto& tested) {
                           std::string name = tested.param.first;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// Of a device that truncates and fuses; a port may be asked to warn of what known devices do not do.
TEST_P(FreeRun, OfAConformingDevicePasses) {
  port.stores = GetParam().second;
  port.behaviour.fault = perturbed::Fault::fused;
  const PortJudgement j = shadow_of();
  EXPECT_TRUE(j.status == Status::pass || j.status == Status::warn) << why(j);
  for (const PassJudgement& p : j.passes) EXPECT_TRUE(p.status == Status::pass || p.status == Status::warn) << p.pass;
  // Its drops are not the pack's any more.
  if (port.pack.effect == "windshield" && port.pack.variant == "corrected") {
    EXPECT_EQ(judge(port.pack, folder.path()).status, Status::fail);
  }
}

TEST_F(WindshieldShadowTest, ALostDropIsFoundWhereItIsLost) {
  port.after = [](const PassCase& c, std::vector<Array>& out) {
    if (c.folder() != "windshield.merge/0012.0") return;
    out[0].levels[0].edit().resize(out[0].levels[0].size() - out[0].element_bytes());
    --out[0].width;
  };
  const PortJudgement j = shadow_of();
  EXPECT_EQ(j.first_bad_pass, "merge") << why(j);
  EXPECT_THAT(j.notes, Contains("the first bad run is windshield.merge/0012.0"));
  EXPECT_THAT(pass_of(j, "merge").reason, HasSubstr("drops, missing: "));
  EXPECT_EQ(pass_of(j, "splat").status, Status::pass);  // it follows from the drops that are left
  EXPECT_FALSE(pass_of(j, "splat").inputs_are_good);
}

TEST_F(WindshieldShadowTest, EachMipLevelMustBeTheOutputOfItsOwnRun) {
  port.before = [](PassCase& c) {
    if (c.folder() == "windshield.composite/0012.0") std::memset(input_of(c, "blurred").array.levels[2].edit().data(), 0, 64);
  };
  const PortJudgement j = shadow_of();
  EXPECT_EQ(j.first_bad_pass, "composite") << why(j);
  EXPECT_THAT(
      pass_of(j, "composite").reason,
      HasSubstr(
          "input windshield.composite/0012.0/in.blurred.L2 is not the previous output windshield.blur_pyramid/0012.0.L2/out.blurred"));
}

TEST_F(WindshieldShadowTest, ALevelIsHalvedFromTheOneAbove) {
  port.before = [](PassCase& c) {
    if (c.folder() == "windshield.blur_pyramid/0012.0.L2") {
      Array& above = input_of(c, "blurred").array;
      above.levels[0].edit()[0] = std::byte{1};
    }
  };
  const PortJudgement j = shadow_of();
  EXPECT_EQ(j.first_bad_pass, "blur_pyramid") << why(j);
  EXPECT_THAT(
      pass_of(j, "blur_pyramid").reason,
      HasSubstr(
          "input windshield.blur_pyramid/0012.0.L2/in.blurred is not the previous output windshield.blur_pyramid/0012.0.L1/out.blurred"));
}

}  // namespace
}  // namespace rainref::judge
