// Text in PNG and EXR files: what is written, byte by byte, and found again; no texel changes.
#include <gmock/gmock.h>

#include "image_io/notes.h"
#include "image_io/read.h"
#include "image_io/tiny_files.h"
#include "image_io/write.h"

namespace rainref::image_io {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }
std::string text_of(const std::vector<std::byte>& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
const std::string plain = png(1, 1, 8, 2, {"abc"});
/// The file of one texel with these notes.
std::string noted(const Notes& notes) { return text_of(png_bytes(Image(Format::rgba8, 1, 1), PngChannels::rgb, notes)); }

// PNG specification, third edition: 11.3.3.2 (tEXt: keyword, zero, Latin-1) and 11.3.3.4 (iTXt: keyword, zero, not compressed, method 0,
// language, translated keyword, UTF-8).
TEST(PngText, IsTheSpecificationsBytesBeforeTheTexels) {
  const std::string ascii = png_chunk("tEXt", std::string("rainref:seed\0007", 14));
  std::string content("rainref:scene\0\0\0\0\0", 18);
  content += "a = \"Straße.exr\"\n";
  const std::string other = png_chunk("iTXt", content);
  std::string without = noted({});
  without.insert(without.find("IDAT") - 4, ascii + other);
  EXPECT_EQ(noted({{"rainref:seed", "7"}, {"rainref:scene", "a = \"Straße.exr\"\n"}}), without);
}

TEST(PngText, IsFoundByItsWholeKeyword) {
  const std::string file = noted({{"scene_hash", "h"}, {"scene", "ü\n"}, {"seed", ""}});
  EXPECT_EQ(find_note("f", bytes_of(file), "scene"), "ü\n");
  EXPECT_EQ(find_note("f", bytes_of(file), "scene_hash"), "h");
  EXPECT_EQ(find_note("f", bytes_of(file), "seed"), "");
  EXPECT_EQ(find_note("f", bytes_of(file), "see"), std::nullopt);
  EXPECT_EQ(find_note("f", bytes_of(file), ""), std::nullopt);
  // Behind the texels too, where other programs write it; compressed text is not ours.
  const std::string behind = plain.substr(0, plain.size() - 12) + png_chunk("tEXt", std::string("k\0v", 3)) + png_chunk("IEND", "");
  EXPECT_EQ(find_note("f", bytes_of(behind), "k"), "v");
  for (const std::string& chunk : {png_chunk("zTXt", std::string("k\0\0v", 4)), png_chunk("iTXt", std::string("k\0\1\0\0\0v", 7)),
                                   png_chunk("iTXt", std::string("k\0\0", 3)), png_chunk("iTXt", std::string("k\0\0\0en", 6))})
    EXPECT_EQ(find_note("f", bytes_of(png(1, 1, 8, 2, {"abc"}, chunk)), "k"), std::nullopt);
}

TEST(PngText, DamagedIsSaidAndNotTaken) {
  std::string file = noted({{"scene", "rate = 4"}});
  file[file.find("rate = 4") + 7] = '5';
  EXPECT_EQ(error_of([&] { find_note("'a.png'", bytes_of(file), "scene"); }),
            "2 'a.png': damaged: the checksum of its text 'scene' is wrong");
  for (std::size_t size = 0; size < file.size(); ++size)  // cut anywhere: nothing, or that error
    EXPECT_THAT(error_of([&] { find_note("f", bytes_of(file).first(size), "scene"); }), testing::AnyOf("none", StartsWith("2 "))) << size;
}

const Notes notes{{"rainref:scene", "effect = \"puddle\"\nrain.rate = 4.0\n"}, {"rainref:seed", "7"}, {"rainref:name", "Straße"}};

TEST(Notes, PngAndExrKeepThemAndTheirTexels) {
  const TemporaryFolder folder;
  const Image display =
      make_image(Format::rgba8, 5, 3, [](int x, int y, int c) { return Unorm8{static_cast<std::uint8_t>(50 * x + 10 * y + c)}; });
  const Image colour = make_image(Format::rgba32f, 5, 3, [](int x, int y, int c) { return 0.1f * static_cast<float>(x + 7 * y - c); });
  write_png(folder / "plain.png", display);
  write_png(folder / "noted.png", display, PngChannels::rgb, notes);
  write_exr(folder / "plain.exr", {{"", {"R", "G", "B"}, &colour}});
  write_exr(folder / "noted.exr", {{"", {"R", "G", "B"}, &colour}}, notes);
  for (const std::string kind : {".png", ".exr"}) {
    const std::string file = contents(folder / ("noted" + kind)), without = contents(folder / ("plain" + kind));
    EXPECT_TRUE(may_have_notes(bytes_of(file)));
    for (const Note& note : notes) {
      EXPECT_EQ(find_note("f", bytes_of(file), note.key), note.value) << kind;
      EXPECT_EQ(find_note("f", bytes_of(without), note.key), std::nullopt) << kind;
    }
    const Picture a = read(folder / ("noted" + kind)), b = read(folder / ("plain" + kind));
    EXPECT_EQ(a.decoded_hash, b.decoded_hash);
    EXPECT_EQ(a.channel_names, b.channel_names);
  }
  // The same at any time, and nothing of the library.
  write_exr(folder / "again.exr", {{"", {"R", "G", "B"}, &colour}}, notes);
  EXPECT_EQ(contents(folder / "again.exr"), contents(folder / "noted.exr"));
  EXPECT_THAT(contents(folder / "noted.exr"), Not(HasSubstr("OpenImageIO")));
}

TEST(Notes, OtherBytesHaveNone) {
  for (const std::string bytes : {"", "effect = 'puddle'\n", "\x89PNG", "\xff\xd8\xff"}) {
    EXPECT_EQ(find_note("f", bytes_of(bytes), "k"), std::nullopt);
    EXPECT_FALSE(may_have_notes(bytes_of(bytes)));
  }
  const std::string cut = "\x76\x2f\x31\x01" + little(2) + "name";
  EXPECT_THAT(error_of([&] { find_note("'a.exr'", bytes_of(cut), "k"); }), StartsWith("2 "));
}

}  // namespace
}  // namespace rainref::image_io
