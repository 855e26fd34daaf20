// What pictures say of themselves, and that it is enough to make them again.
#include "base/program_path.h"
#include "cli/support.h"
#include "image_io/notes.h"
#include "rainref/version.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

class PictureNotes : public CommandLine {
 protected:
  std::string note(const std::string& file, const std::string& key) const {
    const std::string bytes = contents(folder / file);
    return image_io::find_note(file, std::as_bytes(std::span(bytes)), "rainref:" + key).value_or("(none)");
  }
  void run(const std::vector<std::string>& arguments) const { good(rainref(joined({"run"}, arguments))); }
};

TEST_F(PictureNotes, SaySceneSeedVersionFrameVariantAndHash) {
  run({"corrected.toml", "-o", "o", "--image", "both", "--frames", "3", "--every", "2", "--set", "seed=11", "--set", "rain.rate=40"});
  const std::vector<std::string> hashes = hash({"corrected.toml", "--frames", "3", "--set", "seed=11", "--set", "rain.rate=40"});
  for (const int frame : {0, 2}) {
    for (const char* kind : {"png", "exr"}) {
      const std::string file = fmt::format("o/puddle.{:04}.{}", frame, kind);
      SCOPED_TRACE(file);
      EXPECT_EQ(note(file, "version"), version());
      EXPECT_EQ(note(file, "golden_generation"), std::to_string(golden_generation));
      EXPECT_EQ(note(file, "effect"), "puddle");
      EXPECT_EQ(note(file, "variant"), "corrected");
      EXPECT_EQ(note(file, "seed"), "11");
      EXPECT_EQ(note(file, "frame"), std::to_string(frame));
      EXPECT_EQ(note(file, "scene"), fmt::format("effect = \"puddle\"\nvariant = \"corrected\"\nseed = 11\nrun.frames = {}\n"
                                                 "run.size = [24, 16]\npuddle.grid = [40, 30]\npuddle.cell_size = 0.02\n"
                                                 "puddle.ground_image = \"sky.npy\"\nrain.rate = 40.0\nenvironment.image = \"sky.npy\"\n",
                                                 frame + 1));
      EXPECT_EQ(note(file, "scene_hash"), note("o/puddle.0000.png", "scene_hash"));
      // What `rainref hash` prints of this frame's display.
      EXPECT_THAT(hashes, Contains(AllOf(testing::StartsWith(fmt::format("{} display ", frame)), EndsWith(note(file, "picture_hash")))));
      // No folder of this machine.
      EXPECT_THAT(contents(folder / file),
                  AllOf(Not(HasSubstr(folder.path().string())), Not(HasSubstr(folder.path().filename().string()))));
    }
  }
  EXPECT_NE(note("o/puddle.0000.png", "picture_hash"), note("o/puddle.0002.png", "picture_hash"));
}

TEST_F(PictureNotes, TheScenesHashIsOfWhatItsFilesHoldAndNotOfTheirNames) {
  fs::create_directory(folder / "deep");
  fs::copy_file(folder / "sky.png", folder / "deep/other.png");
  run({"corrected.toml", "-o", "a"});
  run({"corrected.toml", "-o", "b", "--set", "environment.image=" + (folder / "deep/other.png").string()});
  EXPECT_EQ(note("a/puddle.0001.png", "scene_hash"), note("b/puddle.0001.png", "scene_hash"));
  EXPECT_THAT(note("b/puddle.0001.png", "scene"), HasSubstr("environment.image = \"other.png\"\n"));
  run({"corrected.toml", "-o", "c", "--set", "rain.rate=41"});
  EXPECT_NE(note("a/puddle.0001.png", "scene_hash"), note("c/puddle.0001.png", "scene_hash"));
  std::vector<std::string> rows(4, std::string(24, 'x'));
  put(folder / "deep/other.png", image_io::png(8, 4, 8, 2, rows));
  run({"corrected.toml", "-o", "d", "--set", "environment.image=deep/other.png"});
  EXPECT_NE(note("a/puddle.0001.png", "scene_hash"), note("d/puddle.0001.png", "scene_hash"));
}

