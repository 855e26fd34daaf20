// JUnit XML: valid by a schema, escaped, and in line with the exit code.
#include "reports/junit.h"

#include <cstdlib>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/example_judgement.h"
#include "reports/figures.h"
#include "reports/markup.h"
#include "source_folder.h"

namespace rainref::reports {
namespace {

using namespace judge;

using testing::HasSubstr;
using testing::Not;

/// What a shell command prints.
std::string output_of(const std::string& command) {
  std::string out;
  FILE* pipe = ::popen(command.c_str(), "r");
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) out.append(buffer, n);
  ::pclose(pipe);
  return out;
}

class ReportJunit : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v xmllint >/dev/null 2>&1") != 0) GTEST_SKIP() << "xmllint (libxml2-utils) is not installed";
  }
  /// The value of an XPath expression, after the file was found valid.
  std::string asked(const PortJudgement& j, bool allow_untested, const std::string& xpath, const Times& times = {}) {
    put(folder / "junit.xml", report_junit(j, allow_untested, times));
    const std::string file = (folder / "junit.xml").string();
    const std::string complaint =
        output_of(fmt::format("xmllint --noout --schema {}/tests/reports/junit.xsd {} 2>&1", rainref::test::source_folder(), file));
    EXPECT_EQ(complaint, file + " validates\n");
    std::string value = output_of(fmt::format("xmllint --xpath '{}' {}", xpath, file));
    while (value.ends_with('\n')) value.pop_back();
    return value;
  }
  /// Failures and errors, as counted and as declared at each level.
  int bad(const PortJudgement& j, bool allow_untested) {
    const std::string count = asked(j, allow_untested, "count(//failure) + count(//error)");
    EXPECT_EQ(count, asked(j, allow_untested, "/testsuites/@failures + /testsuites/@errors"));
    EXPECT_EQ(count, asked(j, allow_untested, "sum(//testsuite/@failures) + sum(//testsuite/@errors)"));
    EXPECT_EQ(asked(j, allow_untested, "count(//testcase)"), asked(j, allow_untested, "number(/testsuites/@tests)"));
    EXPECT_EQ(asked(j, allow_untested, "count(//skipped)"), asked(j, allow_untested, "sum(//testsuite/@skipped)"));
    return std::stoi(count);
  }
  TemporaryFolder folder;
};

TEST_F(ReportJunit, ASuiteForEachPassACaseForEachOutput) {
  const PortJudgement j = example_judgement();
  EXPECT_EQ(asked(j, false, "count(//testsuite)"), "4");
  EXPECT_EQ(asked(j, false, "count(//testcase)"), "5");
  EXPECT_EQ(asked(j, false, "string(//testsuite[4]/testcase[1]/@name)"), "rain.shade/0000.0/out.colour");
  EXPECT_EQ(asked(j, false, "string(//testsuite[4]/testcase[1]/@classname)"), "rain.shade");
  // The cause stands in the message: what lists failures shows no more than that.
  EXPECT_EQ(asked(j, false, "string(//testsuite[4]/testcase[1]/failure/@message)"),
            "6 of 32 elements outside; likely cause: upside down: the buffer is stored from the bottom up; a.comp:7: x = y;");
  const std::string text = asked(j, false, "string(//testsuite[4]/testcase[1]/failure)");
  EXPECT_THAT(
      text,
      HasSubstr(
          "(0, 1).w  got 1.00391 (0x3c04)  accepted 1 (0x3c00) to 1.00098 (0x3c01)  expected 1 (0x3c00)  off by 3 codes (0.00293)\n"));
  EXPECT_THAT(text, HasSubstr("likely cause: upside down: the buffer is stored from the bottom up (gives 2 of 2 failing texels bit for "
                              "bit, comes near 1)\na.comp:7: x = y;"));
  EXPECT_EQ(asked(j, false, "count(//testsuite[4]/testcase[2]/*)"), "0");
  EXPECT_THAT(asked(j, false, "string(//testsuite[2]/testcase[1]/system-out)"), HasSubstr("WARN: 2 elements"));
  EXPECT_THAT(asked(j, false, "string(//testsuite[4]/system-out)"), HasSubstr("median width 2 codes, 99 % below "));
  EXPECT_EQ(asked(j, false, "string(//testsuite[1]/properties/property[@name=\"device\"]/@value)"), "Test & <Device>");
}

