// Files: how they are read, and what no file may do.
#include "base/temporary_folder.h"
#include "scene/example_effect.h"
#include "scene/toml.h"

namespace rainref::scene {
namespace {

using testing::StartsWith;

const std::string head = "effect = \"puddle\"\nvariant = \"corrected\"\n";

// The error of the head above followed by `rest`, whose first line is line 3.
std::string error_in(const std::string& rest) {
  return error_of([&] { parse(head + rest, "x.toml", {}, example_effects()); });
}

TEST(HostileScene, LongValuesAreCutInMessages) {
  const std::string message = error_in("run.frames = '" + std::string(5000, 'x') + "'");
  EXPECT_EQ(message, "2 x.toml:3:14: run.frames: expected an integer from 1 to 1000000 [frame], found \"" + std::string(59, 'x') + "…");
  std::string umlauts;
  for (int i = 0; i < 500; ++i) umlauts += "ä";
  EXPECT_THAT(error_in("run.frames = '" + umlauts + "'"), testing::EndsWith("ä…"));
  std::string numbers = "[0";
  for (int i = 0; i < 5000; ++i) numbers += ",\n7";
  EXPECT_LT(error_in("run.frames = " + numbers + "]").size(), 200u);
}

TEST(HostileScene, LongKeysAreCutInMessages) {
  EXPECT_EQ(error_in(std::string(100000, 'x') + " = 1"), "2 x.toml:3:1: " + std::string(128, 'x') + "…: unknown key");
}

TEST(HostileScene, DeepNestingIsAnErrorNotACrash) {
  std::string dotted;
  for (int i = 0; i < 400000; ++i) dotted += "a.";
  EXPECT_EQ(error_in(dotted + "a = 1"), "2 x.toml:3: more than 32 dots in one line; no scene nests keys so deeply");
  EXPECT_EQ(error_in("[" + dotted + "a]"), "2 x.toml:3: more than 32 dots in one line; no scene nests keys so deeply");
  EXPECT_THAT(error_in("seed = " + std::string(1000000, '[')), StartsWith("2 x.toml:3:"));
  // As deep as both bounds allow, which the library must build and destroy.
  std::string both;
  for (int i = 0; i < 250; ++i) both += "[{a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a=\n";
  EXPECT_THAT(error_in("seed = " + both), StartsWith("2 x.toml:"));
}

TEST(HostileScene, DeepKeysWithinTheBoundAreUnknown) {
  EXPECT_EQ(error_in("a.b.c.d.e.f.g.h.i.j.k = 1"), "2 x.toml:3:15: a.b.c.d.e.f.g.h: unknown table");
}

TEST(HostileScene, DotsInACommentAreNotCounted) { EXPECT_EQ(error_in("  # " + std::string(500, '.') + "\nseed = 1"), "none"); }

TEST(HostileScene, AHugeFileIsRefused) {
  EXPECT_EQ(error_in(std::string(2000000, '\n')), "2 x.toml: larger than 1048576 bytes, so not a scene");
  EXPECT_EQ(error_in(std::string(1000000, '\n')), "none");
}

class SceneFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const {
    put(folder / "x.toml", text);
    return folder / "x.toml";
  }
  TemporaryFolder folder;
};

TEST_F(SceneFile, IsReadWithItsFolderAndItsPlaces) {
  const std::filesystem::path file = write("\xef\xbb\xbf" + head + "[puddle]\r\ndamping = 0.96\r\n");
  const Config c = load(file, {"run.frames=2"}, example_effects());
  EXPECT_EQ(c.real("puddle.damping"), 0.96);
  EXPECT_EQ(c.integer("run.frames"), 2);
  EXPECT_EQ(c.directory(), folder.path());
  EXPECT_EQ(c.entry("puddle.damping").origin.text(), file.string() + ":4:1");
}

TEST_F(SceneFile, ThatCannotBeReadIsAnInputError) {
  const std::string missing = (folder / "none.toml").string();
  EXPECT_EQ(error_of([&] { load(missing, {}, example_effects()); }), "4 " + missing + ": cannot be read: No such file or directory");
  const std::string inside = (write(head) / "y.toml").string();
  EXPECT_EQ(error_of([&] { load(inside, {}, example_effects()); }), "4 " + inside + ": cannot be read: Not a directory");
  EXPECT_EQ(error_of([&] { load(folder.path(), {}, example_effects()); }),
            "4 " + folder.path().string() + ": expected a scene file, found a directory");
}

TEST_F(SceneFile, LargerThanAnySceneIsRefused) {
  const std::filesystem::path file = write(std::string(3000000, 'x'));
  EXPECT_EQ(error_of([&] { load(file, {}, example_effects()); }), "2 " + file.string() + ": larger than 1048576 bytes, so not a scene");
}

}  // namespace
}  // namespace rainref::scene
