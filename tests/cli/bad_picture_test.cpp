// Pictures of the surroundings that cannot be used.
#include "cli/support.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class BadPicture : public CommandLine {
 protected:
  BadPicture() { image_io::codec(); }  // once, and not in every copy
  void expect_picture_refused(const std::string& file, int code, const std::string& message, const std::string& layout = "latlong") {
    before = folder.names();
    const auto matcher = [&](const std::string& place) { return AllOf(StartsWith(place + "environment.image: "), HasSubstr(message)); };
    expect_refusal({"hash", "corrected.toml", "--set", "environment.layout=" + layout, "--set", "environment.image=" + file}, code,
                   layout == "cube" ? matcher("") : matcher("--set "));
    expect_refusal(
        {"run", "published.toml", "-o", "new/deep", "--set", "environment.layout=" + layout, "--set", "environment.image=" + file}, code,
        layout == "cube" ? matcher("") : matcher("--set "));
  }
};

// tests/image_io has all that the readers say.
TEST_F(BadPicture, MissingOrNone) {
  expect_picture_refused("none.png", 4, "'none.png': No such file or directory");
  std::filesystem::create_directory(folder / "sub");
  expect_picture_refused("sub", 4, "'sub': Is a directory");
  put(folder / "text.png", "no picture");
  expect_picture_refused("text.png", 2, "'text.png': not an EXR, PNG, Radiance HDR or JPEG file");
}

TEST_F(BadPicture, OfASceneFileNamesItsPlace) {
  std::filesystem::remove(folder / "sky.npy");
  before = folder.names();
  expect_refusal({"hash", "corrected.toml"}, 4,
                 AllOf(StartsWith("corrected.toml:7:1: environment.image: "), HasSubstr("No such file or directory")));
}

// libpng would print a line of its own beside ours; the reason that it gives is in ours.
TEST_F(BadPicture, ADamagedPngIsOneLine) {
  std::string bytes = contents(folder / "sky.png");
  const std::size_t data = bytes.find("IDAT") + 4;
  bytes[data + 6] = static_cast<char>(bytes[data + 6] ^ 0x55);  // inside the compressed data
  put(folder / "damaged.png", bytes);
  expect_picture_refused("damaged.png", 2, "'damaged.png': ");
  expect_picture_refused("damaged.png", 2, "IDAT: invalid");
  std::string header = contents(folder / "sky.png");
  header[16 + 8] = 3;  // 3 bits a channel: there is no such PNG
  put(folder / "header.png", header);
  expect_picture_refused("header.png", 2, "'header.png': ");
}

TEST_F(BadPicture, ACubeOfTheWrongAspect) {
  expect_picture_refused("sky.png", 2, "a cube needs six square faces in a row or a column, found 8x4", "cube");
}

TEST_F(BadPicture, ACubeInARowEqualsOneInAColumn) {
  Image row(Format::rgba8, 12, 2), column(Format::rgba8, 2, 12);
  for (int y = 0; y < 12; ++y) {
    for (int i = 0; i < 8; ++i) {
      const auto code = static_cast<std::uint8_t>(20 * y + i);
      column.row<std::uint8_t>(y)[i] = row.row<std::uint8_t>(y % 2)[8 * (y / 2) + i] = code;
    }
  }
  image_io::write_png(folder / "row.png", row);
  image_io::write_png(folder / "column.png", column);
  const std::vector<std::string> lines = hash({"corrected.toml", "--set", "environment.layout=cube", "--set", "environment.image=row.png"});
  EXPECT_EQ(lines, hash({"corrected.toml", "--set", "environment.layout=cube", "--set", "environment.image=column.png"}));
  EXPECT_NE(lines, hash({"corrected.toml"}));
}

TEST_F(BadPicture, AGroundImageIsReadAlike) {
  expect_refusal({"hash", "corrected.toml", "--set", "puddle.ground_image=none.png"}, 4,
                 StartsWith("--set puddle.ground_image: cannot read 'none.png'"));
  EXPECT_NE(hash({"corrected.toml", "--set", "puddle.ground_image="}), hash({"corrected.toml"}));
}

}  // namespace
}  // namespace rainref::cli