// The outputs of a case are judged together; the suite's time holds the search for causes too.
TEST_F(ReportJunit, TimesAddUp) {
  PortJudgement j = example_judgement();
  PassJudgement& shade = j.passes[3];
  shade.cases[0].outputs.push_back(example_output("mask", Format::r8, 4, 2));
  const Times times{{{"rain.wave/0000.0", 0.5}, {"rain.shade/0000.0", 3}, {"rain.shade/0001.0", 0.0625}}, {{"shade", 4}}};
  for (int k = 1; k <= 2; ++k) EXPECT_EQ(asked(j, false, fmt::format("string(//testsuite[4]/testcase[{}]/@time)", k), times), "1.500");
  EXPECT_EQ(asked(j, false, "string(//testsuite[4]/testcase[3]/@time)", times), "0.062");
  EXPECT_EQ(asked(j, false, "string(//testsuite[4]/@time)", times), "7.062");
  EXPECT_EQ(asked(j, false, "string(/testsuites/@time)", times), "7.562");
  EXPECT_EQ(asked(j, false, "count(//@time)"), "0");
}

TEST_F(ReportJunit, FailsExactlyWhenTheExitCodeDoes) {
  PortJudgement j = example_judgement();
  EXPECT_EQ(bad(j, false), 2);  // shade and, because UNTESTED is not forgiven, noise
  EXPECT_EQ(bad(j, true), 1);

  j.passes.pop_back();
  j.status = Status::untested;
  EXPECT_EQ(exit_code(j, false), 1);
  EXPECT_EQ(bad(j, false), 1);
  EXPECT_EQ(exit_code(j, true), 0);
  EXPECT_EQ(bad(j, true), 0);
  EXPECT_EQ(asked(j, true, "string(//skipped/@message)"), "UNTESTED: 100 % of the elements have no useful bound");

  j.passes.erase(j.passes.begin(), j.passes.begin() + 2);  // nothing passed: not forgiven
  EXPECT_EQ(exit_code(j, true), 1);
  EXPECT_EQ(bad(j, true), 1);
}

TEST_F(ReportJunit, KnownFailuresAreSkippedAndStaleOnesFail) {
  PortJudgement j = example_judgement();
  j.passes = {j.passes[3]};
  j.status = j.passes[0].status = j.passes[0].cases[0].status = Status::known;
  j.passes[0].cases[0].outputs[0].known = "ticket 12";
  EXPECT_EQ(bad(j, false), 0);
  EXPECT_EQ(
      asked(j, false, "string(//skipped/@message)"),
      "known: ticket 12 (6 of 32 elements outside; likely cause: upside down: the buffer is stored from the bottom up; a.comp:7: x = y;)");
  j.stale.push_back("b.toml:1:1: [hit.hit] no longer fails (\"old\"): remove the entry");
  j.status = Status::fail;
  EXPECT_EQ(bad(j, false), 1);
  EXPECT_EQ(asked(j, false, "string(//testsuite[@name=\"baseline\"]/testcase/@name)"), j.stale[0]);
}

TEST_F(ReportJunit, WhatIsBrokenFailsByItself) {
  PortJudgement j = example_judgement();
  j.passes = {j.passes[0]};
  CaseJudgement& c = j.passes[0].cases[0];
  j.status = j.passes[0].status = c.status = Status::fail;
  c.broken = true;
  c.reason = "uniform x is not a number";
  EXPECT_EQ(bad(j, false), 1);
  EXPECT_EQ(asked(j, false, "string(//failure/@message)"), c.reason);
  EXPECT_EQ(asked(j, false, "string(//failure/@type)"), "broken");
  c.outputs.clear();
  EXPECT_EQ(bad(j, false), 1);
}

TEST_F(ReportJunit, NothingJudgedIsAnError) {
  PortJudgement j;
  j.reason = "port: expected a folder with the port's outputs, found none";
  EXPECT_EQ(bad(j, true), 1);
  EXPECT_EQ(asked(j, true, "string(//error/@message)"), j.reason);
  j.notes = {"the port printed: loading shade.spv", "the port printed: <device lost>"};
  EXPECT_EQ(asked(j, true, "string(//error)"), "the port printed: loading shade.spv\nthe port printed: <device lost>");
  j = example_judgement();
  j.passes = {example_pass("wave", Status::untested, {})};
  j.passes[0].reason = "the pack has no case of this pass";
  j.status = Status::untested;
  EXPECT_EQ(bad(j, false), 1);
  EXPECT_EQ(asked(j, false, "string(//failure/@message)"), "UNTESTED: the pack has no case of this pass");
}

