// The judgement as Markdown: each pass with its cause, and nothing that a port says formats anything.
#include "reports/markdown.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/example_judgement.h"
#include "reports/text.h"

namespace rainref::reports {
namespace {

using namespace judge;

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(ReportMarkdown, NamesEachPassWithItsCause) {
  const PortJudgement j = example_judgement();
  const std::string text = report_markdown(j);
  EXPECT_THAT(text, StartsWith("## FAIL: port against pack, profile vulkan\n\nVulkan 1.3 Test &amp; &lt;Device&gt;\n\n"
                               "| verdict | pass | invocations outside | why |\n|---|---|---|---|\n| PASS | wave | 0 of 8 |  |\n"
                               "| WARN | hit | 0 of 8 | 2 elements lie inside the profile but outside what known devices do |\n"));
  EXPECT_THAT(
      text,
      HasSubstr("| FAIL | shade | 2 of 16 | likely cause: upside down: the buffer is stored from the bottom up; a.comp:7: x = y; |\n"));
  EXPECT_THAT(text, HasSubstr("<details><summary>The whole report</summary>\n\n```text\n" + report_text(j) + "```\n\n</details>\n"));
}

TEST(ReportMarkdown, SaysWhyNothingWasJudged) {
  PortJudgement j;
  j.pack = "pack";
  j.port = "port";
  j.reason = "port: expected a folder with the port's outputs, found none";
  EXPECT_THAT(report_markdown(j),
              AllOf(HasSubstr("\n\nport: expected a folder with the port's outputs, found none\n"), Not(HasSubstr("| verdict |"))));
}

TEST(ReportMarkdown, HostileNamesFormatNothing) {
  PortJudgement j = example_judgement();
  j.port = "a|b*c_d`e`[f](g)<h>\\\n# i";
  j.notes = {"````", "\x1b[2J"};
  const std::string text = report_markdown(j);
  EXPECT_THAT(text, StartsWith("## FAIL: a\\|b\\*c\\_d\\`e\\`\\[f\\](g)&lt;h&gt;\\\\&#10;# i against pack, "));
  EXPECT_THAT(text, AllOf(HasSubstr("\n`````text\n"), HasSubstr("note: ````\n"), HasSubstr("\n`````\n"), Not(HasSubstr("\x1b"))));
}

}  // namespace
}  // namespace rainref::reports