// A frame's file is the same however long the run goes on, from a scene of another name, and with what was the default anyway.
TEST_F(PictureNotes, EqualPicturesOfEqualScenesAreEqualFiles) {
  run({"corrected.toml", "-o", "a", "--frames", "5", "--every", "1", "--image", "both"});
  put(folder / "renamed.toml", contents(folder / "corrected.toml"));
  run({"renamed.toml", "-o", "b", "--frames", "3", "--set", "run.fps=60.0", "--image", "both"});
  for (const char* kind : {"png", "exr"}) {
    const std::string name = fmt::format("puddle.0002.{}", kind);
    EXPECT_FALSE(contents(folder / ("b/" + name)).empty());
    EXPECT_TRUE(contents(folder / ("a/" + name)) == contents(folder / ("b/" + name))) << kind;
  }
}

TEST_F(PictureNotes, APictureIsASceneThatMakesItAgain) {
  put(folder / "traced.toml", contents(folder / "corrected.toml") + "[compositor]\npicture = 'traced'\nsamples = 1\n");
  for (const std::string scene : {"corrected", "published", "traced"}) {
    SCOPED_TRACE(scene);
    // Every value that --set takes: texts, pairs, triples, numbers.
    run({scene + ".toml", "-o", scene, "--image", "both", "--frames", "4", "--set", "seed=3", "--set",
         "camera.position=[0.25, 0.5, 1.75]"});
    fs::copy_file(folder / "sky.npy", folder / (scene + "/sky.npy"));  // what a scene names lies beside it
    for (const char* kind : {"png", "exr"}) {
      const std::string picture = fmt::format("{}/puddle.0003.{}", scene, kind), again = fmt::format("{}_{}", scene, kind);
      run({picture, "-o", again, "--image", kind});
      EXPECT_FALSE(contents(folder / picture).empty());
      EXPECT_TRUE(contents(folder / fmt::format("{}/puddle.0003.{}", again, kind)) == contents(folder / picture)) << kind;
    }
    EXPECT_EQ(hash({scene + "/puddle.0003.png"}),
              hash({scene + ".toml", "--frames", "4", "--set", "seed=3", "--set", "camera.position=[0.25, 0.5, 1.75]"}));
  }
  // With changes, as of any scene.
  run({"corrected/puddle.0003.png", "-o", "changed", "--frames", "2", "--set", "seed=4"});
  EXPECT_EQ(note("changed/puddle.0001.png", "seed"), "4");
}

// They read the picture's bytes as TOML.
TEST_F(PictureNotes, APictureIsPackedAndSweptAsAnyScene) {
  run({"corrected.toml", "-o", "o", "--image", "both", "--frames", "4"});
  fs::copy_file(folder / "sky.npy", folder / "o/sky.npy");
  for (const std::string picture : {"o/puddle.0003.png", "o/puddle.0003.exr"}) {
    SCOPED_TRACE(picture);
    const Outcome packed = run_rainref(folder.path(), {"pack", picture, "-o", "pack", "--passes", "display", "--at", "3"});
    ASSERT_EQ(packed.code, 0) << packed.err;
    fs::remove_all(folder / "pack");
    put(folder / "plan.toml", "verb = \"hash\"\nscene = \"" + picture + "\"\n[axes]\nseed = [1, 2]\n");
    const Outcome planned = run_rainref(folder.path(), {"sweep", "plan", "plan.toml"});
    EXPECT_EQ(planned.code, 0) << planned.err;
  }
}

TEST_F(PictureNotes, OtherPicturesAreNoScenes) {
  expect_refusal({"run", "sky.png", "-o", "o"}, 2,
                 "'sky.png': expected a scene, or a picture with the scene in it as rainref writes them; found a picture without");
  run({"corrected.toml", "-o", "o"});
  std::string bytes = contents(folder / "o/puddle.0001.png");
  const std::size_t rate = bytes.find("cell_size = 0.02");
  ASSERT_NE(rate, std::string::npos);
  bytes[rate + 15] = '3';
  put(folder / "damaged.png", bytes);
  before = folder.names();
  expect_refusal({"run", "damaged.png", "-o", "new"}, 2, "'damaged.png': damaged: the checksum of its text 'rainref:scene' is wrong");
}

