// Images have the formats, sizes, margins and alignment that are declared, and views copy without padding.
#include "rainref/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <optional>
#include <utility>

#include "base/error_of.h"
#include "base/hash.h"
#include "image/flipped.h"
#include "image/images.h"
#include "rainref/error.h"

namespace rainref {
namespace {

using testing::HasSubstr;

constexpr Format formats[] = {Format::r8,      Format::rg8,  Format::rgba8, Format::rgba8_srgb, Format::r16f, Format::rg16f,
                              Format::rgba16f, Format::r32f, Format::rg32f, Format::rgba32f,    Format::r32ui};

TEST(Format, NamesAndSizes) {
  const struct {
    Format format;
    const char* name;
    int channels, channel_bytes;
    FormatInfo::Kind kind;
  } table[] = {{Format::r8, "r8", 1, 1, FormatInfo::unorm8},
               {Format::rg8, "rg8", 2, 1, FormatInfo::unorm8},
               {Format::rgba8, "rgba8", 4, 1, FormatInfo::unorm8},
               {Format::rgba8_srgb, "rgba8_srgb", 4, 1, FormatInfo::srgb8},
               {Format::r16f, "r16f", 1, 2, FormatInfo::float16},
               {Format::rg16f, "rg16f", 2, 2, FormatInfo::float16},
               {Format::rgba16f, "rgba16f", 4, 2, FormatInfo::float16},
               {Format::r32f, "r32f", 1, 4, FormatInfo::float32},
               {Format::rg32f, "rg32f", 2, 4, FormatInfo::float32},
               {Format::rgba32f, "rgba32f", 4, 4, FormatInfo::float32},
               {Format::r32ui, "r32ui", 1, 4, FormatInfo::uint32}};
  for (const auto& row : table) {
    EXPECT_EQ(info(row.format).name, row.name);
    EXPECT_EQ(info(row.format).channels, row.channels) << row.name;
    EXPECT_EQ(info(row.format).channel_bytes, row.channel_bytes) << row.name;
    EXPECT_EQ(info(row.format).texel_bytes(), row.channels * row.channel_bytes) << row.name;
    EXPECT_EQ(info(row.format).kind, row.kind) << row.name;
    EXPECT_EQ(format_from_name(row.name), row.format);
  }
}

TEST(Format, AnUnknownNameIsRefusedWithTheNearestOne) {
  EXPECT_EQ(error_of([] { format_from_name("rgba16"); }), "2 unknown format 'rgba16'; did you mean 'rgba16f'?");
  EXPECT_EQ(error_of([] { format_from_name("bc7"); }), "2 unknown format 'bc7'");
  EXPECT_EQ(error_of([] { format_from_name(""); }), "2 unknown format ''");
  EXPECT_EQ(error_of([] { format_from_name("R8"); }), "2 unknown format 'R8'; did you mean 'r8'?");
}

TEST(Rounding, Names) {
  EXPECT_STREQ(name(Rounding::rne), "rne");
  EXPECT_STREQ(name(Rounding::rtz), "rtz");
}

TEST(Image, IsZeroWithItsMarginsAndRowsDoNotOverlap) {
  for (const Format format : formats) {
    for (const int width : {1, 2, 15, 16, 17, 33, 100}) {
      Image image(format, width, 3);
      const int texel = info(format).texel_bytes();
      EXPECT_EQ(image.width(), width);
      EXPECT_EQ(image.height(), 3);
      EXPECT_EQ(image.format(), format);
      EXPECT_EQ(image.channels(), info(format).channels);
      EXPECT_FALSE(image.empty());
      const int row = (Image::left_margin + width + Image::right_margin) * texel;
      EXPECT_GE(image.stride(), row);
      EXPECT_EQ(Image::memory_bytes(format, width, 3), static_cast<std::size_t>(image.stride()) * 3);
      for (int y = 0; y < 3; ++y) {
        EXPECT_EQ(image.row_bytes(y) - image.row_bytes(0), y * image.stride());
        std::byte* first = image.row_bytes(y) - Image::left_margin * texel;
        for (int i = 0; i < row; ++i) ASSERT_EQ(first[i], std::byte{0});
        std::memset(first, y + 1, static_cast<std::size_t>(row));  // the sanitizers watch the ends
      }
      for (int y = 0; y < 3; ++y) {
        const std::byte* first = image.row_bytes(y) - Image::left_margin * texel;
        for (int i = 0; i < row; ++i) ASSERT_EQ(first[i], static_cast<std::byte>(y + 1));
      }
    }
  }
}

// 64 GiB, which a std::size_t of 32 bits would take for a few MiB.
TEST(Image, TheBytesOfTheLargestAreNotWrapped) {
  const std::uint64_t row = (std::uint64_t{Image::left_margin} + 65536 + Image::right_margin) * 16;
  EXPECT_EQ(Image::memory_bytes(Format::rgba32f, 65536, 65536), (row + 63) / 64 * 64 * 65536);
}

TEST(Image, RowsAreAlignedToWholeVectors) {
  for (const Format format : formats) {
    const Image image(format, 37, 4);
    // 16 texels, and never more than a cache line.
    const std::size_t alignment = std::min<std::size_t>(64, 16 * static_cast<std::size_t>(info(format).texel_bytes()));
    for (int y = 0; y < 4; ++y) {
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(image.row_bytes(y)) % alignment, 0u) << info(format).name << ' ' << y;
    }
    EXPECT_EQ(image.stride() % 64, 0);
  }
}

TEST(Image, SizesOutsideTheRangeAreRefused) {
  for (const auto& [w, h] : {std::pair{0, 5}, {5, 0}, {-1, 5}, {5, -7}, {65537, 1}, {1, 65537}, {2147483647, 2147483647}}) {
    EXPECT_EQ(error_of([w = w, h = h] { Image(Format::r8, w, h); }),
              "2 image size " + std::to_string(w) + "x" + std::to_string(h) + ": each side must be from 1 to 65536");
  }
  EXPECT_NO_THROW(Image(Format::r8, 65536, 1));
  EXPECT_NO_THROW(Image(Format::r8, 1, 65536));
}

TEST(Image, CanBeEmptyAndMoved) {
  Image none;
  EXPECT_TRUE(none.empty());
  Image image(Format::r32f, 5, 2);
  image.row<float>(1)[4] = 3.5f;
  none = std::move(image);
  EXPECT_EQ(none.row<float>(1)[4], 3.5f);
}

TEST(Image, ACopyGoesIntoTheMemoryThatIsThere) {
  Image from(Format::r32f, 5, 3), to;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) from.row<float>(y)[x] = static_cast<float>(10 * y + x);
  copy_into(to, from);
  const std::byte* memory = to.row_bytes(0);
  from.row<float>(2)[4] = -1;
  copy_into(to, from);
  EXPECT_EQ(to.row_bytes(0), memory);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) EXPECT_EQ(to.row<float>(y)[x], from.row<float>(y)[x]) << x << ' ' << y;
  copy_into(to, Image(Format::r16f, 5, 3));
  EXPECT_EQ(to.format(), Format::r16f);
  copy_into(to, Image(Format::r16f, 4, 6));
  EXPECT_EQ(to.width(), 4);
  EXPECT_EQ(to.height(), 6);
}