// A port in progress: its passes to come are named, and failures unless forgiven. A file that cannot be used is an error.
TEST_F(ReportJunit, WhatWasNotJudgedIsNamed) {
  PortJudgement j = example_judgement();
  j.passes = {j.passes[0], example_pass("shade", Status::not_judged, {})};
  j.passes[1].reason = "the port has no files of this pass";
  j.first_bad_pass.clear();
  j.status = Status::untested;
  EXPECT_EQ(bad(j, false), 1);
  EXPECT_EQ(asked(j, false, "string(//failure/@message)"), "NOT JUDGED: the port has no files of this pass");
  EXPECT_EQ(bad(j, true), 0);
  EXPECT_EQ(asked(j, true, "string(//testsuite[@name=\"rain.shade\"]/testcase/skipped/@message)"),
            "NOT JUDGED: the port has no files of this pass");

  CaseJudgement open = j.passes[0].cases[0];
  open.outputs.clear();
  open.id = "rain.wave/0001.0";
  open.status = j.passes[0].status = Status::not_judged;
  j.passes[0].cases.push_back(open);
  j.files = {{ExitCode::port_files, "wave", open.id, "out.height", "'out.height.npy': expected 4x2, found 5x2"},
             {ExitCode::port_files, "wave", open.id, "out.mask", "'out.mask.npy' is missing"}};
  for (const bool allow : {false, true}) EXPECT_EQ(asked(j, allow, "count(//error)"), "1");
  EXPECT_EQ(asked(j, true, "string(//error/../@name)"), open.id);
  EXPECT_EQ(asked(j, true, "string(//error/@message)"), "'out.height.npy': expected 4x2, found 5x2");
  EXPECT_EQ(asked(j, true, "string(//error)"), "'out.height.npy': expected 4x2, found 5x2\n'out.mask.npy' is missing");
  EXPECT_EQ(bad(j, false), 2);
}

TEST_F(ReportJunit, WhatIsTakenAsDataIsSkipped) {
  PortJudgement j = example_judgement();
  CaseJudgement taken;
  taken.id = "rain.hash/0000.0";
  taken.status = Status::data;
  taken.reason = "taken as data: no GPU can reproduce it";
  j.passes = {j.passes[0], example_pass("hash", Status::data, {taken})};
  j.status = Status::pass;
  EXPECT_EQ(bad(j, false), 0);
  EXPECT_EQ(asked(j, false, "count(//testcase[@name=\"rain.hash/0000.0\"]/skipped)"), "1");
}

TEST_F(ReportJunit, HostileNames) {
  PortJudgement j = example_judgement();
  j.port = "a\x01 \"b\" <c> & 'd' \xff \xc3\xa9 ]]> \n\t\xef\xbf\xbf \xed\xa0\x80";
  EXPECT_EQ(asked(j, false, "string(//testsuite[1]/properties/property[@name=\"port\"]/@value)"),
            "a\xef\xbf\xbd \"b\" <c> & 'd' \xef\xbf\xbd \xc3\xa9 ]]> \n\t\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd "
            "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");
}

TEST(ReportMarkup, KeepsWhatXmlCanHold) {
  EXPECT_EQ(marked_up("<a b=\"c\">&\t\n\r"), "&lt;a b=&quot;c&quot;&gt;&amp;&#9;&#10;&#13;");
  EXPECT_EQ(marked_up("\xf0\x9f\x8c\xa7 \xe2\x80\xa6"), "\xf0\x9f\x8c\xa7 \xe2\x80\xa6");
  EXPECT_EQ(marked_up("\xc0\xaf"), "\xef\xbf\xbd\xef\xbf\xbd");                                  // overlong
  EXPECT_EQ(marked_up("\xf4\x90\x80\x80"), "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");  // beyond U+10FFFF
  EXPECT_EQ(marked_up("\xe2\x80"), "\xef\xbf\xbd\xef\xbf\xbd");                                  // cut off
  EXPECT_EQ(marked_up(std::string_view("\0", 1)), "\xef\xbf\xbd");
}

}  // namespace
}  // namespace rainref::reports
