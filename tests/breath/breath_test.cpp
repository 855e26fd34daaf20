// A sixth effect of two passes gets everything that the five have from its room alone: nothing outside names it.
#include "cli/support.h"
#include "math/simd_target.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class SixthEffect : public testing::Test {
 protected:
  SixthEffect() {
    put(folder / "breath.toml", "effect = 'breath'\nvariant = 'corrected'\n[run]\nframes = 4\nsize = [37, 23]\n");
    put(folder / "published.toml", "effect = 'breath'\nvariant = 'as-published'\n[run]\nframes = 4\nsize = [37, 23]\n");
  }
  Outcome rainref(const std::vector<std::string>& arguments) const {
    Circumstances c;
    c.program = RAINREF_BREATH_PROGRAM;
    return run_rainref(folder.path(), arguments, c);
  }
  std::string said(const std::vector<std::string>& arguments, int code = 0) const {
    const Outcome o = rainref(arguments);
    EXPECT_EQ(o.code, code) << o.err;
    return o.out;
  }
  TemporaryFolder folder;
};

TEST_F(SixthEffect, IsListedAndDescribed) {
  EXPECT_THAT(said({"list"}), HasSubstr("breath         corrected     condense veil\n"));
  EXPECT_THAT(said({"describe", "breath"}),
              AllOf(HasSubstr("breath.rate"), HasSubstr("um/s"),
                    HasSubstr("condense\n    Breath that settles on the pane and dries.\n    reads film; writes "
                              "film; judged by envelope")));
  EXPECT_THAT(said({"describe", "breath", "--json"}), HasSubstr("\"breath.veil.corrected/1\""));
  for (const char* language : {"c", "glsl", "hlsl", "wgsl"})
    EXPECT_THAT(said({"describe", "breath", "--layout", language}), AllOf(HasSubstr("CondenseUniforms"), HasSubstr("VeilUniforms")))
        << language;
}

TEST_F(SixthEffect, RunsWithTheSameBitsEverywhere) {
  const std::string expected = said({"hash", "breath.toml", "--threads", "1"});
  EXPECT_EQ(lines_of(expected).size(), 4u * 2 + 1);
  EXPECT_NE(expected, said({"hash", "published.toml"}));
  for (const char* threads : {"2", "3", "8"}) EXPECT_EQ(said({"hash", "breath.toml", "--threads", threads}), expected);
  for (const std::string& target : simd_targets()) EXPECT_EQ(said({"hash", "breath.toml", "--simd", target}), expected) << target;
  said({"run", "breath.toml", "-o", "out", "--image", "both", "--capture", "all"});
  for (const char* file : {"out/summary.json", "out/breath.0003.png", "out/breath.0003.exr", "out/capture/manifest.json"})
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
}

TEST_F(SixthEffect, JudgesPortsOfIt) {
  for (const char* scene : {"breath.toml", "published.toml"}) {
    SCOPED_TRACE(scene);
    std::filesystem::remove_all(folder / "pack");
    std::filesystem::remove_all(folder / "port");
    said({"pack", scene, "--at", "2,3", "-o", "pack"});
    std::filesystem::copy(folder / "pack", folder / "port", std::filesystem::copy_options::recursive);
    EXPECT_THAT(said({"validate", "pack", "--port", "port"}), AllOf(HasSubstr("condense"), HasSubstr("veil"), Not(HasSubstr("FAIL"))));
    said({"validate", "--shadow", "port"});
    EXPECT_THAT(said({"mutate", "pack", "--all"}), AllOf(HasSubstr("condense"), HasSubstr("veil")));
    // A port that forgot the frame before.
    put(folder / "port/breath.condense/0003.0/out.film.npy", contents(folder / "port/breath.condense/0002.0/out.film.npy"));
    EXPECT_THAT(said({"validate", "pack", "--port", "port"}, 1), AllOf(HasSubstr("FAIL"), HasSubstr("condense")));
  }
}

// The film flipped: the diagnosis is generic.
TEST_F(SixthEffect, MistakesAreNamed) {
  said({"pack", "breath.toml", "--at", "3", "-o", "pack"});
  std::filesystem::copy(folder / "pack", folder / "port", std::filesystem::copy_options::recursive);
  std::string film = contents(folder / "port/breath.condense/0003.0/out.film.npy");
  const std::size_t row = 37 * sizeof(float), start = film.size() - 23 * row;
  std::string flipped = film.substr(0, start);
  for (int y = 22; y >= 0; --y) flipped += film.substr(start + static_cast<std::size_t>(y) * row, row);
  put(folder / "port/breath.condense/0003.0/out.film.npy", flipped);
  EXPECT_THAT(said({"validate", "pack", "--port", "port"}, 1), AllOf(HasSubstr("FAIL"), HasSubstr("upside down")));
}

}  // namespace
}  // namespace rainref::cli
