// What a run is said to take against what it took: the most that lay in memory, as the kernel counted it. Both are in summary.json.

#include <nlohmann/json.hpp>

#include "cli/support.h"
#include "source_folder.h"

namespace rainref::cli {
namespace {

struct Case {
  const char* name;
  const char* scene;  ///< below scenes/
  std::vector<std::string> set;
  const char* pictures = "none";
  double untouched = 0;  ///< share of what is stated that may be zeros which nobody wrote, and so no memory
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class StatedMemory : public testing::TestWithParam<Case> {};

TEST_P(StatedMemory, IsWithinATenthOfThePeak) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer's own memory is several times the program's";
#endif
  const Case& c = GetParam();
  const TemporaryFolder folder;
  // Tiny surroundings: the street would take longer than the rest.
  put(folder / "sky.npy", npy("'<f4'", "(4, 8, 3)", std::string(4 * 8 * 3 * 4, '\0')));
  std::vector<std::string> command{"run",       "--no-cache", fmt::format("{}/scenes/{}", rainref::test::source_folder(), c.scene),
                                   "--threads", "2",          "--frames",
                                   "2",         "--image",    c.pictures,
                                   "-o",        "out"};
  for (const std::string& s : c.set) command.insert(command.end(), {"--set", s});
  const Outcome o = run_rainref(folder.path(), command);
  ASSERT_EQ(o.code, 0) << o.err;
  const auto memory = nlohmann::json::parse(contents(folder / "out/summary.json")).at("memory");
  const double stated = memory.at("stated").get<double>(), taken = memory.at("taken").get<double>();
  EXPECT_GT(taken, 24.0 * (1 << 20)) << "the program itself takes half of that";
  EXPECT_LE(taken / stated, 1.1) << fmt::format("stated {:.1f} MiB, taken {:.1f} MiB", stated / (1 << 20), taken / (1 << 20));
  EXPECT_LE((1 - c.untouched) * stated / taken, 1.1)
      << fmt::format("stated {:.1f} MiB, taken {:.1f} MiB", stated / (1 << 20), taken / (1 << 20));
}

const std::string sky = "environment.image=sky.npy", ground = "puddle.ground_image=sky.npy";
INSTANTIATE_TEST_SUITE_P(
    Scenes, StatedMemory,
    testing::Values(
        Case{"puddle_water", "puddle/default.toml", {sky, ground, "puddle.grid=[2048, 2048]", "run.size=[64, 64]"}},
        Case{"puddle_picture", "puddle/default.toml", {sky, ground, "puddle.grid=[64, 64]", "run.size=[1280, 1280]"}},
        Case{"puddle_exr", "puddle/default.toml", {sky, ground, "puddle.grid=[64, 64]", "run.size=[640, 640]", "run.supersample=1"}, "exr"},
        Case{"puddle_street", "puddle/default.toml", {"run.size=[640, 360]"}},
        Case{"puddle_as_published", "puddle/as_published.toml", {sky, ground, "run.size=[1280, 1280]"}},
        Case{"edge_splash", "edge_splash/default.toml", {"run.size=[704, 704]"}, "none", 0.2},
        Case{"edge_splash_png", "edge_splash/default.toml", {"run.size=[704, 704]"}, "png", 0.2},
        Case{"edge_splash_as_published", "edge_splash/as_published.toml", {"run.size=[640, 640]"}, "none", 0.1},
        Case{"edge_splash_street", "edge_splash/street.toml", {"run.size=[512, 512]"}},
        Case{"screen_drops", "screen_drops/default.toml", {"run.size=[512, 512]"}},
        Case{"screen_drops_cells", "screen_drops/default.toml", {"run.size=[256, 256]", "drops.largest_radius=0.2"}},
        Case{"screen_drops_as_published", "screen_drops/as_published.toml", {"run.size=[576, 576]"}},
        Case{"rainy_glass", "rainy_glass/default.toml", {"run.size=[448, 448]"}},
        Case{"rainy_glass_as_published", "rainy_glass/as_published.toml", {"run.size=[448, 448]"}},
        Case{"rainy_glass_maps", "rainy_glass/as_published.toml", {"run.size=[64, 64]", "maps.size=1024"}},
        Case{"windshield_drops", "windshield/stress.toml", {"run.size=[64, 64]", "scene.size=[64, 64]", "windshield.capacity=4000000"}},
        Case{"windshield_necks",
             "windshield/stress.toml",
             {"run.size=[64, 64]", "scene.size=[64, 64]", "windshield.capacity=4000000", "windshield.neck_time=60"}},
        Case{"windshield_drops_as_published",
             "windshield/as_published.toml",
             {"run.size=[64, 64]", "scene.size=[64, 64]", "windshield.capacity=1000000", "windshield.spawn_rate=1000000",
              "windshield.drag=1", "run.fps=2"}},
        Case{"windshield_textures",
             "windshield/default.toml",
             {"run.size=[64, 64]", "scene.size=[64, 64]", "windshield.height_size=[2048, 2048]"}},
        // Room for 100 000 drops is 4 of 101 MiB, and in two frames next to none have come.
        Case{"windshield_street", "windshield/default.toml", {"run.size=[640, 360]", "scene.size=[640, 480]"}, "none", 0.04},
        Case{"windshield_drive", "windshield/drive.toml", {"run.size=[640, 360]", "scene.size=[640, 360]", "run.fps=1"}}),
    [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace rainref::cli
