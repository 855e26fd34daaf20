// PNG files keep their codes: no premultiplied alpha, no gamma, the top row first.
#include <gmock/gmock.h>

#include "image_io/read.h"
#include "image_io/tiny_files.h"

namespace rainref::image_io {
namespace {

using ::testing::ElementsAre;
using Codes = std::array<std::uint8_t, 4>;

Picture read_bytes(const std::string& bytes) {
  const TemporaryFolder folder;
  put(folder / "a.png", bytes);
  return read(folder / "a.png");
}

TEST(ReadPng, RgbIsTakenAsItIsTopRowFirst) {
  const Picture p = read_bytes(png(2, 2, 8, 2, {{"\1\2\3\4\5\6"}, {"\7\x08\x09\xfd\xfe\xff"}}));
  EXPECT_EQ(p.image.format(), Format::rgba8);
  EXPECT_EQ(texel<std::uint8_t>(p.image, 0, 0), (Codes{1, 2, 3, 255}));
  EXPECT_EQ(texel<std::uint8_t>(p.image, 1, 0), (Codes{4, 5, 6, 255}));
  EXPECT_EQ(texel<std::uint8_t>(p.image, 1, 1), (Codes{253, 254, 255, 255}));
  EXPECT_THAT(p.channel_names, ElementsAre("R", "G", "B"));
  EXPECT_TRUE(p.srgb_encoded);
  EXPECT_FALSE(p.lossy);
  EXPECT_EQ(p.compression, "deflate");
  EXPECT_EQ(p.file_width, 2);
  EXPECT_EQ(p.file_height, 2);
}

TEST(ReadPng, ColourIsNotMultipliedByAlpha) {
  const Picture p = read_bytes(png(2, 1, 8, 6, {std::string("\xc8\x64\x32\0\xc8\x64\x32\x80", 8)}));
  EXPECT_EQ(texel<std::uint8_t>(p.image, 0, 0), (Codes{200, 100, 50, 0}));
  EXPECT_EQ(texel<std::uint8_t>(p.image, 1, 0), (Codes{200, 100, 50, 128}));
}

TEST(ReadPng, GreyIsReplicated) {
  const Picture grey = read_bytes(png(2, 1, 8, 0, {{"\x11\xee"}}));
  EXPECT_EQ(texel<std::uint8_t>(grey.image, 0, 0), (Codes{17, 17, 17, 255}));
  EXPECT_EQ(texel<std::uint8_t>(grey.image, 1, 0), (Codes{238, 238, 238, 255}));
  EXPECT_EQ(grey.channel_names.size(), 1u);
  const Picture with_alpha = read_bytes(png(2, 1, 8, 4, {std::string("\x11\0\xee\x7f", 4)}));
  EXPECT_EQ(texel<std::uint8_t>(with_alpha.image, 0, 0), (Codes{17, 17, 17, 0}));
  EXPECT_EQ(texel<std::uint8_t>(with_alpha.image, 1, 0), (Codes{238, 238, 238, 127}));
}

TEST(ReadPng, FewBitsAndPalettesBecomeEightBits) {
  const Picture bits = read_bytes(png(8, 1, 1, 0, {{"\xa5"}}));
  EXPECT_EQ(texel<std::uint8_t>(bits.image, 0, 0), (Codes{255, 255, 255, 255}));
  EXPECT_EQ(texel<std::uint8_t>(bits.image, 1, 0), (Codes{0, 0, 0, 255}));
  const std::string colours = png_chunk("PLTE", "\1\2\3\4\5\6") + png_chunk("tRNS", std::string("\x40", 1));
  const Picture palette = read_bytes(png(2, 1, 8, 3, {std::string("\1\0", 2)}, colours));
  EXPECT_EQ(texel<std::uint8_t>(palette.image, 0, 0), (Codes{4, 5, 6, 255}));
  EXPECT_EQ(texel<std::uint8_t>(palette.image, 1, 0), (Codes{1, 2, 3, 64}));
}

TEST(ReadPng, SixteenBitsAreDividedOnceAndCorrectly) {
  // Every code, over 256 rows, as grey.
  std::vector<std::string> rows(127);
  for (int y = 0; y < 127; ++y) {
    for (int x = 0; x < 256; ++x) rows[y] += big(516 * y + 2 * x + (x & 1), 2);
  }
  const Picture p = read_bytes(png(256, 127, 16, 0, rows));
  ASSERT_EQ(p.image.format(), Format::rgba32f);
  EXPECT_TRUE(p.srgb_encoded);
  for (int y = 0; y < 127; ++y) {
    for (int x = 0; x < 256; ++x) {
      // Rounding the double quotient again gives the same: no quotient of 16-bit numbers lies that near to a tie.
      const float expected = static_cast<float>((516 * y + 2 * x + (x & 1)) / 65535.0);
      ASSERT_EQ(texel<float>(p.image, x, y), (std::array<float, 4>{expected, expected, expected, 1.0f}));
    }
  }
}

TEST(ReadPng, SixteenBitColourAndAlpha) {
  const Picture p = read_bytes(png(1, 1, 16, 6, {big(65535, 2) + big(1, 2) + big(32768, 2) + big(0, 2)}));
  EXPECT_EQ(texel<float>(p.image, 0, 0), (std::array<float, 4>{1.0f, 1.0f / 65535.0f, 32768.0f / 65535.0f, 0.0f}));
}

TEST(ReadPng, AFileThatDeclaresLinearIntegersIsBelieved) {
  EXPECT_TRUE(read_bytes(png(1, 1, 8, 0, {{"\1"}}, png_chunk("sRGB", std::string(1, '\0')))).srgb_encoded);
  EXPECT_TRUE(read_bytes(png(1, 1, 8, 0, {{"\1"}}, png_chunk("gAMA", big(45455)))).srgb_encoded);
  EXPECT_FALSE(read_bytes(png(1, 1, 8, 0, {{"\1"}}, png_chunk("gAMA", big(100000)))).srgb_encoded);
}

TEST(ReadPng, APrintOffsetMovesNothing) {
  const Picture p = read_bytes(png(2, 1, 8, 0, {{"\1\2"}}, png_chunk("oFFs", big(5) + big(7) + std::string(1, '\0'))));
  EXPECT_EQ(p.image.width(), 2);
  EXPECT_EQ(texel<std::uint8_t>(p.image, 1, 0)[0], 2);
}

TEST(ReadPng, EqualTexelsHaveEqualHashes) {
  const Picture grey = read_bytes(png(2, 1, 8, 0, {{"\1\2"}}));
  const Picture rgb = read_bytes(png(2, 1, 8, 2, {{"\1\1\1\2\2\2"}}));
  const Picture other = read_bytes(png(2, 1, 8, 2, {{"\1\1\1\2\2\3"}}));
  EXPECT_EQ(grey.decoded_hash, rgb.decoded_hash);
  EXPECT_NE(grey.decoded_hash, other.decoded_hash);
}

}  // namespace
}  // namespace rainref::image_io
