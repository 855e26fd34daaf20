// Who is wrong: all that may come of a port's dump, its SPIR-V and the reference.
#include "judging/shader_answer.h"

#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/temporary_folder.h"
#include "capture/npy_write.h"
#include "judge/evaluations.h"
#include "judge/profiles.h"
#include "judging/judge_folder.h"
#include "shipped_packs.h"
#include "spirv/spirv_model.h"

namespace rainref::judging {
namespace {

namespace fs = std::filesystem;
using capture::Array, capture::PassCase;
using testing::Contains, testing::HasSubstr, testing::Not, testing::StartsWith;

const std::string formula = "puddle.display.corrected/1";

class ShaderAnswers : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(RAINREF_SPIRV) == "") GTEST_SKIP() << "needs glslangValidator";
    const auto entry = std::find_if(pack_.cases.begin(), pack_.cases.end(), [](const auto& c) { return c.pass == "display"; });
    id_ = entry->id;
    c_ = pack_.read(*entry);
  }
  static spirv::Program program(const std::string& file) {
    spirv::Program p = spirv::read_programs(fs::path(RAINREF_SPIRV) / "puddle").at(formula);
    p.spirv = p.spirv.parent_path() / file;
    return p;
  }
  std::vector<Array> given_by(const std::string& file) const {
    return spirv::execute(c_, program(file), spirv::read_spirv(program(file)), "'a.spv'");
  }
  /// Rows as a host reads them that takes another row to be the first.
  static std::vector<Array> upside_down(std::vector<Array> from) {
    for (Array& a : from) {
      const std::size_t row = a.element_bytes() * static_cast<std::size_t>(a.width);
      std::vector<std::byte> out;
      for (auto at = a.levels[0].size(); at >= row && at > 0; at -= row)
        out.insert(out.end(), a.levels[0].begin() + static_cast<std::ptrdiff_t>(at - row),
                   a.levels[0].begin() + static_cast<std::ptrdiff_t>(at));
      a.levels[0] = out;
    }
    return from;
  }
  ShaderAnswer ask(const std::string& shader, const std::vector<Array>& stored) const {
    const spirv::Program p = program(shader);
    const auto reference = judge::binder("puddle", "display")(c_);
    const auto model = spirv::spirv_model(c_, p, spirv::read_spirv(p), "'a.spv'");
    return ask_shader(c_, *reference, *model, stored, {{3, 2}, {10, 4}, {20, 9}, {30, 15}, {12, 18}}, judge::profile("vulkan"),
                      judge::HalfMode::either);
  }

  capture::Pack pack_{test::pack_folder("puddle-corrected")};
  std::string id_;
  PassCase c_;
};
const std::string right = "display_corrected.spv", wrong = "display_as_published.spv";

TEST_F(ShaderAnswers, TheDeviceDidWhatAWrongShaderSays) {
  const ShaderAnswer a = ask(wrong, given_by(wrong));
  EXPECT_EQ(a.said, a.tried);
  EXPECT_THAT(sentence(a, true), StartsWith("the device did what this shader says (5 of 5 "));
}
TEST_F(ShaderAnswers, ARightShaderWasReadBackWrongly) {
  const ShaderAnswer a = ask(right, upside_down(given_by(right)));
  EXPECT_EQ(a.said + a.right, a.tried);
  EXPECT_GE(a.right, 4);
  EXPECT_THAT(sentence(a, true), HasSubstr("the shader is right"));
}
TEST_F(ShaderAnswers, AWrongShaderThatWasReadBackWronglyIsNeither) {
  const ShaderAnswer a = ask(wrong, upside_down(given_by(wrong)));
  EXPECT_LE(a.said + a.right, 1);
  EXPECT_THAT(sentence(a, true), HasSubstr("is it the one that ran?"));
}
TEST_F(ShaderAnswers, OfAPassThatPassesOnlyAnotherShaderIsSaid) {
  EXPECT_EQ(sentence(ask(right, given_by(right)), false), "");
  EXPECT_EQ(sentence(ask(wrong, given_by(right)), false), "passes, but not by what this SPIR-V says: is it the one that ran?");
  EXPECT_EQ(sentence({}, false), "");
}

