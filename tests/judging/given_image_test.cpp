// Images that a port gives in memory: what a file may hold, and floats, which are stored as the output stores them.
#include "judging/given_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "math/half.h"
#include "rainref/error.h"

namespace rainref::judging {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();

capture::Array expected(Format format, int width) {
  capture::Array a;
  a.format = format;
  a.width = width;
  a.height = 1;
  a.levels.resize(1);
  return a;
}
template <class T>
port_dump::StoredImage one_row(FormatInfo::Kind kind, std::size_t channels, const std::vector<T>& values) {
  port_dump::StoredImage image;
  image.file = "a.b/0/out.c";
  image.set_channels(kind, channels);
  image.width = values.size() / channels;
  image.height = 1;
  image.row_pitch = image.width * image.texel_bytes;
  image.rows = std::as_bytes(std::span(values));
  return image;
}
std::vector<int> codes(const port_dump::StoredImage& given, Format format, port_dump::ReadNotes& notes) {
  std::vector<int> out;
  for (const std::byte b : canonical_image(given, expected(format, static_cast<int>(given.width)), notes))
    out.push_back(std::to_integer<int>(b));
  return out;
}

TEST(GivenImage, FloatsOf8BitCodesAreStoredToNearestEven) {
  port_dump::ReadNotes notes;
  const std::vector<float> floats{0.5f / 255, 1.5f / 255, 2, -1, nan, infinity, 100.0f / 255};
  EXPECT_THAT(codes(one_row(FormatInfo::float32, 1, floats), Format::r8, notes), testing::ElementsAre(0, 2, 255, 0, 0, 255, 100));
  std::vector<Half> halves;  // the first two are not half way between codes any more
  for (const float x : floats) halves.push_back(to_half(x));
  EXPECT_THAT(codes(one_row(FormatInfo::float16, 1, halves), Format::r8, notes),
              testing::ElementsAre(testing::_, testing::_, 255, 0, 0, 255, 100));
  EXPECT_TRUE(notes.lines.empty());
}
TEST(GivenImage, FloatsOfAnSrgbBufferAreEncodedButForAlpha) {
  port_dump::ReadNotes notes;
  // IEC 61966-2-1: .5 is 187.516, .0031308 / 2 is 255 * 12.92 * .0015654 = 5.157.
  const std::vector<float> floats{0.5f, 0.0015654f, 2, 0.5f, nan, -1, 0, nan};
  EXPECT_THAT(codes(one_row(FormatInfo::float32, 4, floats), Format::rgba8_srgb, notes),
              testing::ElementsAre(188, 5, 255, 128, 0, 0, 0, 0));
}
TEST(GivenImage, FloatsOfHalvesAreStoredToNearestEven) {
  port_dump::ReadNotes notes;
  // 1 + 2^-11 is half way from 1 to the next half, and 65520 half way to what would be 65536.
  const auto bytes = canonical_image(one_row(FormatInfo::float32, 1, std::vector<float>{1 + 0x1p-11f, 65519, 65520, -0.0f}),
                                     expected(Format::r16f, 4), notes);
  std::vector<std::uint16_t> halves(4);
  ASSERT_EQ(bytes.size(), 8u);
  std::memcpy(halves.data(), bytes.data(), 8);
  EXPECT_THAT(halves, testing::ElementsAre(0x3c00, 0x7bff, 0x7c00, 0x8000));
}
TEST(GivenImage, ChannelsBeyondTheBuffersAreLeftOutAndNamed) {
  port_dump::ReadNotes notes;
  const std::vector<std::uint8_t> rgba{1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_THAT(codes(one_row(FormatInfo::unorm8, 4, rgba), Format::rg8, notes), testing::ElementsAre(1, 2, 5, 6));
  const std::vector<float> floats{1, 0, 1, 1};
  EXPECT_THAT(codes(one_row(FormatInfo::float32, 4, floats), Format::r8, notes), testing::ElementsAre(255));
  EXPECT_THAT(notes.lines, testing::ElementsAre("a.b/0/out.c: 4 channels, the buffer has 2: ba not read",
                                                "a.b/0/out.c: 4 channels, the buffer has 1: gba not read"));
}
TEST(GivenImage, WhatNoFileMayHoldIsRefused) {
  port_dump::ReadNotes notes;
  const auto refusal = [&](const port_dump::StoredImage& given, Format format, int width) -> std::string {
    try {
      canonical_image(given, expected(format, width), notes);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::port_files);
      return e.what();
    }
    return "";
  };
  const std::vector<float> floats{1, 2};
  const std::vector<Half> halves{{0}, {1}};
  const std::vector<std::uint8_t> bytes{1, 2};
  EXPECT_EQ(refusal(one_row(FormatInfo::float32, 1, floats), Format::r8, 3), "a.b/0/out.c: expected 3x1 texels, found 2x1");
  EXPECT_EQ(refusal(one_row(FormatInfo::float32, 1, floats), Format::rg8, 2), "a.b/0/out.c: expected 2 channels of rg8, found 1");
  EXPECT_THAT(refusal(one_row(FormatInfo::float16, 1, halves), Format::r32f, 2),
              testing::HasSubstr("expected r32f as floats, found halves"));
  EXPECT_THAT(refusal(one_row(FormatInfo::unorm8, 1, bytes), Format::r16f, 2),
              testing::HasSubstr("expected r16f as halves, found 8-bit codes"));
  EXPECT_THAT(refusal(one_row(FormatInfo::float32, 1, floats), Format::r32ui, 2), testing::HasSubstr("found floats"));
}

}  // namespace
}  // namespace rainref::judging
