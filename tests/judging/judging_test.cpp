// Cases and verdicts in memory, as a program of another project has them.
#include "rainref/judging.h"

#include <gmock/gmock.h>

#include <cstring>

#include "base/error_of.h"
#include "judge/validate.h"
#include "math/half.h"
#include "rainref/error.h"
#include "simulation/small_scenes.h"
#include "shipped_packs.h"

namespace rainref {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const parallel::Executor executor(2);

/// Frames 0 and 1 of a puddle, and the cases of some passes.
struct Judging : testing::Test {
  Simulation sim{small("puddle", "corrected"), executor};
  Cases cases{sim};

  void take(const std::vector<std::string>& passes, int frames = 2) {
    for (int f = 0; f < frames; ++f) cases.add_next_frame(sim, passes);
  }
  void give_all(const std::function<void(const CaseInfo&, const std::string&, std::vector<std::byte>&)>& alter) {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const CaseInfo about = cases.info(i);
      for (const std::string& output : about.outputs) {
        const CaseArray a = cases.expected(i, output);
        std::vector<std::byte> bytes(a.bytes.begin(), a.bytes.end());
        alter(about, output, bytes);
        const std::size_t row = a.is_records ? a.element_bytes : a.element_bytes * static_cast<std::size_t>(a.width);
        cases.give(i, output, bytes.data(), row, static_cast<std::size_t>(a.is_records ? a.width : a.height));
      }
    }
  }
};

TEST_F(Judging, EveryPassOfAFrameIsACase) {
  EXPECT_EQ(cases.size(), 0u);
  take({}, 1);
  EXPECT_EQ(sim.frame(), 1);
  std::vector<std::string> passes;
  for (std::size_t i = 0; i < cases.size(); ++i) passes.push_back(cases.info(i).pass);
  passes.erase(std::unique(passes.begin(), passes.end()), passes.end());
  EXPECT_THAT(passes, testing::IsSupersetOf({"raindrops", "wave_step", "surface_hit", "shade", "display"}));
}

TEST_F(Judging, ACaseSaysWhatThePassTakesAndGives) {
  take({"wave_step", "display"});
  const CaseInfo wave = cases.info(0);
  EXPECT_EQ(wave.id, "puddle.wave_step/0000.0");
  EXPECT_EQ(wave.formula.substr(0, 27), "puddle.wave_step.corrected/");
  EXPECT_EQ(wave.variant, "corrected");
  EXPECT_EQ(wave.level, -1);
  EXPECT_THAT(wave.outputs, ElementsAre("wave"));
  const CaseArray in = cases.input(0, "wave"), out = cases.expected(0, "wave"), block = cases.uniforms(0);
  EXPECT_EQ(in.width, 61);
  EXPECT_EQ(in.height, 45);
  EXPECT_EQ(in.format, Format::rg16f);
  EXPECT_EQ(in.bytes.size(), 61u * 45u * 4u);
  EXPECT_EQ(out.bytes.size(), in.bytes.size());
  EXPECT_EQ(reinterpret_cast<const std::byte*>(out.row<Half>(44)), out.bytes.data() + 44 * 61 * 4);
  const CaseArray drops = cases.input(0, "drops");
  EXPECT_TRUE(drops.is_records);
  EXPECT_EQ(drops.bytes.size(), static_cast<std::size_t>(drops.width) * drops.element_bytes);
  EXPECT_EQ(block.record, "WaveStepUniforms");
  EXPECT_EQ(block.bytes.size(), block.element_bytes);
  EXPECT_EQ(block.width, 1);
  bool has_damping = false;
  for (const Field& f : block.fields) {
    EXPECT_LE(f.offset + 4 * static_cast<std::size_t>(f.components), block.element_bytes);
    has_damping |= f.name == "damping" && f.type == Field::float32 && f.components == 1;
  }
  EXPECT_TRUE(has_damping);
  EXPECT_EQ(cases.sampling(0, "wave").filter, Filter::none);
  // What a pass gives is what the simulation holds.
  const auto held = std::get<BufferView>(sim.buffer("wave"));
  std::size_t last = 0;
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (cases.info(i).pass == "wave_step") last = i;
  const CaseArray newest = cases.expected(last, "wave");
  std::vector<std::byte> row(held.row_bytes());
  held.copy_row(20, row.data());
  EXPECT_EQ(std::memcmp(row.data(), newest.row<std::byte>(20), row.size()), 0);
}

