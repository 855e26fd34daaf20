#include <gmock/gmock.h>

#include "image_io/read.h"
#include "image_io/tiny_files.h"

namespace rainref::image_io {
namespace {

using ::testing::HasSubstr;
using Floats = std::array<float, 4>;

Picture read_bytes(const std::string& bytes) {
  const TemporaryFolder folder;
  put(folder / "a", bytes);  // the name has no say
  return read(folder / "a");
}

TEST(ReadHdr, DecodesSharedExponentsTopRowFirst) {
  // value = mantissa * 2^(exponent - 136); exponent 0 is black.
  const Picture p = read_bytes(hdr(2, 2, {{128, 64, 32, 129}, {1, 2, 3, 136}, {255, 0, 1, 140}, {9, 9, 9, 0}}));
  ASSERT_EQ(p.image.format(), Format::rgba32f);
  EXPECT_EQ(texel<float>(p.image, 0, 0), (Floats{1, .5f, .25f, 1}));
  EXPECT_EQ(texel<float>(p.image, 1, 0), (Floats{1, 2, 3, 1}));
  EXPECT_EQ(texel<float>(p.image, 0, 1), (Floats{4080, 0, 16, 1}));
  EXPECT_EQ(texel<float>(p.image, 1, 1), (Floats{0, 0, 0, 1}));
  EXPECT_TRUE(p.lossy);
  EXPECT_FALSE(p.srgb_encoded);
  EXPECT_EQ(p.compression, "rgbe");
}

TEST(ReadHdr, AnUnusualOrientationIsRefused) {
  for (const char* axes : {"+Y {h} +X {w}", "-Y {h} -X {w}"}) {
    const auto error = error_of([&] { read_bytes(hdr(1, 2, {{1, 1, 1, 136}, {2, 2, 2, 136}}, axes)); });
    ASSERT_TRUE(error) << axes;
    EXPECT_EQ(error->code(), ExitCode::usage);
    EXPECT_THAT(error->what(), HasSubstr("save it upright"));
  }
}

TEST(ReadJpeg, DecodesAndIsMarkedLossy) {
  const Picture p = read_bytes(jpeg(3));
  ASSERT_EQ(p.image.format(), Format::rgba8);
  ASSERT_EQ(p.image.width(), 24);
  ASSERT_EQ(p.image.height(), 16);
  EXPECT_EQ(texel<std::uint8_t>(p.image, 0, 0), (std::array<std::uint8_t, 4>{129, 129, 129, 255}));
  EXPECT_EQ(texel<std::uint8_t>(p.image, 23, 15), (std::array<std::uint8_t, 4>{134, 134, 134, 255}));
  EXPECT_TRUE(p.lossy);
  EXPECT_TRUE(p.srgb_encoded);
  EXPECT_EQ(p.compression, "jpeg");
}

}  // namespace
}  // namespace rainref::image_io
