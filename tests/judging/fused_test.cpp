// A pass that a port computes in one shader with another one is judged from what the port gave for that one, or from all that it may give.
#include "judge/fused.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "judging/fused_port.h"
#include "math/enclosure.h"
#include "math/uncertain.h"

namespace rainref::judging {
namespace {

using testing::HasSubstr;

std::string both(const Fused& fused) { return std::string(fused.source) + "+" + fused.pass; }
const Fused& of_pass(const std::string& pack, const std::string& pass) {
  return *std::find_if(fused_passes().begin(), fused_passes().end(), [&](const Fused& f) { return f.pack == pack && f.pass == pass; });
}
/// A shader with another sine: its noise is as random, and other at each texel.
Fused with_own_noise() {
  Fused fused = of_pass("puddle-as-published", "shade");
  fused.own = [](Array& a) {
    std::uint32_t random = 1;
    std::vector<std::byte>& bytes = a.levels[0].edit();
    for (std::size_t at = 0; at + 4 <= bytes.size(); at += 4) {
      random = random * 1664525u + 1013904223u;
      const float value = static_cast<float>(random >> 8) * 0x1p-24f;
      std::memcpy(&bytes[at], &value, 4);
    }
  };
  return fused;
}
/// A pass that is also wrong by itself.
judge::MiniPort with_mistake(const Fused& fused) {
  judge::MiniPort port = fused.port();
  const auto own = port.after;
  port.after = [own, pass = std::string(fused.pass)](const PassCase& c, std::vector<Array>& out) {
    own(c, out);
    if (c.pass != pass) return;
    std::vector<std::byte>& bytes = out[0].levels[0].edit();
    std::reverse(bytes.begin(), bytes.end());
  };
  return port;
}
std::string refusal(const judge::MiniPort& port, const std::string& pass, const std::string& fused, const std::string& without) {
  try {
    static_cast<void>(judged_pass(port, pass, {fused}, without));
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
    return e.what();
  }
  return "";
}

TEST(Fused, TheLastPassIsJudgedFromThePortsOwnFiles) {
  for (const Fused& fused : fused_passes()) {
    SCOPED_TRACE(both(fused));
    const judge::PassJudgement j = judged_pass(fused.port(), fused.pass, {both(fused)});
    EXPECT_EQ(j.status, judge::Status::pass) << j.reason;
    EXPECT_EQ(judged_pass(with_mistake(fused), fused.pass, {both(fused)}).status, judge::Status::fail);
  }
}

// The noise of the ground may be anything between 0 and 1 where a ray meets the ground: shade is judged by all of that.
TEST(Fused, WithoutFilesTheLastPassIsJudgedFromAllThatThePassMayGive) {
  const Fused noise = with_own_noise();
  EXPECT_EQ(judged_pass(noise.port(), "shade", {}, "ground_noise").status, judge::Status::fail);
  const judge::PassJudgement fused = judged_pass(noise.port(), "shade", {"ground_noise+shade"}, "ground_noise");
  EXPECT_EQ(fused.status, judge::Status::pass) << fused.reason;
  EXPECT_EQ(judged_pass(with_mistake(noise), "shade", {"ground_noise+shade"}, "ground_noise").status, judge::Status::fail);
}

// display takes halves: one that the device rounds to the neighbour is legal, a hundredth more is not.
TEST(Fused, TheWidthsOfBothPassesCount) {
  Fused step = of_pass("puddle-corrected", "display");
  step.own = [](Array& a) {
    std::vector<std::byte>& bytes = a.levels[0].edit();
    for (std::size_t at = 0; at + 2 <= bytes.size(); at += 2) {
      std::uint16_t half = 0;
      std::memcpy(&half, &bytes[at], 2);
      if (half > 0 && half < 0x3c00) --half;
      std::memcpy(&bytes[at], &half, 2);
    }
  };
  EXPECT_NE(judged_pass(step.port(), "display", {"shade+display"}, "shade").status, judge::Status::fail);
  EXPECT_EQ(judged_pass(of_pass("puddle-corrected", "display").port(), "display", {"shade+display"}, "shade").status, judge::Status::fail);
}

// The drops of corrected are draws of integers, which every conforming port gives: only those of the pack are right.
TEST(Fused, AnExactListIsThePacks) {
  Fused exact = of_pass("puddle-corrected", "wave_step");
  EXPECT_EQ(judged_pass(exact.port(), "wave_step", {"raindrops+wave_step"}, "raindrops").status, judge::Status::fail);
  exact.own = [](Array&) {};
  EXPECT_EQ(judged_pass(exact.port(), "wave_step", {"raindrops+wave_step"}, "raindrops").status, judge::Status::pass);
}

TEST(Fused, WhatCannotBeKnownIsAskedFor) {
  const Fused& list = of_pass("puddle-as-published", "wave_step");
  EXPECT_THAT(refusal(list.port(), "wave_step", "raindrops+wave_step", "raindrops"),
              HasSubstr("wave_step cannot be judged without the port's own outputs of raindrops"));
  const Fused lookup{"rainy_glass-corrected", "bake_raindrops", "raindrops", "rain_on_glass", [](Array&) {}};
  EXPECT_THAT(refusal(lookup.port(), "rain_on_glass", "bake_raindrops+rain_on_glass", "bake_raindrops"),
              HasSubstr("in.raindrops: the pass reads it at other places"));
}

TEST(Fused, TheNamesAreChecked) {
  const capture::Pack pack(judge::MiniPort("puddle-corrected").pack.folder());
  const auto error = [&](const char* text) -> std::string {
    try {
      judge::fused_passes(text, pack);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::usage);
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(error("shade+displays"), HasSubstr("display"));
  EXPECT_THAT(error("shade"), HasSubstr("expected two passes or more"));
  EXPECT_THAT(error("display+shade"), HasSubstr("found that shade takes nothing of display"));
  EXPECT_EQ(error("surface_hit+shade+display"), "");
}

// The port writes no noise, and nothing else explains the texels.
TEST(Fused, AShaderThatComputesItsNoiseIsNamed) {
  const Fused fused = with_own_noise();
  const judge::PassJudgement j = judged_pass(fused.port(), "shade", {}, "ground_noise");
  ASSERT_EQ(j.status, judge::Status::fail);
  ASSERT_FALSE(j.causes.empty());
  EXPECT_EQ(j.causes[0].name, "computes noise itself");
  EXPECT_TRUE(j.causes[0].is_likely);
  EXPECT_THAT(j.causes[0].sentence, HasSubstr("--fused ground_noise+shade"));
}

TEST(Uncertain, ALoadOfAnEnclosureGivesTheIntervalAndOtherNumbersTheValue) {
  const std::vector<float> values{1, 2, 3}, others{5};
  {
    const enclosed::UncertainValues uncertain(values.data(),
                                              std::make_shared<enclosed::Uncertain>(enclosed::Uncertain{{0, 2, -4}, {1, 2.5f, 4}}));
    const enclosed::Enclosure last = enclosed::Enclosure::load(&values[2]);
    EXPECT_EQ(last.lo, -4);
    EXPECT_EQ(last.hi, 4);
    EXPECT_EQ(enclosed::Enclosure::load(&values[1]).hi, 2.5f);
    EXPECT_TRUE(enclosed::Enclosure::load(others.data()).is_point());
    EXPECT_EQ(scalar::Scalar<float>::load(&values[2]).v, 3);
  }
  EXPECT_TRUE(enclosed::Enclosure::load(&values[2]).is_point());
}

}  // namespace
}  // namespace rainref::judging