TEST_F(Judging, TheReferencesOwnOutputsPassAndDifferNowhere) {
  take({"wave_step", "shade", "display"});
  give_all([](auto&&...) {});
  const Judgement judgement = cases.judge(executor);
  const Verdict& v = judgement.verdict();
  EXPECT_TRUE(v.is_good()) << judgement.text();
  EXPECT_EQ(v.profile, "vulkan");
  EXPECT_EQ(v.first_bad_pass, "");
  ASSERT_EQ(v.passes.size(), 3u);
  for (const PassVerdict& p : v.passes) {
    EXPECT_EQ(p.outside + p.differing, 0) << p.pass;
    EXPECT_GT(p.elements, 1000) << p.pass;
    EXPECT_TRUE(p.worst.empty()) << p.pass;
  }
}

// rainref rounds halves to nearest, and Direct3D asks for truncation.
TEST_F(Judging, AWarningFailsWhereThatIsAskedFor) {
  take({"wave_step"});
  give_all([](auto&&...) {});
  EXPECT_EQ(cases.judge(executor, {.profile = "d3d"}).verdict().status, "WARN");
  const Judgement strict = cases.judge(executor, {.profile = "d3d", .strict = true});
  EXPECT_EQ(strict.verdict().status, "FAIL");
  EXPECT_FALSE(strict.verdict().is_good());
  EXPECT_EQ(strict.verdict().first_bad_pass, "wave_step");
  EXPECT_THAT(strict.verdict().passes[0].reason, HasSubstr("a warning, which is to fail: stores to binary16"));
  EXPECT_THAT(strict.json(), HasSubstr("\"exit_code\": 1"));
}

TEST_F(Judging, AMistakeIsNamedWithItsPlaceAndItsCause) {
  take({"wave_step", "display"});
  give_all([](const CaseInfo& about, const std::string&, std::vector<std::byte>& bytes) {
    if (about.pass != "display") return;
    const std::size_t row = 33 * 4;  // upside down
    for (std::size_t y = 0; y < 10; ++y)
      std::swap_ranges(bytes.begin() + y * row, bytes.begin() + (y + 1) * row, bytes.begin() + (20 - y) * row);
  });
  const Judgement judgement = cases.judge(executor, {.profile = "vulkan", .port = "mine"});
  const Verdict& v = judgement.verdict();
  EXPECT_EQ(v.status, "FAIL");
  EXPECT_EQ(v.first_bad_pass, "display");
  ASSERT_EQ(v.passes.size(), 2u);
  const PassVerdict& display = v.passes[1];
  EXPECT_EQ(display.cases, 2);
  ASSERT_FALSE(display.causes.empty());
  EXPECT_EQ(display.causes[0].name, "upside down");
  EXPECT_EQ(display.causes[0].explained, display.causes[0].of);
  EXPECT_GT(display.causes[0].of, 100);
  ASSERT_FALSE(display.worst.empty());
  const Failure& worst = display.worst[0];
  EXPECT_TRUE(worst.got < worst.low || worst.got > worst.high) << worst.text;
  EXPECT_LE(worst.low, worst.expected);
  EXPECT_LE(worst.expected, worst.high);
  EXPECT_THAT(judgement.text(), HasSubstr("upside down"));
  EXPECT_THAT(judgement.json(), HasSubstr("\"port\": \"mine\""));
  EXPECT_THAT(judgement.html(), HasSubstr("data:image/png"));
}

TEST_F(Judging, AJudgementOutlivesItsCasesAndDoesNotHangOnThreads) {
  take({"display"});
  give_all([](const CaseInfo&, const std::string&, std::vector<std::byte>& bytes) { bytes[40] ^= std::byte{0x40}; });
  std::optional<Judgement> judgement;
  std::string json;
  {
    const Cases moved = std::move(cases);
    const parallel::Executor single(1);
    json = moved.judge(executor).json();
    judgement.emplace(moved.judge(single));
  }
  EXPECT_THAT(judgement->html(), HasSubstr("data:image/png"));
  EXPECT_EQ(judgement->json(), json);
}

