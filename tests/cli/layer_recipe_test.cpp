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

/// The code of the document in blocks of a language, line by line.
std::vector<std::string> printed_code(const std::string& language) {
  std::vector<std::string> found;
  std::string block;  // the language of the block that the line is in; "" in prose
  bool is_code = false;
  std::istringstream lines(contents(test::source_folder() + "/docs/notes/layers.md"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      is_code = !is_code;
      block = line.substr(3);
    } else if (is_code && block == language) {
      found.push_back(line);
    }
  }
  return found;
}

float value(const Image& image, int y, int i) {
  return image.format() == Format::rgba16f ? to_float(image.row<Half>(y)[i]) : image.row<float>(y)[i];
}

class LayerRecipe : public SceneFiles {
 protected:
  int run(const std::string& line) const {
    return std::system(fmt::format("cd '{}' && {} >/dev/null", folder.path().string(), line).c_str());
  }
  /// Lays the drops of frame.exr over its own background with the commands of `recipe`, and compares over.exr, of format `stored`, with the
  /// picture.
  void expect_the_picture_of(const std::vector<std::string>& recipe, Format stored) const {
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
      for (const std::string& line : recipe) ASSERT_EQ(run(line), 0) << line;
      const Image seen = image_io::read(folder / "frame.exr").image, over = image_io::read(folder / "over.exr").image,
                  drops = image_io::read(folder / "frame.exr", "drops").image;
      ASSERT_EQ(over.format(), stored);
      ASSERT_EQ(over.width(), 96);
      ASSERT_EQ(over.height(), 64);
      int rims = 0;
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 96; ++x) {
          const float cover = value(drops, y, 4 * x + 3);
          rims += cover > 0.02f && cover < 0.98f;
          for (int i = 4 * x; i < 4 * x + 3; ++i) {
            const double wanted = value(seen, y, i), drop = std::abs(value(drops, y, i));
            // Half a last place of the drops, and half a one of the picture, which is a half.
            EXPECT_NEAR(value(over, y, i), wanted, 0x1.01p-11 * (drop + std::abs(wanted)) + 0x1p-24) << x << " " << y;
          }
        }
      }
      EXPECT_GT(rims, 20);
    }
  }
};

TEST_F(LayerRecipe, TheDropsOverTheirBackgroundAreThePicture) {
  if (program_in_path("oiiotool").empty()) GTEST_SKIP() << "oiiotool is not installed";
  std::vector<std::string> recipe = printed_code("sh");
  std::erase_if(recipe, [](const std::string& line) { return !line.starts_with("oiiotool "); });
  ASSERT_EQ(recipe.size(), 2u);
  expect_the_picture_of({recipe[1], recipe[0]}, Format::rgba16f);  // the second makes the plate of the first
}

TEST_F(LayerRecipe, InBlenderToo) {
  for (const char* program : {"oiiotool", "blender"})
    if (program_in_path(program).empty()) GTEST_SKIP() << program << " is not installed";
  std::string script;
  for (const std::string& line : printed_code("python")) script += line + "\n";
  ASSERT_FALSE(script.empty());
  put(folder / "over.py", script);
  expect_the_picture_of({printed_code("sh").back(), "blender --background --python-exit-code 1 --python over.py"}, Format::rgba32f);
}

}  // namespace
}  // namespace rainref::cli
