// `rainref validate` with --json, --junit, --html, --markdown, --github and --baseline.
#include <map>
#include <regex>

#include <nlohmann/json.hpp>

#include "cli/support.h"
#include "cli/validate_reports.h"
#include "judging/judge_folder.h"
#include "reports/example_judgement.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// The small corrected pack beside `good`, its own outputs as a port's, and `bad`, with shade upside down.
class ValidateReports : public CommandLine {
 protected:
  ValidateReports() {
    std::filesystem::copy(reports::small_pack("puddle-corrected"), folder / "pack", std::filesystem::copy_options::recursive);
    const capture::Pack pack(folder / "pack");
    reports::write_port(pack, folder / "good");
    reports::write_port(pack, folder / "bad", [](const capture::PackCase& c, const std::string&, capture::Array& a) {
      if (c.pass == "shade") reports::flip_rows(a);
    });
    before = folder.names();
  }
  Outcome validate(const std::string& port, const std::vector<std::string>& options) const {
    return copied(joined({"validate", "pack", "--port", port}, options));
  }
};

TEST_F(ValidateReports, AllReportsOfAFailingPort) {
  const Outcome o = validate("bad", {"--json", "r.json", "--junit", "r.xml", "--html", "r.html"});
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_THAT(o.out,
              AllOf(HasSubstr("FAIL  shade"), HasSubstr("likely cause: upside down"), HasSubstr("FAIL: bad against pack, profile vulkan")));
  const auto json = nlohmann::json::parse(contents(folder / "r.json"));
  EXPECT_EQ(json["status"], "FAIL");
  EXPECT_EQ(json["first_bad_pass"], "shade");
  EXPECT_EQ(json["command"], "rainref validate pack --port bad --json r.json --junit r.xml --html r.html");
  const std::string junit = contents(folder / "r.xml");
  EXPECT_THAT(junit, HasSubstr("<failure type=\"outside\""));
  // Judging took time, and the search for causes more.
  std::smatch time;
  ASSERT_TRUE(std::regex_search(junit, time, std::regex("<testsuites [^>]* time=\"([0-9.]+)\"")));
  EXPECT_GT(std::stod(time[1]), 0);
  EXPECT_THAT(contents(folder / "r.html"), AllOf(StartsWith("<!DOCTYPE html>"), HasSubstr("</html>\n")));
  EXPECT_EQ(folder.names().size(), before.size() + 3);  // no temporary stays
}

// The verdict does not depend on the time for causes. When it ends early, no cause is called likely.
TEST_F(ValidateReports, WhenTheTimeForCausesIsOverANoteSaysSo) {
  const auto pack = std::make_shared<const capture::Pack>(folder / "pack");
  const parallel::Executor executor(2);
  judging::FolderOptions options;
  options.executor = &executor;
  for (const double seconds : {1e-9, 1e6}) {
    options.causes_within = seconds;
    const judge::PortJudgement judged = judging::judge_folder(pack, {folder / "bad"}, options).judged;
    const auto shade = std::find_if(judged.passes.begin(), judged.passes.end(), [](const auto& p) { return p.pass == "shade"; });
    ASSERT_NE(shade, judged.passes.end());
    EXPECT_EQ(shade->status, judge::Status::fail);
    const bool is_over = seconds < 1;
    EXPECT_EQ(std::count(judged.notes.begin(), judged.notes.end(),
                         "the time for causes was over before all were tried in shade: what is named there is the best so far"),
              is_over);
    EXPECT_EQ(std::any_of(shade->causes.begin(), shade->causes.end(), [](const judge::Cause& c) { return c.is_likely; }), !is_over);
  }
}
// Nobody looked for a cause: nothing says that it is unknown.
TEST_F(ValidateReports, WithoutCausesTheVerdictIsTheSame) {
  const Outcome o = validate("bad", {"--no-causes", "--json", "r.json", "--junit", "r.xml", "--html", "r.html"});
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_THAT(o.out, AllOf(HasSubstr("FAIL  shade"), HasSubstr("note: causes of failures were not looked for (--no-causes)"),
                           HasSubstr("FAIL: bad against pack, profile vulkan")));
  EXPECT_EQ(nlohmann::json::parse(contents(folder / "r.json"))["first_bad_pass"], "shade");
  for (const std::string name : {"r.json", "r.html"})
    EXPECT_THAT(contents(folder / name), AllOf(HasSubstr("\"cause_is_unknown\": false,\n"), Not(HasSubstr("\"cause_is_unknown\": true")),
                                               HasSubstr("\"causes\": []")))
        << name;
  for (const std::string& text : {o.out, contents(folder / "r.xml")})
    EXPECT_THAT(text, AllOf(Not(HasSubstr("likely cause")), Not(HasSubstr("ause unknown")), Not(HasSubstr("cause is unknown"))));
}