TEST_F(Judging, WhatWasNotGivenIsNotJudged) {
  take({"display"});
  EXPECT_EQ(error_of([&] { cases.judge(executor); }), "3 cases: expected outputs of a port, given for one case or more, found none");
  const CaseArray a = cases.expected(0, "picture");
  cases.give(0, "picture", a.bytes.data(), a.element_bytes * 33, 21);
  const Judgement judgement = cases.judge(executor);
  EXPECT_EQ(judgement.verdict().status, "UNTESTED") << judgement.text();
  EXPECT_EQ(judgement.verdict().passes[0].status, "NOT JUDGED");
  EXPECT_EQ(judgement.verdict().passes[0].reason, "output picture was not given");
}

TEST_F(Judging, RowsMayBeApart) {
  take({"display"}, 1);
  const CaseArray a = cases.expected(0, "picture");
  std::vector<std::byte> apart(21 * 256);
  for (int y = 0; y < 21; ++y) std::memcpy(apart.data() + 256 * y, a.row<std::byte>(y), 33 * 4);
  cases.give(0, "picture", apart.data(), 256, 21);
  EXPECT_EQ(cases.judge(executor).verdict().passes[0].differing, 0);
}

TEST_F(Judging, ErrorsSayWhatWasExpected) {
  take({"display"}, 1);
  const auto refuses = [&](const auto& call, const char* why) { EXPECT_EQ(error_of(call), std::string("2 ") + why); };
  const CaseArray a = cases.expected(0, "picture");
  refuses([&] { cases.add_next_frame(sim, {"displya"}); }, "puddle corrected has no pass 'displya'; did you mean 'display'?");
  EXPECT_EQ(sim.frame(), 1);  // nothing ran
  refuses([&] { cases.info(7); }, "case 7: expected one of 1, counted from 0");
  refuses([&] { cases.input(0, "color"); }, "puddle.display/0000.0 has no input 'color'; did you mean 'colour'?");
  refuses([&] { cases.input(0, "colour", 3); }, "level 3: expected one of 1, counted from 0");
  refuses([&] { cases.input(0, "colour", -1); }, "level 18446744073709551615: expected one of 1, counted from 0");
  refuses([&] { cases.expected(0, "pictur"); }, "puddle.display/0000.0 has no output 'pictur'; did you mean 'picture'?");
  refuses([&] { cases.give(0, "picture", a.bytes.data(), 131, 21); },
          "puddle.display/0000.0/out.picture: expected at least 132 bytes for each row, found 131");
  refuses([&] { cases.give(0, "picture", a.bytes.data(), 132, 20); }, "puddle.display/0000.0/out.picture: expected 21 rows, found 20");
  refuses([&] { cases.give(0, "picture", nullptr, 132, 21); }, "data: expected an address, found NULL");
  cases.give(0, "picture", a.bytes.data(), 132, 21);
  refuses([&] { cases.judge(executor, {.profile = "vulcan"}); },
          "--profile: expected one of cuda, d3d, gles, ieee, metal, opencl, opengl, vulkan, webgl, webgpu, found 'vulcan'; did you mean "
          "'vulkan'?");
  Simulation other(small("edge_splash", "corrected"), executor);
  refuses([&] { cases.add_next_frame(other); },
          "cases: expected those of a simulation of edge_splash corrected, found those of puddle corrected");
}

TEST(JudgingAPack, SaysWhatValidateSays) {
  const std::string pack = test::pack_folder("edge_splash-corrected");
  Cases cases(pack, {"display"});
  ASSERT_GT(cases.size(), 1u);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const CaseArray a = cases.expected(i, "picture");
    cases.give(i, "picture", a.bytes.data(), a.element_bytes * static_cast<std::size_t>(a.width), static_cast<std::size_t>(a.height));
  }
  const Judgement judgement = cases.judge(executor, {.profile = "ieee"});
  EXPECT_EQ(judgement.verdict().status, "PASS") << judgement.text();
  EXPECT_EQ(judgement.verdict().passes.size(), 1u);
  Simulation sim(small("edge_splash", "corrected"), executor);
  EXPECT_THAT(error_of([&] { cases.add_next_frame(sim); }), HasSubstr("found those of a pack of edge_splash corrected"));
  EXPECT_THAT(error_of([&] { Cases("/nowhere"); }), HasSubstr("/nowhere"));
}

}  // namespace
}  // namespace rainref
