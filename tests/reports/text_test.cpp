// The report for a terminal, and the figures that all reports share.
#include "reports/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/example_judgement.h"

namespace rainref::reports {
namespace {

using namespace judge;

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

TEST(ReportFigures, AShareNeverRoundsToAllOrNothing) {
  EXPECT_EQ(share_text(0, 10), "0 %");
  EXPECT_EQ(share_text(10, 10), "100 %");
  EXPECT_EQ(share_text(1, 4), "25.00 %");
  EXPECT_EQ(share_text(1, 10'000'000), "0.01 %");
  EXPECT_EQ(share_text(9'999'999, 10'000'000), "99.99 %");
  EXPECT_EQ(share_text(0, 0), "-");
}

TEST(ReportFigures, APassSumsItsCasesAndTakesTheWidestOutput) {
  const PortJudgement j = example_judgement();
  const Figures shade = figures_of(j.passes[3]);
  EXPECT_EQ(shade.elements, 64);
  EXPECT_EQ(shade.outside, 6);
  EXPECT_EQ(shade.failing, 2);
  EXPECT_EQ(shade.invocations, 16);
  EXPECT_EQ(shade.median_width, 2);
  EXPECT_EQ(figures_of(j.passes[1]).bounded(), 7);
}

TEST(ReportFigures, TheExitCode) {
  PortJudgement j = example_judgement();
  const auto code = [&](Status s, bool allow) {
    j.status = s;
    return exit_code(j, allow);
  };
  EXPECT_EQ(code(Status::pass, false), 0);
  EXPECT_EQ(code(Status::warn, false), 0);
  EXPECT_EQ(code(Status::known, false), 0);
  EXPECT_EQ(code(Status::fail, true), 1);
  EXPECT_EQ(code(Status::untested, false), 1);
  EXPECT_EQ(code(Status::untested, true), 0);
  j.passes.erase(j.passes.begin(), j.passes.begin() + 2);  // nothing passed: there is nothing to forgive for
  EXPECT_EQ(code(Status::untested, true), 1);
}

TEST(ReportFigures, HowHalvesRound) {
  PassJudgement p = example_judgement().passes[3];
  EXPECT_EQ(half_text(p), "stores to half round toward zero (invocations outside if to nearest: 8, toward zero: 2, either way: 2)");
  p.half_votes = {2, 2, 2};
  EXPECT_THAT(half_text(p), HasSubstr("nothing tells"));
  p.half_mode_voted = false;
  EXPECT_EQ(half_text(p), "");
}

TEST(ReportText, OneAlignedLineForEachPass) {
  const std::string text = report_text(example_judgement());
  EXPECT_THAT(text, HasSubstr("          pass   outside  bounded  codes wide  99 %  ambiguous  vacuous    loose\n"
                              "PASS      wave    0 of 8    100 %           0     0          0      0 %      0 %\n"
                              "WARN      hit     0 of 8  87.50 %           7  none          4  12.50 %  25.00 %\n"));
  EXPECT_THAT(text, HasSubstr("          1 of 4 ambiguous invocations took another branch than the reference\n"));
  EXPECT_THAT(text, HasSubstr("UNTESTED  noise   0 of 8      0 %           0     0          0    100 %      0 %\n          100 % of the "
                              "elements have no useful bound\n"));
}

TEST(ReportText, WhatFailsWhereByHowMuchAndWhy) {
  const std::string text = report_text(example_judgement());
  EXPECT_THAT(
      text,
      HasSubstr("\nFAIL shade is outside the as-written envelope of rain.shade/1 under profile vulkan\n"
                "  first bad pass, its inputs are good\n"
                "  rain.shade/0000.0/out.colour (rgba16f 4x2): 6 of 32 elements outside (18.75 %)\n"
                "    (2, 0).y  got nan (0x7e01)  accepted 0.125 (0x3000) to 0.125122 (0x3001)  is not a number\n"
                "    (0, 1).w  got 1.00391 (0x3c04)  accepted 1 (0x3c00) to 1.00098 (0x3c01)  off by 3 codes\n"
                "    (4 more not shown)\n"
                "  where: only channel y of colour\n"
                "  likely cause: upside down: the buffer is stored from the bottom up (gives 2 of 2 failing texels bit for bit, comes\n"
                "    near 1)\n"));
  EXPECT_THAT(text, HasSubstr("note: port/x.exr: one note\n"));
  EXPECT_THAT(
      text,
      ContainsRegex("\nFAIL: port against pack, profile vulkan, Vulkan 1.3 Test & <Device> \\(1 FAIL, 1 UNTESTED, 1 WARN, 1 PASS\\)\n$"));
}

TEST(ReportText, ManyFailingOutputsAreCounted) {
  PortJudgement j = example_judgement();
  PassJudgement& shade = j.passes[3];
  for (int k = 0; k < 8; ++k) shade.cases.push_back(shade.cases[0]);
  shade.causes.clear();
  shade.where.clear();
  const std::string text = report_text(j);
  EXPECT_THAT(text, HasSubstr("  (5 more failures not shown)\n  cause unknown\n"));
}

TEST(ReportText, WhatIsBrokenSaysWhy) {
  PortJudgement j = example_judgement();
  PassJudgement& wave = j.passes[0];
  wave.status = wave.cases[0].status = Status::fail;
  wave.cases[0].broken = true;
  wave.reason = wave.cases[0].reason = "race: differs between runs 1 and 2";
  j.first_bad_pass = "wave";
  wave.inputs_are_good = false;
  const std::string text = report_text(j);
  EXPECT_THAT(text, HasSubstr("\nFAIL wave\n  first bad pass, its inputs are not good either\n  rain.wave/0000.0: race: differs between "
                              "runs 1 and 2\n\nFAIL shade is outside"));
  EXPECT_EQ(text.find("race:"), text.rfind("race:"));  // once
  // A wrong input is the cause of what is outside too.
  j.passes[3].causes.clear();
  EXPECT_THAT(report_text(j), HasSubstr("cause unknown"));
  j.passes[3].cases[1].broken = true;
  EXPECT_THAT(report_text(j), Not(HasSubstr("cause unknown")));
}

TEST(ReportText, SentencesAreBrokenAt120Columns) {
  PortJudgement j = example_judgement();
  const std::string sentence =
      "one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen seventeen eighteen nineteen twenty";
  j.passes[1].reason = j.passes[3].causes[0].sentence = j.passes[3].cases[0].reason = sentence;
  j.passes[3].cases[0].broken = true;
  j.passes[3].formula = "rain_on_a_windshield.screen_drops_collected.as-published/12";
  const std::string text = report_text(j);
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
    EXPECT_LE(text.find('\n', at) - at, 120u) << text.substr(at, text.find('\n', at) - at);
  EXPECT_THAT(
      text,
      HasSubstr("  rain.shade/0000.0: one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen\n"
                "    seventeen eighteen nineteen twenty\n"));
  std::string joined = text;
  for (std::size_t at = 0; (at = joined.find("\n ", at)) != std::string::npos;)
    joined.replace(at, joined.find_first_not_of(' ', at + 1) - at, " ");
  EXPECT_THAT(joined, HasSubstr("likely cause: upside down: " + sentence + " (gives"));  // no word is lost
}

TEST(ReportText, RunsThatAreNotThereAreNamed) {
  PortJudgement j = example_judgement();
  PassJudgement& wave = j.passes[0];
  CaseJudgement missing;
  missing.reason = wave.reason = "the port has not dumped this run";
  wave.status = Status::untested;
  for (int k = 1; k <= 6; ++k) {
    missing.id = "rain.wave/000" + std::to_string(k) + ".0";
    wave.cases.push_back(missing);
  }
  EXPECT_THAT(report_text(j), HasSubstr("not judged: rain.wave/0001.0, rain.wave/0002.0, rain.wave/0003.0, rain.wave/0004.0 and 2 more\n"));
}

TEST(ReportText, ARecordsFirstWrongFieldIsShown) {
  PortJudgement j = example_judgement();
  OutputJudgement& o = j.passes[3].cases[0].outputs[0];
  o.records = true;
  o.map.clear();
  o.elements = 7;
  o.failing = 2;
  Failure moved, lost;
  moved.x = 4;
  moved.field = "velocity.y";
  moved.field_kind = FormatInfo::float32;
  moved.got = 0x3f800002;
  moved.low = moved.high = 0x3f800000;
  moved.distance = 2;
  lost.x = 6;
  o.worst = {moved, lost};
  EXPECT_THAT(report_text(j), HasSubstr("out.colour (7 records): 2 of 7 records outside (28.57 %)\n"
                                        "    record 4, velocity.y  got 1.00000024 (0x3f800002)  accepted 1 (0x3f800000)  off by 2 codes\n"
                                        "    record 6  is in one of the lists alone\n"));
}

TEST(ReportText, OfAKeyedListRecordsAreRecordsAndFieldsAreFields) {
  PortJudgement j = example_judgement();
  OutputJudgement& o = j.passes[3].cases[0].outputs[0];
  o.records = true;
  o.counted = Counted::fields;
  o.map.clear();
  o.width = 167;
  o.elements = 1002;
  o.failing = 8;
  o.worst.clear();
  EXPECT_THAT(report_text(j), HasSubstr("out.colour (167 records): 8 of 1002 fields outside (0.80 %)\n"));
}

TEST(ReportText, KnownFailuresKeepTheirReason) {
  PortJudgement j = example_judgement();
  j.passes[3].status = j.passes[3].cases[0].status = Status::known;
  j.passes[3].cases[0].outputs[0].known = "driver 1.2 truncates";
  EXPECT_THAT(report_text(j), HasSubstr("KNOWN shade is outside"));
  EXPECT_THAT(report_text(j), HasSubstr("    known: driver 1.2 truncates\n"));
  j.stale.push_back("base.toml:3:1: [hit.hit] no longer fails");
  EXPECT_THAT(report_text(j), HasSubstr("\nbaseline: base.toml:3:1: [hit.hit] no longer fails\n"));
}

}  // namespace
}  // namespace rainref::reports
