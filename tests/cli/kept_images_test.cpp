// run keeps what a scene begins with, and gives the same pictures with it and without.
#include <cstdlib>

#include "cli/support.h"
#include "math/simd_target.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;

class RunKeeps : public testing::Test {
 protected:
  RunKeeps() {
    if (const char* value = std::getenv("XDG_CACHE_HOME")) before = value;
    ::setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
  }
  ~RunKeeps() override { ::setenv("XDG_CACHE_HOME", before.c_str(), 1); }
  std::size_t kept() const {
    std::size_t count = 0;
    if (fs::exists(folder / "cache" / "rainref"))
      for (const auto& entry : fs::directory_iterator(folder / "cache" / "rainref")) count += entry.is_regular_file();
    return count;
  }
  // The picture's bytes.
  std::string run(const std::string& effect, const std::vector<std::string>& more = {}) {
    std::ofstream(folder / "scene.toml") << "effect = '" << effect
                                         << "'\nvariant = 'corrected'\nseed = 5\n[run]\nframes = 2\nsize = [64, 36]\n";
    expect(run_rainref(folder.path(), joined({"run", "scene.toml", "-o", effect}, more)), 0);
    std::ifstream in(folder / effect / (effect + ".0001.png"), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  TemporaryFolder folder;
  std::string before;
};

TEST_F(RunKeeps, TheSamePicturesWithKeptImagesAndWithout) {
  for (const std::string effect : {"edge_splash", "screen_drops"}) {
    fs::remove_all(folder / "cache");
    const std::string without = run(effect, {"--no-cache"});
    EXPECT_EQ(kept(), 0u) << effect;
    const std::string first = run(effect);
    EXPECT_GT(kept(), 0u) << effect;
    const std::string second = run(effect, {"--simd", simd_targets().back(), "--threads", "1"});
    ASSERT_FALSE(without.empty()) << effect;
    EXPECT_TRUE(without == first) << effect;
    EXPECT_TRUE(without == second) << effect;
  }
}
// What proves bits makes everything itself.
TEST_F(RunKeeps, AHashNeitherReadsNorKeeps) {
  run("edge_splash");
  fs::remove_all(folder / "cache");
  EXPECT_EQ(run_rainref(folder.path(), {"hash", "scene.toml"}).code, 0);
  EXPECT_EQ(run_rainref(folder.path(), {"pack", "scene.toml", "--at", "0", "-o", "pack"}).code, 0);
  EXPECT_EQ(kept(), 0u);
}

}  // namespace
}  // namespace rainref::cli