// The whole way: a dump, a folder with bindings.json, notes. Other passes are not asked about.
TEST_F(ShaderAnswers, NotesSayItOfAFolder) {
  const TemporaryFolder folder;
  const auto notes = [&](const std::string& dumped, const std::string& shader) {
    const fs::path port = folder / (dumped + shader), shaders = folder / ("shaders " + dumped + shader);
    fs::create_directories(shaders);
    fs::copy(fs::path(RAINREF_SPIRV) / "puddle" / shader, shaders / "mine.spv");
    put(shaders / "bindings.json",
        R"({"programs": {")" + formula + R"(": {"spirv": "mine.spv", "inputs": ["colour"], "outputs": ["picture"]}}})");
    for (const capture::PackCase& entry : pack_.cases) {
      if (entry.pass != "display") continue;
      c_ = pack_.read(entry);
      fs::create_directories(port / entry.id);
      const std::vector<std::byte> npy = capture::npy_bytes(given_by(dumped)[0], 0);
      put(port / entry.id / "out.picture.npy", {reinterpret_cast<const char*>(npy.data()), npy.size()});
    }
    const parallel::Executor executor(1);
    FolderOptions options;
    options.only = {"display"};
    options.executor = &executor;
    options.seeks_causes = false;
    options.spirv = shaders;
    return judge_folder(std::make_shared<const capture::Pack>(pack_), {port}, options).judged.notes;
  };
  EXPECT_THAT(notes(right, right), Not(Contains(StartsWith("display: "))));
  EXPECT_THAT(notes(wrong, wrong), Contains(StartsWith("display: the device did what this shader says")));
  EXPECT_THAT(notes(right, wrong), Contains("display: passes, but not by what this SPIR-V says: is it the one that ran?"));
  EXPECT_THAT(notes(wrong, right), Contains(HasSubstr("the shader is right")));
  EXPECT_THAT(notes(right, "bindings.json"), Contains(HasSubstr("display: 'mine.spv': expected SPIR-V")));
}

// Every pass of right ports, lists and images that are judged by bits among them: nothing is said of any.
TEST_F(ShaderAnswers, NothingIsSaidOfRightPorts) {
  for (const auto& [name, effect] :
       {std::pair{"puddle-corrected", "puddle"}, {"windshield-as-published", "windshield"}, {"edge_splash-corrected", "edge_splash"}}) {
    const TemporaryFolder folder;
    const fs::path shaders = fs::path(RAINREF_SPIRV) / effect;
    const auto programs = spirv::read_programs(shaders);
    const auto pack = std::make_shared<const capture::Pack>(test::pack_folder(name));
    for (const capture::PackCase& entry : pack->cases) {
      const PassCase c = pack->read(entry);
      const spirv::Program& p = programs.at(pack->pass(entry.pass).formula);
      const std::vector<Array> given = spirv::execute(c, p, spirv::read_spirv(p), "'a.spv'");
      fs::create_directories(folder / entry.id);
      for (std::size_t o = 0; o < given.size(); ++o) {
        const std::vector<std::byte> npy = capture::npy_bytes(given[o], 0);
        put(folder.path() / entry.id / ("out." + p.outputs[o] + ".npy"), {reinterpret_cast<const char*>(npy.data()), npy.size()});
      }
    }
    const parallel::Executor executor(1);
    FolderOptions options;
    options.executor = &executor;
    options.seeks_causes = false;
    options.spirv = shaders;
    const Judged judged = judge_folder(pack, {folder.path()}, options);
    EXPECT_EQ(judged.judged.status, judge::Status::pass) << name;
    for (const judge::PassJudgement& pass : judged.judged.passes)
      EXPECT_THAT(judged.judged.notes, Not(Contains(StartsWith(pass.pass + ": ")))) << name;
  }
}

}  // namespace
}  // namespace rainref::judging