TEST(BufferView, OfOneImageCopiesRowsWithoutPadding) {
  Image image(Format::rg16f, 3, 2);
  for (int y = 0; y < 2; ++y) {
    for (int i = -10; i < 16; ++i) image.row<Half>(y)[i] = {static_cast<std::uint16_t>(100 * y + i + 10)};  // margins too
  }
  const BufferView view(image);
  ASSERT_EQ(view.row_bytes(), 12u);
  EXPECT_EQ(view.width(), 3);
  EXPECT_EQ(view.height(), 2);
  std::uint16_t row[6];
  view.copy_row(1, reinterpret_cast<std::byte*>(row));
  EXPECT_THAT(row, testing::ElementsAre(110, 111, 112, 113, 114, 115));
}

TEST(BufferView, InterleavesChannelPlanesAndFillsTheRestWithZero) {
  Image red(Format::r8, 3, 2), green(Format::r8, 3, 2);
  for (int x = 0; x < 3; ++x) {
    red.row<Unorm8>(1)[x] = {static_cast<std::uint8_t>(x + 1)};
    green.row<Unorm8>(1)[x] = {static_cast<std::uint8_t>(x + 11)};
  }
  const BufferView view(Format::rgba8, {&red, &green});
  ASSERT_EQ(view.row_bytes(), 12u);
  std::uint8_t row[12];
  std::memset(row, 0xee, sizeof row);
  view.copy_row(1, reinterpret_cast<std::byte*>(row));
  EXPECT_THAT(row, testing::ElementsAre(1, 11, 0, 0, 2, 12, 0, 0, 3, 13, 0, 0));
}

