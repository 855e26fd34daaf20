// The report for a terminal, and the figures that all reports share.
#include "reports/text.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/example_judgement.h"

namespace rainref::reports {
namespace {

using namespace judge;

using testing::AllOf;
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

TEST(ReportText, WhatTheFirstCauseSaysIsNotSaidAgain) {
  PortJudgement j = example_judgement();
  std::vector<Cause>& causes = j.passes[3].causes;
  ASSERT_FALSE(causes.empty());
  Cause same = causes[0], other = causes[0];
  same.name = "the same values";
  same.repeats_first = true;
  other.name = "another";
  causes.insert(causes.begin() + 1, {same, other});
  EXPECT_THAT(report_text(j), AllOf(Not(HasSubstr("the same values")), HasSubstr("another: ")));
}

TEST(ReportFigures, APassSumsItsCasesAndTakesTheWidestOutput) {
  const PortJudgement j = example_judgement();
  const Figures shade = figures_of(j.passes[3]);
  EXPECT_EQ(shade.elements, 64);
  EXPECT_EQ(shade.outside, 6);
  EXPECT_EQ(shade.failing, 2);
  EXPECT_EQ(shade.invocations, 16);
  EXPECT_EQ(shade.median_width.codes, 2);
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
  p.half_mode_is_open = true;
  EXPECT_EQ(half_text(p), "nothing tells how stores to half round: name it in port.json, as half_store");
  p.half_mode_is_open = p.half_mode_voted = false;
  EXPECT_EQ(half_text(p), "");
}

TEST(ReportText, OneAlignedLineForEachPass) {
  const std::string text = report_text(example_judgement());
  EXPECT_THAT(text, HasSubstr("          pass   outside  bounded  median width     99 %  ambiguous  vacuous    loose\n"
                              "PASS      wave    0 of 8    100 %       0 codes  0 codes          0      0 %      0 %\n"
                              "WARN      hit     0 of 8  87.50 %       7 codes  vacuous          4  12.50 %  25.00 %\n"));
  EXPECT_THAT(text, HasSubstr("          1 of 4 ambiguous invocations took another branch than the reference\n"));
  EXPECT_THAT(text,
              HasSubstr("UNTESTED  noise   0 of 8      0 %       vacuous  vacuous          0    100 %      0 %\n          100 % of the "
                        "elements have no useful bound\n"));
}

TEST(ReportText, SharesOfASampleSaySo) {
  PortJudgement j = example_judgement();
  EXPECT_EQ(sample_text(j.passes[1]), "");
  EXPECT_THAT(report_text(j), testing::Not(HasSubstr("sample")));
  j.passes[1].cases[0].outputs[0].unsampled = 4;
  EXPECT_EQ(sample_text(j.passes[1]), "widths and shares are those of a sample of 4 of 8 elements (--exhaustive computes all)");
  const std::string text = report_text(j);
  EXPECT_THAT(text, HasSubstr("WARN      hit     0 of 8  75.00 %       7 codes  vacuous          4  25.00 %  50.00 %\n"));
  EXPECT_THAT(text, HasSubstr("note: widths and shares of hit are those of samples; --exhaustive computes all\n"));
  PassJudgement& shade = j.passes[3];
  shade.half_is_least = {true, false, false};
  EXPECT_THAT(half_text(shade), HasSubstr("if to nearest: at least 8, toward zero: 2, either way: 2"));
  shade.half_votes = {0, 0, 0};
  EXPECT_EQ(half_text(shade), "stores to half: nothing that had to be computed tells how they round");
}

TEST(ReportText, WhatFailsWhereByHowMuchAndWhy) {
  const std::string text = report_text(example_judgement());
  EXPECT_THAT(
      text,
      HasSubstr("\nFAIL shade is outside the as-written envelope of rain.shade/1 under profile vulkan\n"
                "  first bad pass, its inputs are good\n"
                "  rain.shade/0000.0/out.colour (rgba16f 4x2): 6 of 32 elements outside (18.75 %)\n"
                "    (2, 0).y  got nan (0x7e01)  accepted 0.125 (0x3000) to 0.125122 (0x3001)  is not a number\n"
                "    (0, 1).w  got 1.00391 (0x3c04)  accepted 1 (0x3c00) to 1.00098 (0x3c01)  off by 3 codes (0.00293)\n"
                "    (4 more not shown)\n"
                "  where: only channel y of colour\n"
                "  likely cause: upside down: the buffer is stored from the bottom up (gives 2 of 2 failing texels bit for bit, comes\n"
                "    near 1)\n"
                "a.comp:7: x = y;\n"));
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

TEST(ReportText, AnUnknownCauseMayHaveLines) {
  PortJudgement j = example_judgement();
  judge::Cause& cause = j.passes[3].causes[0];
  cause = {"cause unknown", "no tried mistake accounts for half of the failures"};
  cause.lines = {{"a.comp", 7, "x = y;"}};
  EXPECT_THAT(report_text(j), HasSubstr("  cause unknown: no tried mistake accounts for half of the failures\na.comp:7: x = y;\n"));
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
  EXPECT_THAT(report_text(j),
              HasSubstr("out.colour (7 records): 2 of 7 records outside (28.57 %)\n"
                        "    record 4, velocity.y  got 1.00000024 (0x3f800002)  accepted 1 (0x3f800000)  off by 2 codes (2.38e-07)\n"
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

QuantityJudgement quantity(const std::string& name, const std::string& unit, double codes, double width) {
  QuantityJudgement q;
  q.name = name;
  q.unit = unit;
  q.extent = 2;
  q.elements = 100;
  q.median_codes = q.p99_codes = codes;
  q.median_width = q.p99_width = width;
  return q;
}

// Floats from -0.001 to 0.001 are two thousand million: 0.1 % of the range, and no bound is vacuous.
TEST(ReportFigures, AWidthIsInCodesWhereTheySayAnything) {
  EXPECT_EQ(width_text({0}), "0 codes");
  EXPECT_EQ(width_text({1}), "1 code");
  EXPECT_EQ(width_text({3113}), "3113 codes");
  EXPECT_EQ(width_text({4e9}), "vacuous");
  OutputJudgement o = example_output("wave", Format::rg32f, 5, 10);
  o.quantities = {quantity("x", "m", 7, 1e-6), quantity("y", "m/s", 1'962'000'000, 0.002)};
  o.median_width = o.p99_width = 1'750'702'514;
  EXPECT_EQ(width_text(median_width(o)), "0.002 m/s");
  EXPECT_EQ(width_text(p99_width(o)), "0.002 m/s");
  o.quantities[1].unit = "1";
  EXPECT_EQ(width_text(median_width(o)), "0.002");
  // Vacuous ones are the widest: of two in a hundred what 99 % stay below is one, what half stay below is not.
  o.vacuous = 2;
  EXPECT_EQ(width_text(p99_width(o)), "vacuous");
  EXPECT_EQ(width_text(median_width(o)), "0.002");
  o.vacuous = 60;
  EXPECT_EQ(width_text(median_width(o)), "vacuous");
  PortJudgement j = example_judgement();
  j.passes[0].cases[0].outputs[0] = o;
  EXPECT_THAT(report_text(j), Not(HasSubstr("1750702514")));
}

// Names of what is never taken, some of them; nothing where nothing is counted, or where all is taken.
TEST(ReportFigures, WhatAPackExercises) {
  PassCoverage c{
      5, 9, {"a.pass.h, min the second: x", "a.pass.h, clamp below: y", "a.pass.h, clamp above: y", "a.pass.h, select the first: z"}};
  EXPECT_EQ(
      coverage_text(c, 4),
      "exercises 5 of 9 alternatives; never: a.pass.h, min the second: x; a.pass.h, clamp below: y; a.pass.h, clamp above: y; a.pass.h, "
      "select the first: z");
  EXPECT_EQ(coverage_text(c, 1), "exercises 5 of 9 alternatives; never: a.pass.h, min the second: x and 3 more");
  EXPECT_EQ(coverage_text({9, 9, {}}, 3), "exercises 9 of 9 alternatives");
  EXPECT_EQ(coverage_text({6, 9, {"b"}, {{"c", "a guard"}, {"d", "a guard"}}}, 3),
            "exercises 6 of 9 alternatives, 2 with a reason not; never: b");
  EXPECT_EQ(coverage_text({}, 3), "");
  EXPECT_EQ(coverage_text(c, 0), "exercises 5 of 9 alternatives, 4 without one");
  EXPECT_EQ(coverage_text({6, 9, {"b"}, {{"c", "a guard"}, {"d", "a guard"}}}, 0),
            "exercises 6 of 9 alternatives, 2 with a reason not, 1 without one");
  EXPECT_EQ(coverage_text({9, 9, {}}, 0), "exercises 9 of 9 alternatives");
  // Lines of our source stand where they are asked for.
  PortJudgement j = example_judgement();
  j.passes[0].coverage = j.passes[1].coverage = c;
  j.passes[3].coverage = {9, 9, {}};
  EXPECT_THAT(report_text(j), Not(HasSubstr("exercises")));
  const std::string text = report_text(j, true);
  EXPECT_THAT(text, HasSubstr("exercises 5 of 9 alternatives; never: a.pass.h, min the second: x; a.pass.h, clamp below: y"));
  EXPECT_THAT(text, HasSubstr("select the first: z"));  // all of them
  EXPECT_THAT(text, Not(HasSubstr("9 of 9")));
}

TEST(ReportFigures, ADistanceIsInCodesAndInTheUnit) {
  OutputJudgement o = example_output("wave", Format::rg32f, 5, 10);
  o.quantities = {quantity("x", "m", 0, 0), quantity("y", "m/s", 0, 0)};
  Failure f{2, 3, 1, 0x40000000, 0x3f800000, 0x3f800001, 0x3f800000, 0x7fffff};  // 2 where 1 is right
  EXPECT_EQ(failure_text(o, f).distance, "off by 8388607 codes (1 m/s)");
  f.channel = 0;
  f.got = 0x3f000000;  // 0.5
  f.distance = 0x800000;
  EXPECT_EQ(failure_text(o, f).distance, "off by 8388608 codes (0.5 m)");
  f.got = 0x7f800000;
  EXPECT_THAT(failure_text(o, f).distance, Not(HasSubstr("(")));  // infinity is no number of metres away
}

TEST(ReportFigures, WhatFailsWorstIsFarthestOffInItsRange) {
  OutputJudgement o = example_output("wave", Format::rg32f, 5, 10), other = o;
  EXPECT_EQ(worst_quantity(o), nullptr);
  o.quantities = {quantity("x", "m", 0, 0), quantity("y", "m", 0, 0), quantity("z", "m", 0, 0)};
  o.quantities[0].failing = 50;
  o.quantities[0].farthest = 0.1;
  o.quantities[1].failing = 2;
  o.quantities[1].farthest = 1;
  EXPECT_EQ(worst_quantity(o)->name, "y");
  o.quantities[0].extent = 0.1;
  EXPECT_EQ(worst_quantity(o)->name, "x");
  o.quantities[2].failing = 1;
  o.quantities[2].farthest = std::numeric_limits<double>::infinity();
  EXPECT_EQ(worst_quantity(o)->name, "z");
  EXPECT_TRUE(fails_worse(o, other));
  EXPECT_FALSE(fails_worse(other, o));
}

TEST(ReportText, TheFieldsOfAListHaveWidthsInTheirUnits) {
  PortJudgement j = example_judgement();
  OutputJudgement& o = j.passes[0].cases[0].outputs[0];
  o.name = "drops";
  o.records = true;
  o.counted = Counted::fields;
  o.map.clear();
  o.quantities = {quantity("velocity.x", "m/s", 12, 1.5e-6), quantity("mass", "mg", 0, 0), quantity("life", "s", 40, 0.5)};
  o.quantities[2].vacuous = 3;
  o.quantities[2].loose = 7;
  EXPECT_THAT(report_text(j, true),
              HasSubstr("\n          drops, median width by field: velocity.x 1.5e-06, 99 % 1.5e-06 m/s; life 0.5, 99 % vacuous, "
                        "3 vacuous, 4\n            loose; the other 1: one value each\n"));
}

// Whatever is known of it.
TEST(ReportText, APassingPassIsOneLine) {
  PortJudgement j = example_judgement();
  j.passes.erase(j.passes.begin() + 1, j.passes.end());
  PassJudgement& wave = j.passes[0];
  wave.half_mode_voted = true;
  wave.coverage = {5, 9, {"a.pass.h, min the second: x"}};
  wave.cases[0].ambiguous = 4;
  wave.cases[0].other_branch = wave.cases[0].gave_up = 1;
  wave.cases[0].outputs[0].typical = 3;
  wave.cases[0].outputs[0].free = 1;
  const std::string text = report_text(j);
  const std::size_t at = text.find("PASS  wave");
  ASSERT_NE(at, std::string::npos);
  EXPECT_THAT(text.substr(text.find('\n', at)), testing::StartsWith("\nnote: ")) << text;
  EXPECT_THAT(report_text(j, true),
              AllOf(HasSubstr("took another branch"), HasSubstr("known devices do bounds 3"), HasSubstr("exercises")));
}

// Where a device may be the reason, it is not called the cause of failures.
TEST(ReportText, AWarningsLikelyCauseStandsBelowIt) {
  PortJudgement j = example_judgement();
  j.passes[1].causes.push_back({"10 bits", "the viewport has 10 bits", 2, 2, 2, false, true});
  EXPECT_THAT(report_text(j), HasSubstr("likely cause: 10 bits: the viewport has 10 bits (gives 2 of 2 warned texels bit for bit"));
}

// What fails only because no known device does it is not said to be outside the envelope.
TEST(ReportText, WhatNoDeviceDoesIsSaidSo) {
  PortJudgement j = example_judgement();
  CaseJudgement& c = j.passes[3].cases[0];
  c.beyond = c.failing;
  c.outputs[0].beyond = c.outputs[0].failing;
  EXPECT_THAT(report_text(j), HasSubstr("FAIL shade is outside what any known device makes of rain.shade/1 under profile vulkan"));
}

// A port in progress, and one whose files are bad: what was not judged stands with the verdict.
TEST(ReportText, WhatWasNotJudgedIsListed) {
  PortJudgement j = example_judgement();
  j.passes.erase(j.passes.begin() + 1, j.passes.end());
  for (const char* name : {"shade", "display"}) {
    j.passes.push_back(example_pass(name, Status::not_judged, {}));
    j.passes.back().reason = "the port has no files of this pass";
  }
  j.first_bad_pass.clear();
  j.status = Status::untested;
  std::string text = report_text(j);
  EXPECT_THAT(text, HasSubstr("\nNOT JUDGED  shade    nothing judged"));
  EXPECT_THAT(text, HasSubstr("(2 NOT JUDGED, 1 PASS)\n  not judged: shade, display\n"));
  EXPECT_EQ(exit_code(j, false), 1);
  EXPECT_EQ(exit_code(j, true), 0);
  j.files = {{ExitCode::port_files, "wave", "rain.wave/0001.0", "out.height", "'port/out.height.npy': expected 4x2, found 5x2"}};
  text = report_text(j);
  EXPECT_THAT(text, HasSubstr("\nmissing, or cannot be used:\n  'port/out.height.npy': expected 4x2, found 5x2\n"));
  for (const bool allow : {false, true}) EXPECT_EQ(exit_code(j, allow), 3);
  j.status = Status::fail;
  EXPECT_EQ(exit_code(j, false), 3);
  j.files.push_back({ExitCode::io, "wave", "rain.wave/0002.0", "out.height", "'port/out.height.npy': cannot be read"});
  EXPECT_EQ(exit_code(j, false), 4);
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
