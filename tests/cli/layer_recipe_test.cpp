// The recipes of docs/notes/layers.md, run as they are printed there.
#include <cstdlib>
#include <sstream>

#include "base/program_path.h"
#include "cli/picture_files.h"
#include "image_io/read.h"
#include "math/half.h"
#include "source_folder.h"

namespace rainref::cli {
namespace {

/// The lines of the document that begin so, outside of its prose.
std::vector<std::string> printed_lines(const std::string& document, const std::string& program) {
  std::vector<std::string> found;
  bool is_code = false;
  std::istringstream lines(contents(test::source_folder() + "/" + document));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```"))
      is_code = !is_code;
    else if (is_code && line.starts_with(program + " "))
      found.push_back(line);
  }
  return found;
}

class LayerRecipe : public SceneFiles {};

TEST_F(LayerRecipe, TheDropsOverTheirBackgroundAreThePicture) {
  if (program_in_path("oiiotool").empty()) GTEST_SKIP() << "oiiotool is not installed";
  const std::vector<std::string> recipe = printed_lines("docs/notes/layers.md", "oiiotool");
  ASSERT_EQ(recipe.size(), 2u);
  const std::string &lay_over = recipe[0], &take_background = recipe[1];
  // Lamps of 30 between black, so that a rim that held some of them would show.
  put_npy(folder / "lamps.npy", 96, 64, 3, [](int x, int y, int) { return x / 6 % 2 == 0 && y / 6 % 2 == 0 ? 30.0f : 0.02f; });
  for (const std::string& scene :
       {std::string("effect = 'screen_drops'\n[drops]\nlargest_radius = 6\n"),
        std::string("effect = 'windshield'\n[blur]\nfog_density = 0\n[rain]\nrate = 200\n[windshield]\nheight_size = [96, 64]\n")}) {
    SCOPED_TRACE(scene);
    const std::string effect = scene.substr(10, scene.find('\n') - 11);
    put(folder / "layer.toml",
        "variant = 'corrected'\nrun.frames = 20\nrun.size = [96, 64]\nscene.image = 'lamps.npy'\npicture.layer = true\n" + scene);
    const Outcome o = rainref({"run", "layer.toml", "-o", effect, "--image", "exr"});
    ASSERT_EQ(o.code, 0) << o.err;
    std::filesystem::copy_file(folder / fmt::format("{0}/{0}.0019.exr", effect), folder / "frame.exr",
                               std::filesystem::copy_options::overwrite_existing);
    const auto run = [&](const std::string& line) {
      return std::system(fmt::format("cd '{}' && {} >/dev/null", folder.path().string(), line).c_str());
    };
    ASSERT_EQ(run(take_background), 0);
    ASSERT_EQ(run(lay_over), 0);
    const Image seen = image_io::read(folder / "frame.exr").image, over = image_io::read(folder / "over.exr").image,
                drops = image_io::read(folder / "frame.exr", "drops").image;
    ASSERT_EQ(over.format(), Format::rgba16f);
    int rims = 0;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 96; ++x) {
        const float cover = to_float(drops.row<Half>(y)[4 * x + 3]);
        rims += cover > 0.02f && cover < 0.98f;
        for (int i = 4 * x; i < 4 * x + 3; ++i) {
          const double wanted = to_float(seen.row<Half>(y)[i]), drop = std::abs(to_float(drops.row<Half>(y)[i]));
          // Half a last place of the drops, and half a one of the sum, which oiiotool stores as a half.
          EXPECT_NEAR(to_float(over.row<Half>(y)[i]), wanted, 0x1.01p-11 * (drop + std::abs(wanted)) + 0x1p-24) << x << " " << y;
        }
      }
    }
    EXPECT_GT(rims, 20);
  }
}

}  // namespace
}  // namespace rainref::cli
