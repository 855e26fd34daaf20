// Known failures: what a list may say, and what it changes.
#include "reports/baseline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/example_judgement.h"

namespace rainref::reports {
namespace {

using namespace judge;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string refusal(const std::function<void()>& action, ExitCode code = ExitCode::usage) {
  try {
    action();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), code);
    return e.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}
std::string parse_refusal(const std::string& toml) {
  return refusal([&] { Baseline::parse(toml, "b.toml"); });
}

TEST(ReportBaseline, WhatItRefuses) {
  EXPECT_THAT(parse_refusal("[shade.colour]\n"), StartsWith("b.toml:1:8: [shade.colour]: expected a reason, found none"));
  EXPECT_THAT(parse_refusal("[shade.colour]\nreason = ''\n"), StartsWith("b.toml:2:1: reason: expected a text that says why, found "));
  EXPECT_THAT(parse_refusal("[shade.colour]\nreason = 3\n"), HasSubstr("reason: expected a text that says why, found 3"));
  EXPECT_EQ(parse_refusal("[shade.colour]\nraeson = 'x'\n"), "b.toml:2:1: expected 'reason' alone, found 'raeson'; did you mean 'reason'?");
  EXPECT_THAT(parse_refusal("[shade]\nreason = 'x'\n"),
              HasSubstr("expected 'reason' in a table [PASS.OUTPUT] or [PASS.OUTPUT.\"CASE\"], found 'shade.reason'"));
  EXPECT_THAT(parse_refusal("[shade.colour.a.b]\nreason = 'x'\n"), HasSubstr("found 'shade.colour.a.b.reason'"));
  EXPECT_THAT(parse_refusal("[shade]\n"), HasSubstr("expected a table [PASS.OUTPUT]"));
  EXPECT_THAT(parse_refusal("shade.colour = \n"), StartsWith("b.toml:1"));
  EXPECT_THAT(refusal([] { Baseline::read("/nowhere/b.toml"); }, ExitCode::io), HasSubstr("/nowhere/b.toml"));
}

TEST(ReportBaseline, NamesMustBeThePacks) {
  const capture::Pack pack(small_pack("puddle-corrected"));
  std::vector<std::string> ids;
  for (const capture::PackCase& c : pack.cases) ids.push_back(c.id);
  const auto check = [&](const std::string& toml) { Baseline::parse(toml, "b.toml").check(pack.passes, ids); };
  EXPECT_NO_THROW(check("[shade.colour]\nreason = 'x'\n[surface_hit.hit.\"puddle.surface_hit/0012.0\"]\nreason = 'y'\n"));
  EXPECT_EQ(refusal([&] { check("\n[shad.colour]\nreason = 'x'\n"); }),
            "b.toml:3:1: expected a pass (raindrops, wave_step, surface_hit, shade, display), found 'shad'; did you mean 'shade'?");
  EXPECT_EQ(refusal([&] { check("[surface_hit.hid]\nreason = 'x'\n"); }),
            "b.toml:2:1: expected an output of surface_hit (hit, normal), found 'hid'; did you mean 'hit'?");
  EXPECT_THAT(refusal([&] { check("[shade.colour.\"puddle.shade/0010.0\"]\nreason = 'x'\n"); }),
              HasSubstr("found 'puddle.shade/0010.0'; did you mean 'puddle.shade/0011.0'?"));
}

TEST(ReportBaseline, AListedFailureIsKnown) {
  PortJudgement j = example_judgement();
  Baseline::parse("[shade.colour]\nreason = 'driver truncates'\n", "b.toml").apply(j);
  EXPECT_EQ(j.passes[3].status, Status::known);
  EXPECT_EQ(j.passes[3].cases[0].status, Status::known);
  EXPECT_EQ(j.passes[3].cases[0].outputs[0].known, "driver truncates");
  EXPECT_EQ(j.first_bad_pass, "");
  EXPECT_EQ(j.status, Status::untested);  // of `noise`
  EXPECT_THAT(j.stale, ElementsAre());
}

TEST(ReportBaseline, WhatItDoesNotListStillFails) {
  PortJudgement j = example_judgement();
  PassJudgement& shade = j.passes[3];
  shade.cases[1] = shade.cases[0];
  shade.cases[1].id = "rain.shade/0001.0";
  const Baseline one_case = Baseline::parse("[shade.colour.\"rain.shade/0000.0\"]\nreason = 'x'\n", "b.toml");
  one_case.apply(j);
  EXPECT_EQ(shade.cases[0].status, Status::known);
  EXPECT_EQ(shade.cases[1].status, Status::fail);
  EXPECT_EQ(shade.status, Status::fail);
  EXPECT_EQ(j.status, Status::fail);
  EXPECT_EQ(j.first_bad_pass, "shade");

  // A second output of a listed case is not covered by the first.
  j = example_judgement();
  OutputJudgement other = j.passes[3].cases[0].outputs[0];
  other.name = "mask";
  j.passes[3].cases[0].outputs.push_back(other);
  one_case.apply(j);
  EXPECT_EQ(j.passes[3].cases[0].status, Status::fail);
  EXPECT_EQ(j.passes[3].cases[0].outputs[0].known, "x");
  EXPECT_EQ(j.passes[3].cases[0].outputs[1].known, "");
}

TEST(ReportBaseline, TheMoreSpecificEntryGivesTheReason) {
  PortJudgement j = example_judgement();
  PassJudgement& shade = j.passes[3];
  shade.cases[1] = shade.cases[0];
  shade.cases[1].id = "rain.shade/0001.0";
  Baseline::parse("[shade.colour]\nreason = 'all'\n[shade.colour.\"rain.shade/0001.0\"]\nreason = 'one'\n", "b.toml").apply(j);
  EXPECT_EQ(shade.cases[0].outputs[0].known, "all");
  EXPECT_EQ(shade.cases[1].outputs[0].known, "one");
  EXPECT_THAT(j.stale, ElementsAre());
}

TEST(ReportBaseline, WhatNoLongerFailsIsAnError) {
  PortJudgement j = example_judgement();
  Baseline::parse("[shade.colour]\nreason = 'x'\n[hit.hit]\nreason = 'was off'\n", "b.toml").apply(j);
  EXPECT_THAT(j.stale, ElementsAre("b.toml:4:1: [hit.hit] no longer fails (\"was off\"): remove the entry"));
  EXPECT_EQ(j.status, Status::fail);
  EXPECT_EQ(j.reason, "the baseline lists 1 failure that no longer happens");

  j = example_judgement();
  Baseline::parse("[shade.colour.\"rain.shade/0001.0\"]\nreason = 'x'\n", "b.toml").apply(j);
  EXPECT_THAT(j.stale, ElementsAre(HasSubstr("[shade.colour.\"rain.shade/0001.0\"] no longer fails")));
}

TEST(ReportBaseline, WhatIsBrokenIsNotKnown) {
  PortJudgement j = example_judgement();
  CaseJudgement& c = j.passes[3].cases[0];
  c.broken = true;
  c.reason = "race";
  Baseline::parse("[shade.colour]\nreason = 'x'\n", "b.toml").apply(j);
  EXPECT_EQ(c.status, Status::fail);
  EXPECT_EQ(j.status, Status::fail);
  // No output fails, so there is nothing that an entry could be about.
  j = example_judgement();
  OutputJudgement& o = j.passes[3].cases[0].outputs[0];
  o.failing = 0;
  o.worst.clear();
  j.passes[3].cases[0].failing = 0;
  j.passes[3].cases[0].broken = true;
  Baseline::parse("", "b.toml").apply(j);
  EXPECT_EQ(j.passes[3].status, Status::fail);
}

TEST(ReportBaseline, APassThatWasNotJudgedIsNotStale) {
  PortJudgement j = example_judgement();
  j.passes.erase(j.passes.begin() + 1);
  Baseline::parse("[hit.hit]\nreason = 'x'\n[shade.colour]\nreason = 'y'\n", "b.toml").apply(j);
  EXPECT_THAT(j.stale, ElementsAre());
}

}  // namespace
}  // namespace rainref::reports