// As users of such tools expect: a program reads the report from a pipe, and people see the text beside it.
TEST_F(ValidateReports, AHyphenIsStandardOutput) {
  const Outcome o = validate("bad", {"--json", "-", "--junit", "r.xml"});
  EXPECT_EQ(o.code, 1);
  EXPECT_EQ(nlohmann::json::parse(o.out)["first_bad_pass"], "shade");
  EXPECT_THAT(o.err, HasSubstr("FAIL: bad against pack, profile vulkan"));
  EXPECT_THAT(contents(folder / "r.xml"), HasSubstr("<failure type=\"outside\""));
  EXPECT_FALSE(std::filesystem::exists(folder / "-"));
}

// For GitHub's actions: the summary's file is there before, and annotations stand between lines of text.
TEST_F(ValidateReports, ASummaryAndAnnotationsForAJob) {
  put(folder / "summary.md", "");
  Outcome o = validate("bad", {"--markdown", "summary.md", "--github"});
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_THAT(contents(folder / "summary.md"), AllOf(StartsWith("## FAIL: bad against pack, profile vulkan\n"),
                                                     HasSubstr("| FAIL | shade | "), HasSubstr("likely cause: upside down")));
  EXPECT_THAT(o.out, HasSubstr("\n::error title=rainref%3A shade::FAIL: "));
  o = validate("bad", {"--markdown", "-", "--github"});
  EXPECT_EQ(o.out, contents(folder / "summary.md"));
  EXPECT_THAT(o.err, HasSubstr("\n::error title=rainref%3A shade::FAIL: "));
  EXPECT_THAT(validate("good", {"--github"}).out, Not(HasSubstr("::error")));
  std::filesystem::remove(folder / "good/puddle.shade/0012.0/out.colour.npy");
  o = validate("good", {"--github"});
  EXPECT_EQ(o.code, 3);
  EXPECT_THAT(o.out, AllOf(HasSubstr("\n::error title=rainref%3A shade::"), HasSubstr("out.colour")));
  o = validate("none", {"--github"});
  EXPECT_EQ(o.code, 3);
  EXPECT_THAT(o.out, StartsWith("::error title=rainref::"));
}

TEST_F(ValidateReports, AllReportsOfAGoodPort) {
  expect(validate("good", {"--json", "r.json", "--junit", "r.xml", "--html", "r.html"}), 0);
  EXPECT_EQ(nlohmann::json::parse(contents(folder / "r.json"))["exit_code"], 0);
  EXPECT_THAT(contents(folder / "r.xml"), AllOf(Not(HasSubstr("<failure")), Not(HasSubstr("<error"))));
}

/// JUnit without its times, which differ from run to run.
std::string without_times(const std::string& text) { return std::regex_replace(text, std::regex(" time=\"[0-9.]+\""), ""); }

