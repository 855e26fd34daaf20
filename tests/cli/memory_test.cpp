// What a run is said to take against what it takes: the most that its process held, as the kernel counted it.
#include "base/memory.h"
#include "cli/registry.h"
#include "cli/run_memory.h"
#include "cli/support.h"
#include "scene/toml.h"

namespace rainref::cli {
namespace {

struct Case {
  const char* name;
  const char* scene;  ///< below scenes/
  std::vector<std::string> set;
  const char* pictures = "none";
};

class StatedMemory : public testing::TestWithParam<Case> {};

// The program itself, its libraries and the pools of its threads take something besides: what a scene of a few texels takes, which states less than a MiB.
std::size_t program_bytes(const TemporaryFolder& folder, const std::string& pictures) {
  const std::string scene = std::string(RAINREF_SOURCE_DIR) + "/scenes/edge_splash/default.toml";
  std::vector<std::string> command{"run", scene, "--threads", "2", "--frames", "1", "--size", "16x16", "--image", pictures, "-o", (folder / "tiny").string()};
  return static_cast<std::size_t>(run_rainref(folder.path(), command).peak_kib) << 10;
}

TEST_P(StatedMemory, IsWithinATenthOfThePeak) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer's own memory is several times the program's";
#endif
  const Case& c = GetParam();
  const TemporaryFolder folder;
  const std::filesystem::path scene = std::filesystem::path(RAINREF_SOURCE_DIR) / "scenes" / c.scene;
  std::vector<std::string> overrides = c.set;
  overrides.push_back("run.frames=2");
  const scene::Config config = scene::load(scene, overrides, effect_table());
  RunMemory stated = effect(config.effect()).memory(config);
  const std::string pictures = c.pictures;
  add_pictures(stated, pictures == "png", pictures == "exr");

  std::vector<std::string> command{"run", scene.string(), "--threads", "2", "--image", pictures, "-o", (folder / "out").string()};
  for (const std::string& s : overrides) command.insert(command.end(), {"--set", s});
  const Outcome o = run_rainref(folder.path(), command);
  ASSERT_EQ(o.code, 0) << o.err;
  const double peak = static_cast<double>(static_cast<std::size_t>(o.peak_kib) << 10), said = static_cast<double>(stated.peak.peak() + program_bytes(folder, pictures));
  RecordProperty("peak_mib", static_cast<int>(peak / (1 << 20)));
  EXPECT_GT(peak, 80.0 * (1 << 20)) << "too small to say much";
  EXPECT_NEAR(said / peak, 1, 0.1) << fmt::format("stated {:.1f} MiB, taken {:.1f} MiB", said / (1 << 20), peak / (1 << 20));
}

INSTANTIATE_TEST_SUITE_P(Scenes, StatedMemory,
                         testing::Values(Case{"puddle", "puddle/default.toml", {"puddle.grid=[2048, 2048]", "run.size=[64, 64]"}},
                                         Case{"puddle_picture", "puddle/default.toml", {"puddle.grid=[64, 64]", "run.size=[1600, 1400]"}},
                                         Case{"puddle_as_published", "puddle/as_published.toml", {"run.size=[1600, 1200]"}},
                                         Case{"edge_splash", "edge_splash/default.toml", {"run.size=[1800, 1600]"}},
                                         Case{"edge_splash_as_published", "edge_splash/as_published.toml", {"run.size=[1800, 1600]"}},
                                         Case{"puddle_exr", "puddle/default.toml", {"puddle.grid=[64, 64]", "run.size=[1200, 1000]"}, "exr"},
                                         Case{"edge_splash_png", "edge_splash/default.toml", {"run.size=[1000, 1000]"}, "png"},
                                         Case{"edge_splash_street", "edge_splash/street.toml", {"run.size=[1024, 1024]"}},
                                         Case{"screen_drops", "screen_drops/default.toml", {"run.size=[1024, 1024]"}},
                                         Case{"screen_drops_cells", "screen_drops/default.toml", {"run.size=[512, 512]", "drops.largest_radius=0.4"}},
                                         Case{"screen_drops_as_published", "screen_drops/as_published.toml", {"run.size=[1024, 1024]"}},
                                         Case{"rainy_glass", "rainy_glass/default.toml", {"run.size=[1024, 1024]"}},
                                         Case{"rainy_glass_as_published", "rainy_glass/as_published.toml", {"run.size=[1024, 1024]"}},
                                         Case{"rainy_glass_maps", "rainy_glass/as_published.toml", {"run.size=[64, 64]", "maps.size=2048"}},
                                         Case{"windshield_drops", "windshield/stress.toml", {"run.size=[64, 64]", "scene.size=[64, 64]", "windshield.capacity=4000000"}},
                                         Case{"windshield_drops_as_published", "windshield/as_published.toml",
                                              {"run.size=[64, 64]", "scene.size=[64, 64]", "windshield.capacity=2000000", "windshield.spawn_rate=1000000", "windshield.drag=1", "run.fps=2"}},
                                         Case{"windshield_textures", "windshield/default.toml", {"run.size=[64, 64]", "scene.size=[64, 64]", "windshield.height_size=[2048, 2048]"}},
                                         Case{"windshield_street", "windshield/default.toml", {"run.size=[1280, 720]", "scene.size=[1280, 720]"}},
                                         Case{"windshield_drive", "windshield/drive.toml", {"run.size=[640, 360]", "scene.size=[1024, 576]", "run.fps=1"}}),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace rainref::cli