TEST(BufferView, OnePlaneMayStandForAWiderFormat) {
  Image plane(Format::r32f, 2, 1);
  plane.row<float>(0)[0] = 1.5f;
  plane.row<float>(0)[1] = -2.5f;
  float row[4];
  BufferView(Format::rg32f, {&plane}).copy_row(0, reinterpret_cast<std::byte*>(row));
  EXPECT_THAT(row, testing::ElementsAre(1.5f, 0.0f, -2.5f, 0.0f));
}

// Many may hold one memory, and then nobody changes it.
TEST(SharedImage, IsOneMemoryThatNobodyChanges) {
  Image first = make_image(Format::rg16f, 7, 3, [](int x, int y, int c) { return Half{static_cast<std::uint16_t>(100 * y + 10 * x + c)}; });
  const Image copy = copy_of(first);
  const Half* const texels = first.row<Half>(1);
  std::optional<Image> second = first.share();
  const Image third = second->shared();
  for (const Image* image : {&std::as_const(first), &std::as_const(*second), &third}) {
    EXPECT_EQ(image->row<Half>(1), texels);
    EXPECT_TRUE(same(*image, copy));
  }
  EXPECT_EQ(error_of([&] { first.row<Half>(0); }), "5 an image that is shared was to be changed");
  EXPECT_EQ(error_of([&] { second->row<Half>(0); }), "5 an image that is shared was to be changed");
  first = Image(Format::r8, 1, 1);
  second.reset();
  EXPECT_TRUE(same(third, copy)) << "held by the last of them";
  first.row<Unorm8>(0)[0].code = 3;  // a new one is its owner's

  Image own = copy_of(copy);
  const Image of_own = std::as_const(own).shared();
  EXPECT_NE(std::as_const(own).row<Half>(0), of_own.row<Half>(0)) << "of an image that is not shared: a copy";
  own.row<Half>(0)[0] = Half{9};
  EXPECT_TRUE(same(of_own, copy));
  EXPECT_TRUE(Image().share().empty());
}

TEST(ContentHash, IsOfFormatSizeAndTexels) {
  const auto image = [](Format format, int width, int height) {
    Image made(format, width, height);
    for (int y = 0; y < height; ++y)
      for (int i = 0; i < width * info(format).texel_bytes(); ++i) made.row_bytes(y)[i] = std::byte{7};
    return made;
  };
  Image a = image(Format::rgba8, 6, 2);
  const Hash128 hash = a.content_hash();
  EXPECT_EQ(image(Format::rgba8, 6, 2).content_hash(), hash);
  EXPECT_NE(image(Format::rgba8, 2, 6).content_hash(), hash);
  EXPECT_NE(image(Format::rgba8, 4, 3).content_hash(), hash);
  EXPECT_NE(image(Format::r32f, 6, 2).content_hash(), hash);
  EXPECT_NE(Image().content_hash(), hash);
  a.row_bytes(0)[-1] = std::byte{1};
  EXPECT_EQ(a.content_hash(), hash) << "margins do not count";
  a.row_bytes(1)[23] = std::byte{1};
  EXPECT_NE(a.content_hash(), hash);
  const Image shared = a.share();
  EXPECT_EQ(shared.content_hash(), a.content_hash());
  EXPECT_EQ(shared.content_hash(), copy_of(shared).content_hash());
}

}  // namespace
}  // namespace rainref
