// Written pictures keep their bits, are the same bytes each time, and leave an old file whole where writing fails.
#include "image_io/write.h"

#include <signal.h>
#include <sys/resource.h>

#include <thread>

#include <gmock/gmock.h>

#include "base/child_process.h"
#include "image_io/read.h"
#include "image_io/tiny_files.h"

namespace rainref::image_io {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

Image codes(Format format, int width = 67, int height = 19) {
  return make_image(format, width, height, [](int x, int y, int c) {
    // Alpha takes all values, 0 among them.
    return Unorm8{static_cast<std::uint8_t>(c == 3 ? x + y : x * 37 + y * 101 + c * 59)};
  });
}

Image halves(int width = 67, int height = 19) {
  return make_image(Format::rgba16f, width, height,
                    [](int x, int y, int c) { return Half{static_cast<std::uint16_t>((x * 977 + y * 3331 + c * 71) & 0xbbff)}; });
}

Image floats(int width = 67, int height = 19) {
  return make_image(Format::rg32f, width, height, [](int x, int y, int c) { return (x - 31) * .1f + y / 7.0f + c; });
}

/// The first `channels` channels of every texel have equal bytes.
void expect_equal_texels(const Image& a, const Image& b, int channels) {
  ASSERT_EQ(a.width(), b.width());
  ASSERT_EQ(a.height(), b.height());
  const std::size_t bytes = channels * info(a.format()).channel_bytes;
  ASSERT_EQ(info(a.format()).channel_bytes, info(b.format()).channel_bytes);
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      ASSERT_EQ(
          std::memcmp(a.row_bytes(y) + x * info(a.format()).texel_bytes(), b.row_bytes(y) + x * info(b.format()).texel_bytes(), bytes), 0)
          << "x " << x << ", y " << y;
    }
  }
}

TEST(WritePng, KeepsEveryCodeAlsoWhereAlphaIsZero) {
  const TemporaryFolder folder;
  const Image image = codes(Format::rgba8);
  write_png(folder / "a.png", image, PngChannels::rgba);
  const Picture p = read(folder / "a.png");
  EXPECT_THAT(p.channel_names, ElementsAre("R", "G", "B", "A"));
  expect_equal_texels(p.image, image, 4);
}

TEST(WritePng, RgbLeavesAlphaOut) {
  const TemporaryFolder folder;
  const Image image = codes(Format::rgba8_srgb);
  write_png(folder / "a.png", image);
  const Picture p = read(folder / "a.png");
  EXPECT_THAT(p.channel_names, ElementsAre("R", "G", "B"));
  EXPECT_TRUE(p.srgb_encoded);
  EXPECT_NE(contents(folder / "a.png").find("sRGB"), std::string::npos);
  expect_equal_texels(p.image, image, 3);
  EXPECT_EQ(texel<std::uint8_t>(p.image, 5, 5)[3], 255);
}

TEST(WritePng, TheNameNeedsNoExtension) {
  const TemporaryFolder folder;
  write_png(folder / "picture", codes(Format::rgba8));
  EXPECT_EQ(read(folder / "picture").compression, "deflate");
}

TEST(WriteExr, EveryFiniteHalfKeepsItsBits) {
  const TemporaryFolder folder;
  const Image image = make_image(Format::r16f, 248, 256, [](int x, int y, int) {
    const int i = 248 * y + x;
    return Half{static_cast<std::uint16_t>(i < 31744 ? i : i + 1024)};
  });
  write_exr(folder / "a.exr", {{"", {"Y"}, &image}});
  const Picture p = read(folder / "a.exr");
  ASSERT_EQ(p.image.format(), Format::rgba16f);
  EXPECT_EQ(p.compression, "zip");
  EXPECT_FALSE(p.lossy);
  expect_equal_texels(p.image, image, 1);
}

TEST(WriteExr, LayersOfSeveralTypesKeepTheirBits) {
  const TemporaryFolder folder;
  const Image colour = halves(), motion = floats(), normal = halves(67, 19);
  write_exr(folder / "a.exr", {{"", {"R", "G", "B", "A"}, &colour}, {"motion", {"U", "V"}, &motion}, {"normal", {"X", "Y", "Z"}, &normal}});
  const Picture main = read(folder / "a.exr");
  ASSERT_EQ(main.image.format(), Format::rgba16f);
  EXPECT_EQ(main.channel_names.size(), 9u);
  expect_equal_texels(main.image, colour, 4);
  const Picture second = read(folder / "a.exr", "motion");
  ASSERT_EQ(second.image.format(), Format::rgba32f);
  expect_equal_texels(second.image, motion, 2);
  expect_equal_texels(read(folder / "a.exr", "normal").image, normal, 3);
}

