// `rainref demo`: a newcomer's first verdict, from wherever the program lies.
#include <filesystem>

#include "cli/support.h"
#include "simulation/own_scenes.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Demo : public CommandLine {
 protected:
  void SetUp() override {
    if (simulation::own_data("demo").empty()) GTEST_SKIP() << "no glslangValidator (Debian: glslang-tools)";
  }
};

TEST_F(Demo, JudgesAWrongPortAndTheRightOne) {
  const Outcome o = rainref({"demo"});
  expect(o, 0, testing::_, "");
  const std::size_t wrong = o.out.find("\n$ rainref validate rainref-demo/pack --port rainref-demo/wrong/out");
  const std::size_t right = o.out.find("\n$ rainref validate rainref-demo/pack --port rainref-demo/right/out");
  ASSERT_NE(right, std::string::npos) << o.out;
  ASSERT_LT(wrong, right);
  EXPECT_THAT(o.out.substr(0, wrong), AllOf(HasSubstr("no GPU"), HasSubstr("executes their shaders (SPIR-V) on the CPU"),
                                            HasSubstr("\n$ rainref pack rainref-demo/puddle.toml --at 24 --passes shade -o")));
  EXPECT_THAT(o.out.substr(wrong, right - wrong),
              AllOf(HasSubstr("\nFAIL shade is outside"), HasSubstr("likely cause: refraction ratio inverted"),
                    HasSubstr("\nshade_corrected.comp:57: vec3 bent = refract(view, normal, WATER_IOR);\n"),
                    HasSubstr("rainref executed the shader itself"), HasSubstr("the mistake is in the shader"), HasSubstr("(1 FAIL)")));
  EXPECT_THAT(o.out.substr(right),
              AllOf(HasSubstr("(1 PASS)"), HasSubstr("rainref-demo/report.html"), HasSubstr("docs/porting.md"), Not(HasSubstr("FAIL"))));
  EXPECT_LT(lines_of(o.out).size(), 60u) << o.out;

  // What it typed, a user may type again.
  for (const std::string& line : lines_of(o.out)) {
    if (!line.starts_with("$ rainref ")) continue;
    const std::string command = fmt::format("'{}' {}", program_under_test(), line.substr(10));
    const int status = output_of(fmt::format("cd '{}' && {} > again", folder.path().string(), command)).second;
    EXPECT_EQ(status != 0, line.find("/wrong/") != line.npos) << line;
    EXPECT_THAT(o.out, HasSubstr(contents(folder / "again")));
  }
  EXPECT_THAT(contents(folder / "rainref-demo/report.html"), AllOf(HasSubstr("refraction ratio inverted"), HasSubstr("refract(view")));
  // Its own folder it takes again.
  EXPECT_EQ(rainref({"demo"}).out, o.out);
}

TEST_F(Demo, TakesNoFolderOfOthers) {
  fs::create_directory(folder / "mine");
  put(folder / "mine/notes.txt", "");
  put(folder / "file", "");
  before = folder.names();
  expect_refusal({"demo", "-o", "mine"}, 2, "--output mine: expected a new folder, or that of an earlier demo, found 'notes.txt' in it");
  expect_refusal({"demo", "-o", "file"}, 2, "--output file: expected a folder, found a file");
  expect_refusal({"demo", "-o", ""}, 2, HasSubstr("--output"));
  expect_refusal({"demo", "-o", "file/below"}, 4, HasSubstr("cannot make 'file/below'"));
}

}  // namespace
}  // namespace rainref::cli
