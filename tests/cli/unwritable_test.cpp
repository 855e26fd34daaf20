// Places that take no result. The tests may run as root, so no permission is taken away; a path below a file, a full
// device and a limit of the file size serve.
#include "cli/support.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class Unwritable : public CommandLine {
 protected:
  static bool has_full_device() { return std::filesystem::is_character_file("/dev/full"); }
  void expect_full(const std::vector<std::string>& arguments) const {
    SCOPED_TRACE(fmt::format("rainref {}", fmt::join(arguments, " ")));
    Circumstances c;
    c.standard_output = "/dev/full";
    const Outcome o = rainref(arguments, c);
    EXPECT_EQ(o.code, 4);
    EXPECT_THAT(o.err, StartsWith("rainref: standard output cannot be written"));
    EXPECT_EQ(o.err.find('\n'), o.err.size() - 1) << o.err;
  }
};

TEST_F(Unwritable, AFolderBelowAFile) {
  expect_refusal({"run", "corrected.toml", "-o", "sky.png/sub"}, 4,
                 AllOf(StartsWith("sky.png/sub: "), HasSubstr("cannot make this folder")));
  expect_refusal({"run", "corrected.toml", "-o", "sky.png"}, 4, AllOf(StartsWith("sky.png: "), HasSubstr("cannot make this folder")));
}

TEST_F(Unwritable, APictureWhoseNameIsAFolder) {
  std::filesystem::create_directories(folder / "o/puddle.0001.png");
  before = folder.names();
  expect_refusal({"run", "corrected.toml", "-o", "o"}, 4, "cannot write 'o/puddle.0001.png': Is a directory");
  EXPECT_TRUE(std::filesystem::is_empty(folder / "o/puddle.0001.png"));
}

TEST_F(Unwritable, StandardOutputIsFull) {
  if (!has_full_device()) GTEST_SKIP() << "no /dev/full";
  expect_full({"list"});
  expect_full({"list", "--json"});
  expect_full({"describe", "puddle", "--layout", "c"});
  expect_full({"--help"});
  expect_full({"hash", "corrected.toml"});
  expect_full({"hash", "corrected.toml", "--frames", "20", "--size", "4x4"});  // more lines than standard output holds back
  expect_full({"run", "corrected.toml", "-o", "o", "--json"});
}

TEST_F(Unwritable, TheDiskIsFull) {
  Circumstances c;
  c.file_bytes = 200;  // less than any of the files
  for (const std::string kind : {"png", "exr"}) {
    expect_refusal({"run", "corrected.toml", "-o", "new/deep", "--image", kind}, 4,
                   AllOf(StartsWith("cannot write 'new/deep/puddle.0001." + kind + "': "), HasSubstr("File too large")), c);
  }
  expect_refusal({"run", "corrected.toml", "-o", "new/deep", "--image", "none"}, 4,
                 AllOf(StartsWith("cannot write 'new/deep/summary.json': "), HasSubstr("File too large")), c);
}

// But not the summary of an older run: pictures of this one could have come beside it.
TEST_F(Unwritable, AFullDiskKeepsWhatIsWhole) {
  std::filesystem::create_directory(folder / "o");
  put(folder / "o/puddle.0001.png", "old");
  put(folder / "o/summary.json", "old");
  put(folder / "o/mine.txt", "mine");
  before = folder.names();
  Circumstances c;
  c.file_bytes = 200;
  expect_refusal({"run", "corrected.toml", "-o", "o"}, 4, HasSubstr("File too large"), c);
  EXPECT_EQ(contents(folder / "o/puddle.0001.png"), "old");
  EXPECT_EQ(contents(folder / "o/mine.txt"), "mine");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "o"), {}), 2);
}

}  // namespace
}  // namespace rainref::cli
