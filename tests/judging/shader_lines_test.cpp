// The line of a port's shader that a verdict points at. The mistakes, and the lines that they stand in, were written by somebody else,
// in ports of another form than the examples (tests/ports/mistakes/set_o.json).
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/read_file.h"
#include "base/shell.h"
#include "base/temporary_folder.h"
#include "capture/npy_write.h"
#include "judging/judge_folder.h"
#include "shipped_packs.h"
#include "source_folder.h"
#include "spirv/bindings.h"

namespace rainref::judging {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::string text_of(const fs::path& file) {
  const std::vector<std::byte> bytes = read_file(file);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
/// Lines of a text without the blanks around them; the first is number 1.
std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out{""};
  std::istringstream all(text);
  for (std::string line; std::getline(all, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    out.push_back(begin == std::string::npos ? "" : line.substr(begin));
  }
  return out;
}

struct Judged {
  std::vector<judge::Cause> causes;
  std::vector<std::string> source;  ///< of the edited file
  Json mistake;
};

/// A port of one pass with a mistake in it, compiled with or without its lines, executed and judged. Set o is in ports of its own.
Judged judged(const std::string& id, const std::string& pack_name, const std::string& option) {
  const fs::path ports = fs::path(test::source_folder()) / "tests/ports";
  Judged out;
  const Json set = Json::parse(text_of(ports / ("mistakes/set_" + id.substr(0, 1) + ".json")));
  for (const Json& m : set["mistakes"])
    if (m["id"] == id) out.mistake = m;
  const std::string pass = out.mistake["pass"], edited = out.mistake["edits"][0]["file"];
  const bool is_example = !edited.starts_with("other_hand/");
  const std::string effect = is_example ? edited.substr(0, edited.find('/')) : std::string(out.mistake["effect"]);
  const fs::path examples = fs::path(test::source_folder()) / "examples/ports";
  const TemporaryFolder folder;
  fs::copy((is_example ? examples : ports / "other_hand") / effect, folder / "src");
  const auto pack = std::make_shared<const capture::Pack>(test::pack_folder(pack_name));
  const std::string formula = pack->pass(pass).formula;
  Json program = Json::parse(text_of(folder / "src/bindings.json"))["programs"][formula];
  const std::string shader = fs::path(std::string(program["spirv"])).stem().string() + ".comp";
  for (const Json& e : out.mistake["edits"]) {
    const fs::path file = folder / "src" / fs::path(std::string(e["file"])).filename();
    std::string text = text_of(file);
    const std::string find = e["find"];
    text.replace(text.find(find), find.size(), std::string(e["replace"]));
    std::ofstream(file) << text;
    out.source = lines_of(text);
  }
  const fs::path spirv = folder / "spirv", port = folder / "port";
  fs::create_directories(spirv);
  const auto [said, status] =
      output_of("cd '" + (folder / "src").string() + "' && '" RAINREF_GLSLANG "' -V " + option + " --target-env vulkan1.1 --quiet -I'" +
                (examples / "common").string() + "' " + shader + " -o ../spirv/a.spv");
  if (status != 0) throw std::runtime_error(said);
  program["spirv"] = "a.spv";
  std::ofstream(spirv / "bindings.json") << Json{{"programs", {{formula, program}}}};

  const auto programs = spirv::read_programs(spirv);
  for (const capture::PackCase& entry : pack->cases) {
    if (entry.pass != pass) continue;
    const capture::PassCase c = pack->read(entry);
    const auto given = spirv::execute(c, programs.at(formula), spirv::read_spirv(programs.at(formula)), "'a.spv'");
    fs::create_directories(port / entry.id);
    for (std::size_t o = 0; o < given.size(); ++o) {
      const std::vector<std::byte> npy = capture::npy_bytes(given[o], 0);
      std::ofstream(port / entry.id / ("out." + programs.at(formula).outputs[o] + ".npy"), std::ios::binary)
          .write(reinterpret_cast<const char*>(npy.data()), static_cast<std::streamsize>(npy.size()));
    }
  }
  const parallel::Executor executor(2);
  FolderOptions options;
  options.only = {pass};
  options.executor = &executor;
  options.spirv = spirv;
  for (const judge::PassJudgement& p : judge_folder(pack, {port}, options).judged.passes)
    if (p.pass == pass) out.causes = p.causes;
  return out;
}

class ShaderLines : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(RAINREF_GLSLANG) == "") GTEST_SKIP() << "needs glslangValidator";
  }
};

/// Whether the first line is the one that the set names, or a missing step is where it says.
void expect_line(const std::string& id, const std::string& pack) {
  SCOPED_TRACE(id);
  const Judged j = judged(id, pack, "-g");
  ASSERT_FALSE(j.causes.empty());
  ASSERT_FALSE(j.causes[0].lines.empty()) << j.causes[0].name;
  const judge::ShaderLine& line = j.causes[0].lines[0];
  const auto number = [&](const std::string& text) {
    return static_cast<int>(std::find(j.source.begin(), j.source.end(), text) - j.source.begin());
  };
  if (j.mistake.contains("line")) {
    EXPECT_EQ(line.line, number(j.mistake["line"]["text"])) << line.text;
    EXPECT_EQ(line.text, std::string(j.mistake["line"]["text"]));
  } else {
    EXPECT_LE(line.line, number(j.mistake["between"]["texts"][0])) << line.text;
    EXPECT_GE(line.until, number(j.mistake["between"]["texts"][1]));
  }
}
TEST_F(ShaderLines, OfAShade) { expect_line("o008", "puddle-as-published"); }
TEST_F(ShaderLines, OfALookup) { expect_line("o028", "edge_splash-corrected"); }
TEST_F(ShaderLines, OfAMissingStep) { expect_line("o002", "puddle-as-published"); }
TEST_F(ShaderLines, OfACondition) { expect_line("q005", "puddle-corrected"); }
TEST_F(ShaderLines, OfARounding) { expect_line("o026", "edge_splash-corrected"); }
TEST_F(ShaderLines, OfARecordOfAList) { expect_line("q016", "windshield-as-published"); }

TEST_F(ShaderLines, AreNotSaidOfAShaderWithoutThem) {
  const Judged j = judged("o008", "puddle-as-published", "");
  ASSERT_FALSE(j.causes.empty());
  EXPECT_TRUE(j.causes[0].lines.empty());
}

}  // namespace
}  // namespace rainref::judging