TEST_F(ValidateReports, ThreadsChangeNoByte) {
  validate("bad", {"--json", "a.json", "--junit", "a.xml", "--html", "a.html", "--threads", "1"});
  std::map<std::string, std::string> first;
  for (const std::string name : {"a.json", "a.xml", "a.html"}) first[name] = without_times(contents(folder / name));
  validate("bad", {"--json", "a.json", "--junit", "a.xml", "--html", "a.html", "--threads", "3"});
  for (auto& [name, bytes] : first) {
    while (bytes.find("--threads 1") != std::string::npos) bytes.replace(bytes.find("--threads 1"), 11, "--threads 3");
    EXPECT_EQ(without_times(contents(folder / name)), bytes) << name;
  }
}

TEST_F(ValidateReports, ABaselineForgivesWhatItLists) {
  put(folder / "known.toml", "[shade.colour]\nreason = 'the exporter flips; ticket 7'\n");
  const Outcome o = validate("bad", {"--baseline", "known.toml", "--junit", "r.xml", "--json", "r.json"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.out,
              AllOf(HasSubstr("KNOWN  shade"), HasSubstr("known: the exporter flips; ticket 7"), HasSubstr("KNOWN: bad against pack")));
  EXPECT_THAT(contents(folder / "r.xml"),
              AllOf(HasSubstr("<skipped message=\"known: the exporter flips; ticket 7"), Not(HasSubstr("<failure"))));
  EXPECT_EQ(nlohmann::json::parse(contents(folder / "r.json"))["status"], "KNOWN");
}

TEST_F(ValidateReports, ABaselineThatIsOutOfDateFails) {
  put(folder / "known.toml", "[shade.colour]\nreason = 'fixed long ago'\n");
  expect(validate("good", {"--baseline", "known.toml", "--junit", "r.xml"}), 1,
         HasSubstr("baseline: known.toml:2:1: [shade.colour] no longer fails (\"fixed long ago\"): remove the entry\n"));
  EXPECT_THAT(contents(folder / "r.xml"), HasSubstr("<testsuite name=\"baseline\" tests=\"1\" failures=\"1\""));
  EXPECT_EQ(validate("good", {"--baseline", "known.toml", "--only", "display"}).code, 0);  // shade was not judged
}

TEST_F(ValidateReports, BadArgumentsBeforeAnyWork) {
  put(folder / "typo.toml", "[shad.colour]\nreason = 'x'\n");
  put(folder / "silent.toml", "[shade.colour]\n");
  put(folder / "good.toml", "[shade.colour]\nreason = 'x'\n");
  std::filesystem::create_symlink("r", folder / "link");
  std::filesystem::create_directory_symlink("bad", folder / "folder");
  before = folder.names();
  const auto refused = [&](const std::vector<std::string>& options, int code, const testing::Matcher<const std::string&>& message) {
    expect_refusal(joined({"validate", "pack", "--port", "bad"}, options), code, message);
  };
  refused(
      {"--baseline", "typo.toml"}, 2,
      HasSubstr("typo.toml:2:1: expected a pass (raindrops, wave_step, surface_hit, shade, display), found 'shad'; did you mean 'shade'?"));
  refused({"--baseline", "silent.toml"}, 2, HasSubstr("expected a reason, found none"));
  refused({"--baseline", "none.toml"}, 4, HasSubstr("none.toml"));
  refused({"--baseline", ""}, 2, HasSubstr("--baseline: expected a file, found ''"));
  refused({"--html", ""}, 2, HasSubstr("--html: expected a file, found ''"));
  refused({"--html", "r", "--json", "r"}, 2, HasSubstr("two reports cannot have one name: 'r'"));
  refused({"--html", "-", "--json", "-"}, 2, "two reports cannot have one name: '-', standard output");
  refused({"--html", "./r", "--json", "r"}, 2, "two reports cannot be one file: 'r' and './r'");
  refused({"--html", "pack/../r", "--junit", "r"}, 2, HasSubstr("cannot be one file"));
  refused({"--html", "link", "--junit", "r"}, 2, HasSubstr("cannot be one file"));
  refused({"--html", "folder/r", "--junit", "bad/r"}, 2, HasSubstr("cannot be one file"));
  refused({"--baseline", "good.toml", "--json", "./good.toml"}, 2, "'./good.toml': a report would replace the baseline 'good.toml'");
  refused({"--html", "no/such/folder/r.html"}, 4, HasSubstr("no/such/folder/r.html"));
  refused({"--junit", "pack"}, 4, HasSubstr("pack"));
  refused({"--jsom", "r"}, 2, HasSubstr("did you mean '--json'?"));
}

TEST_F(ValidateReports, AMissingFileIsReportedInEveryFormat) {
  std::filesystem::remove(folder / "good/puddle.shade/0012.0/out.colour.npy");
  put(folder / "r.xml", "of an earlier run");
  expect(validate("good", {"--json", "r.json", "--junit", "r.xml", "--html", "r.html"}), 3);
  EXPECT_THAT(contents(folder / "r.xml"), AllOf(HasSubstr("<error type=\"not judged\""), HasSubstr("out.colour")));
  const auto json = nlohmann::json::parse(contents(folder / "r.json"));
  EXPECT_EQ(json["status"], "UNTESTED");
  EXPECT_EQ(json["exit_code"], 3);
  EXPECT_THAT(contents(folder / "r.html"), HasSubstr("out.colour"));
}

TEST_F(ValidateReports, AFullDiskLeavesNothing) {
  Circumstances c;
  c.file_bytes = 20'000;
  expect(copied({"validate", "pack", "--port", "bad", "--html", "r.html"}, c), 4, testing::_, HasSubstr("cannot write 'r.html'"));
  EXPECT_EQ(folder.names(), before);
}

/// C0 and DEL: what a terminal could take as commands, and XML cannot hold.
bool has_control(const std::string& text) {
  return std::any_of(text.begin(), text.end(),
                     [](char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == '\x7f'; });
}

// What a port says, and what files are called, reaches no terminal as a command.
TEST_F(ValidateReports, EscapeSequencesAreShownAndNotSent) {
  const std::string evil =
      "\x1b]0;title\x07\x1b[31m\xc2\x9b"
      "31m";
  put(folder / "good/port.json", "{\"api\": \"Vulkan\", \"device\": \"\\u001b[2Jgpu\\u009b\", \"driver\": \"\\u001b[2J\"}");
  Outcome o = validate("good", {"--html", "r.html", "--junit", "r.xml"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.out, HasSubstr("Vulkan \uFFFD[2Jgpu\uFFFD"));
  EXPECT_FALSE(has_control(o.out + o.err));
  EXPECT_FALSE(has_control(contents(folder / "r.xml")));
  EXPECT_THAT(contents(folder / "r.xml"), HasSubstr("value=\"\uFFFD[2J\"/>"));
  put(folder / "say.sh", "printf '" + evil + "\\n'; exit 3");
  o = rainref({"validate", "pack", "--exec", ": {out}; sh say.sh", "--junit", "r.xml", "--html", "r.html"});
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_THAT(o.out, HasSubstr("the port printed: \uFFFD]0;title\uFFFD\uFFFD[31m\uFFFD31m\n"));
  EXPECT_FALSE(has_control(o.out + o.err));
  EXPECT_FALSE(has_control(contents(folder / "r.xml")));
  std::string manifest = contents(folder / "pack/manifest.json");
  manifest.replace(manifest.find("\"scene\": \""), 10, "\"scene\": \"\\u001b[31m");
  put(folder / "pack/manifest.json", manifest);
  o = validate(evil, {});
  EXPECT_EQ(o.code, 3);
  EXPECT_THAT(o.err, HasSubstr("\uFFFD]0;title"));
  EXPECT_FALSE(has_control(o.out + o.err));
}

TEST(CommandText, IsWhatAShellReads) {
  const char* const argv[] = {"/usr/bin/rainref", "validate", "my pack", "--port", "it's", ""};
  EXPECT_EQ(command_text(6, argv), "rainref validate 'my pack' --port 'it'\\''s' ''");
}

}  // namespace
}  // namespace rainref::cli