// It would be opened with the rights of whoever looks at a stranger's picture, and its first line stand in the message.
TEST_F(PictureNotes, ANoteThatNamesAFileWithAFolderIsRefused) {
  const auto put_note = [&](const std::string& line) {
    const std::string scene = "effect = \"windshield\"\nvariant = \"corrected\"\nrun.frames = 1\n" + line + "\n";
    const std::string generation = std::string("rainref:golden_generation\0", 26) + std::to_string(golden_generation);
    put(folder / "s.png",
        image_io::png(1, 1, 8, 2, {"abc"},
                      image_io::png_chunk("tEXt", generation) + image_io::png_chunk("tEXt", std::string("rainref:scene\0", 14) + scene)));
    before = folder.names();
  };
  std::filesystem::create_directory(folder / "sub");
  for (const char* file : {"secret.csv", "sub/secret.csv"}) put(folder / file, "a line that nobody else may read\n");
  for (const char* key : {"vehicle.drive_cycle", "scene.image", "scene.depth_image", "no.such.key"}) {
    for (const std::string& name :
         {std::string("/etc/hostname"), std::string("../secret.csv"), std::string("sub/secret.csv"), (folder / "secret.csv").string()}) {
      put_note(fmt::format("{} = \"{}\"", key, name));
      const auto refused = AllOf(
          HasSubstr(fmt::format("s.png': {}: expected the name of a file beside the picture, as rainref writes it there, found", key)),
          Not(HasSubstr("nobody else")));
      expect_refusal({"hash", "s.png"}, 2, refused);
      expect_refusal({"run", "s.png", "-o", "new"}, 2, refused);
      expect_refusal({"pack", "s.png", "-o", "new", "--passes", "display", "--at", "0"}, 2, refused);
    }
  }
  put_note("scene.image = \"/etc/hostname\"");
  put(folder / "plan.toml", "verb = \"hash\"\nscene = \"s.png\"\n[axes]\nseed = [1, 2]\n");
  before = folder.names();
  expect_refusal({"sweep", "plan", "plan.toml"}, 2, HasSubstr("scene.image: expected the name of a file beside the picture"));
  // Who asks for a file himself gets it.
  put_note("vehicle.drive_cycle = \"secret.csv\"");
  expect_refusal({"hash", "s.png", "--set", "vehicle.drive_cycle=sub/secret.csv"}, 2, HasSubstr("sub/secret.csv"));
}

TEST_F(PictureNotes, AnotherGenerationIsSaid) {
  std::string scene("rainref:scene\0", 14);
  scene += contents(folder / "corrected.toml");
  put(folder / "old.png",
      image_io::png(1, 1, 8, 2, {"abc"},
                    image_io::png_chunk("tEXt", std::string("rainref:golden_generation\0001", 27)) + image_io::png_chunk("tEXt", scene)));
  const Outcome o = rainref({"run", "old.png", "-o", "o"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err,
            fmt::format("rainref: warning: 'old.png' is of golden generation 1, and this is {}: expect other bits\n", golden_generation));
}

// As other programs read them.
TEST_F(PictureNotes, OpenImageIOsToolPrintsThem) {
  if (program_in_path("oiiotool").empty()) GTEST_SKIP() << "oiiotool is not installed";
  run({"corrected.toml", "-o", "o", "--image", "both"});
  for (const char* kind : {"png", "exr"}) {
    EXPECT_THAT(output(fmt::format("oiiotool --info -v o/puddle.0001.{}", kind)),
                AllOf(HasSubstr("rainref:seed: \""), HasSubstr("rainref:frame: \"1\""), HasSubstr("rainref:variant: \"corrected\""),
                      HasSubstr("rainref:picture_hash: \"" + note("o/puddle.0001.png", "picture_hash") + "\"")))
        << kind;
  }
}

}  // namespace
}  // namespace rainref::cli