TEST(WriteExr, HalfAndFloatInOneLayerAreReadAsFloat) {
  const TemporaryFolder folder;
  const Image colour = halves(), depth = floats();
  write_exr(folder / "a.exr", {{"", {"R", "G", "B"}, &colour}, {"", {"A"}, &depth}});
  const Picture p = read(folder / "a.exr");
  ASSERT_EQ(p.image.format(), Format::rgba32f);
  EXPECT_EQ(texel<float>(p.image, 40, 3)[3], depth.row<float>(3)[80]);
}

TEST(WriteExr, NanIsWrittenAndRefusedOnReading) {
  const TemporaryFolder folder;
  const Image image = make_image(Format::r32f, 3, 2, [](int x, int y, int) { return x == 1 && y == 1 ? std::nanf("") : 0.0f; });
  write_exr(folder / "a.exr", {{"", {"height"}, &image}});
  EXPECT_THAT(error_of([&] { read(folder / "a.exr"); }),
              AllOf(StartsWith("2 "), HasSubstr("NaN at x 1, y 1 (from the top), channel 'height'")));
}

TEST(Write, TheSameImageGivesTheSameBytes) {
  const TemporaryFolder folder;
  const Image colour = halves(), motion = floats(), display = codes(Format::rgba8_srgb);
  write_exr(folder / "a.exr", {{"", {"R", "G", "B"}, &colour}, {"motion", {"U", "V"}, &motion}});
  write_png(folder / "a.png", display);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // dates in headers count seconds
  write_exr(folder / "other.exr", {{"", {"R", "G", "B"}, &colour}, {"motion", {"U", "V"}, &motion}});
  write_png(folder / "other.png", display);
  EXPECT_EQ(contents(folder / "a.exr"), contents(folder / "other.exr"));
  EXPECT_EQ(contents(folder / "a.png"), contents(folder / "other.png"));
  EXPECT_FALSE(contents(folder / "a.exr").empty());
  EXPECT_EQ(contents(folder / "a.exr").find("OpenImageIO"), std::string::npos);
  EXPECT_EQ(contents(folder / "a.png").find("OpenImageIO"), std::string::npos);
  EXPECT_THAT(folder.names(), ElementsAre("a.exr", "a.png", "other.exr", "other.png"));
}

TEST(Write, AnUnwritablePlaceIsAnIoErrorWithItsReason) {
  const TemporaryFolder folder;
  put(folder / "file", "x");
  const Image image = halves(), display = codes(Format::rgba8);
  EXPECT_EQ(error_of([&] {
              write_exr(folder / "file/a.exr", {{"", {"R", "G", "B"}, &image}});
            }),
            "4 cannot write '" + (folder / "file/a.exr").string() + "': Not a directory");
  EXPECT_EQ(error_of([&] { write_png(folder / "none/a.png", display); }),
            "4 cannot write '" + (folder / "none/a.png").string() + "': No such file or directory");
  EXPECT_THAT(folder.names(), ElementsAre("file"));
}

TEST(Write, AFullDiskLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder folder;
  put(folder / "a.exr", "old");
  const Image image = halves(200, 200);
  ChildProcess child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::string error = error_of([&] { write_exr(folder / "a.exr", {{"", {"R", "G", "B"}, &image}}); });
    return error.starts_with("4 ") ? 0 : 1;
  });
  EXPECT_EQ(child.wait(), 0);
  EXPECT_EQ(contents(folder / "a.exr"), "old");
  EXPECT_THAT(folder.names(), ElementsAre("a.exr"));
}

TEST(Write, MisuseIsADefect) {
  const TemporaryFolder folder;
  const Image small = halves(2, 2), large = halves(3, 2), display = codes(Format::rgba8, 2, 2);
  const std::vector<std::vector<Layer>> cases{{},
                                              {{"", {"R"}, nullptr}},
                                              {{"", {}, &small}},
                                              {{"", {"R", "R"}, &small}},
                                              {{"", {"a", "b", "c", "d", "e"}, &small}},
                                              {{"", {"R"}, &small}, {"n", {"X"}, &large}},
                                              {{"", {"R"}, &display}}};
  for (const auto& layers : cases) EXPECT_THAT(error_of([&] { write_exr(folder / "a.exr", layers); }), StartsWith("5 "));
  EXPECT_THROW(write_png(folder / "a.png", small), Error);
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace rainref::image_io
