// The passes that move drops, and splat: lanes that are made of their definitions or written by hand, against what the definitions give
// one number at a time; and what their definitions refuse.
#include "base/error_of.h"
#include "math/simd_target.h"
#include "pass/same_as_definition.h"
#include "pass/stored_record.h"
#include "windshield/golden_scenes.h"
#include "windshield/info.h"

namespace rainref::windshield {
namespace {

std::vector<capture::PassCase> cases_of(bool corrected, std::string_view pass, const std::string& more, int frames) {
  const parallel::Executor executor(2);
  const std::string toml = wet_drive + more + (corrected ? "[rain]\nrate = 150\nsmallest_drop = 0.8\n" : "spawn_rate = 3000\n");
  Windshield windshield(config_of(corrected ? "corrected" : "as-published", toml), small_surroundings(), executor);
  for (int frame = 0; frame < 20; ++frame) windshield.simulate();
  return rainref::test::captured(effect_info(), corrected, pass, [&](Recorder& recorder) {
    for (int frame = 0; frame < frames; ++frame) {
      windshield.simulate(&recorder);
      windshield.render(&recorder);
    }
  });
}

TEST(MotionDefinition, SplatIsThatOfTheDefinition) {
  const std::vector<std::string> targets = simd_targets();
  std::size_t number = 0;
  for (const bool corrected : {false, true}) {
    for (const char* kernel : {"paraboloid", "quartic", "smoothstep", "hemisphere", "disc"}) {
      for (const char* blend : {"add", "max"}) {
        for (const char* accumulate : {"half", "float"}) {
          if (corrected && accumulate == std::string("half")) continue;
          select_simd_target(targets[number++ % targets.size()]);
          const std::string more =
              fmt::format("kernel = '{}'\nblend = '{}'\nrounding = '{}'\n", kernel, blend, number % 2 ? "rtz" : "rne") +
              (corrected ? "" : fmt::format("accumulate = '{}'\n", accumulate));
          const std::vector<capture::PassCase> cases = cases_of(corrected, "splat", more, 1);
          ASSERT_EQ(cases.size(), 1u);
          EXPECT_TRUE(rainref::test::are_as_defined(cases, evaluations())) << more;
        }
      }
    }
  }
  select_simd_target("");
}

std::string refusal(capture::PassCase c) {
  for (const capture::PassEvaluations& e : evaluations()) {
    if (e.pass != c.pass) continue;
    const std::string error = error_of([&] {
      if (e.bind)
        e.bind(c);
      else
        e.recompute(c);
    });
    if (error == "none") continue;
    EXPECT_EQ(error[0], '3') << error;
    return error;
  }
  return "none";
}
capture::CaseInput& input(capture::PassCase& c, const char* name) {
  return *std::find_if(c.inputs.begin(), c.inputs.end(), [&](const capture::CaseInput& i) { return i.name == name; });
}
/// The first record of an input once more behind the last.
capture::PassCase with_one_twice(capture::PassCase c, const char* name) {
  capture::Array& list = input(c, name).array;
  std::vector<std::byte>& bytes = list.levels.at(0).edit();
  const std::vector<std::byte> first(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(list.record.size));
  bytes.insert(bytes.end(), first.begin(), first.end());
  ++list.width;
  return c;
}

TEST(MotionDefinition, WhatIsNotAsDeclaredIsRefused) {
  for (const bool corrected : {false, true}) {
    for (const char* pass : {"integrate", "wipe_drops", "spawn", "merge"}) {
      if (!corrected && pass == std::string("merge")) continue;
      const capture::PassCase good = cases_of(corrected, pass, "", 1).at(0);
      EXPECT_EQ(refusal(good), "none");
      EXPECT_NE(refusal(with_one_twice(good, "drops")).find(": in.drops: expected each id once, found "), std::string::npos) << pass;
      capture::PassCase without = good;
      std::erase_if(without.inputs, [](const capture::CaseInput& i) { return i.name == "drops"; });
      EXPECT_NE(refusal(without), "none") << pass;
    }
    const auto refused = [&](const char* pass, const char* twice) {
      return refusal(with_one_twice(cases_of(corrected, pass, "", 1).at(0), twice));
    };
    EXPECT_NE(refused("integrate", "glass_frame").find("in.glass_frame: expected 1 record, found 2"), std::string::npos);
    EXPECT_NE(refused("spawn", "spawn_masses").find("in.spawn_masses: expected 1024 records, found 1025"), std::string::npos);
  }
  // A film of another size than the one that is given.
  for (const char* pass : {"wipe_drops", "merge", "splat"}) {
    capture::PassCase c = cases_of(true, pass, "", 1).at(0);
    capture::Array& film = input(c, "film").array;
    film.width -= 1;
    film.levels[0].edit().resize(static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height) * sizeof(float));
    EXPECT_NE(refusal(c).find("in.film: expected r32f 89x53, found r32f 88x53"), std::string::npos) << refusal(c);
  }
}

// A port that lost a drop has another list than the uniform says, and is judged by what it drew.
TEST(MotionDefinition, SplatDrawsTheDropsThatThereAre) {
  capture::PassCase c = cases_of(false, "splat", "", 1).at(0);
  for (const scene::Member& m : effect_info().pass("splat").block("as-published").members) {
    if (m.name != "drop_count") continue;
    for (const std::int32_t count : {input(c, "drops").array.width + 1, input(c, "drops").array.width, 1}) {
      std::memcpy(c.uniforms.data() + m.offset, &count, sizeof count);
      EXPECT_EQ(static_cast<bool>(rainref::test::are_as_defined({c}, evaluations())), count > 1) << count;
    }
  }
}

// The layout of a record and what a text computes with name the same floats.
TEST(MotionDefinition, ARecordAndItsNumbersAreOne) {
  drops::Drop d{{1, 2}, {3, 4}, 5, 6, 7, 0};
  const std::vector<float*> columns = pass::columns_of(d);
  ASSERT_EQ(columns.size(), 6u);
  for (std::size_t k = 0; k < columns.size(); ++k) EXPECT_EQ(*columns[k], static_cast<float>(k + 1));
  drops::GlassFrame frame{};
  EXPECT_EQ(pass::columns_of(frame).size(), 14u);
}

}  // namespace
}  // namespace rainref::windshield
