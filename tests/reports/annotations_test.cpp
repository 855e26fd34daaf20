// Annotations of GitHub's actions: at the shader's line, escaped, and an error exactly when the exit code says so.
#include "reports/annotations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/example_judgement.h"
#include "reports/figures.h"

namespace rainref::reports {
namespace {

using namespace judge;

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(ReportAnnotations, StandAtTheLineOfTheFirstCause) {
  PortJudgement j = example_judgement();
  EXPECT_EQ(
      report_annotations(j, true),
      "::error file=a.comp,line=7,title=rainref%3A shade::FAIL: 2 of 16 invocations outside; likely cause: upside down: the buffer is "
      "stored from the bottom up; a.comp:7: x = y;\n"
      "::warning title=rainref%3A hit::WARN: 2 elements lie inside the profile but outside what known devices do\n");
  j.passes[3].causes[0].lines.clear();
  EXPECT_THAT(report_annotations(j, true), StartsWith("::error title=rainref%3A shade::FAIL: 2 of 16 "));
}

TEST(ReportAnnotations, AnErrorExactlyWhenTheExitCodeIsNotZero) {
  const auto has_error = [](const PortJudgement& j, bool allow_untested) {
    const bool has = report_annotations(j, allow_untested).find("::error ") != std::string::npos;
    EXPECT_EQ(has, exit_code(j, allow_untested) != 0);
    return has;
  };
  PortJudgement j = example_judgement();
  EXPECT_TRUE(has_error(j, false));
  EXPECT_TRUE(has_error(j, true));
  j.passes.pop_back();
  j.status = Status::untested;
  EXPECT_TRUE(has_error(j, false));
  EXPECT_FALSE(has_error(j, true));
  j.files = {{ExitCode::port_files, "wave", "rain.wave/0001.0", "out.height", "'out.height.npy' is missing"},
             {ExitCode::port_files, "wave", "rain.wave/0002.0", "out.height", "'out.height.npy' is missing there, too"}};
  EXPECT_TRUE(has_error(j, true));
  EXPECT_THAT(report_annotations(j, true), StartsWith("::error title=rainref%3A wave::'out.height.npy' is missing (and 1 more)\n"));

  PortJudgement known = example_judgement();
  known.status = known.passes[3].status = Status::known;
  EXPECT_FALSE(has_error(known, true));
  known.stale.push_back("b.toml:1:1: [hit.hit] no longer fails (\"old\"): remove the entry");
  known.status = Status::fail;
  EXPECT_TRUE(has_error(known, true));

  PortJudgement nothing;
  nothing.status = Status::fail;
  nothing.reason = "the port ended with exit code 3";
  EXPECT_TRUE(has_error(nothing, false));
  EXPECT_EQ(report_annotations(nothing, false), "::error title=rainref::the port ended with exit code 3\n");
}

// A port's file names and words begin no command of their own.
TEST(ReportAnnotations, HostileTextIsEscaped) {
  PortJudgement j = example_judgement();
  j.passes[3].causes[0].lines[0].file = "a,b:c%\r\n::add-mask::x";
  j.passes[3].causes[0].lines[0].text = "100 %\n::error::";
  const std::string text = report_annotations(j, true);
  EXPECT_THAT(text, StartsWith("::error file=a%2Cb%3Ac%25%0D%0A%3A%3Aadd-mask%3A%3Ax,line=7,title="));
  EXPECT_THAT(text, HasSubstr(": 100 %25%0A::error::\n"));
  EXPECT_THAT(text, Not(HasSubstr("\n::add-mask")));
}

}  // namespace
}  // namespace rainref::reports
