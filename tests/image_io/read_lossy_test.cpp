// HDR and JPEG files are decoded as their formats say; JPEG is marked lossy.
#include <gmock/gmock.h>

#include "image_io/read.h"
#include "image_io/tiny_files.h"

namespace rainref::image_io {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
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

Picture read_with(const std::string& lines) { return read_bytes(hdr(1, 1, {{128, 64, 32, 129}}, "-Y {h} +X {w}", lines)); }

// Greg Ward's format: pixels are radiance times every EXPOSURE and, channel by channel, every COLORCORR of the header.
TEST(ReadHdr, TheHeadersFactorsAreDividedOut) {
  EXPECT_EQ(texel<float>(read_with("EXPOSURE=2.0\n").image, 0, 0), (Floats{.5f, .25f, .125f, 1}));
  EXPECT_EQ(texel<float>(read_with("EXPOSURE=  1.600000e+01\nSOFTWARE=x\nEXPOSURE=+5E-1\r\n").image, 0, 0),
            (Floats{.125f, .0625f, .03125f, 1}));
  EXPECT_EQ(texel<float>(read_with("COLORCORR= 2 4 .5\nEXPOSURE=2\n").image, 0, 0), (Floats{.25f, .0625f, .25f, 1}));
  EXPECT_EQ(texel<float>(read_with("EXPOSURE=3\n").image, 0, 0)[0], static_cast<float>(1 / 3.0)) << "rounded once";
  EXPECT_NE(read_with("EXPOSURE=2\n").decoded_hash, read_with("").decoded_hash);
  EXPECT_THAT(read_with("EXPOSURE=2\n").remarks,
              testing::ElementsAre("its pixels are divided by 2, 2 and 2, by which its header says they were multiplied"));
}
TEST(ReadHdr, OtherLinesChangeNothing) {
  const Picture plain = read_with("");
  EXPECT_THAT(plain.remarks, testing::ElementsAre());
  for (const char* lines : {"EXPOSURE=1\n", "EXPOSURE=4\nEXPOSURE=0.25\n", "# EXPOSURE=2\n", "\tEXPOSURE=2\n", "VIEW= -vtv\n"})
    EXPECT_EQ(read_with(lines).decoded_hash, plain.decoded_hash) << lines;
  // Behind the header there are pixels.
  const std::string bytes = hdr(4, 1, {{'\n', 'E', 'X', 'P'}, {'O', 'S', 'U', 'R'}, {'E', '=', '2', '\n'}, {2, 2, 2, 129}});
  EXPECT_THAT(read_bytes(bytes).remarks, testing::ElementsAre());
}
TEST(ReadHdr, AHeaderMayEndAnywhere) {
  const std::string whole = hdr(1, 1, {{1, 1, 1, 136}}, "-Y {h} +X {w}", "EXPOSURE=2\nCOLORCORR=1 2 3\n");
  for (std::size_t bytes = 11; bytes < whole.size(); ++bytes) {
    EXPECT_THAT(error_of([&] { read_bytes(whole.substr(0, bytes)); }), StartsWith("2 ")) << bytes;
  }
}
TEST(ReadHdr, FactorsThatAreNoneAreRefused) {
  for (const char* lines : {"EXPOSURE=\n", "EXPOSURE=0\n", "EXPOSURE=-2\n", "EXPOSURE=nan\n", "EXPOSURE=inf\n", "EXPOSURE=1e999\n",
                            "EXPOSURE=2 3\n", "EXPOSURE=x\n", "COLORCORR=1 2\n", "COLORCORR=1 0 1\n", "COLORCORR=1 2 3 4\n",
                            "EXPOSURE=1e-30\nEXPOSURE=1e-30\n", "EXPOSURE=1e30\nEXPOSURE=1e30\n"}) {
    EXPECT_THAT(error_of([&] { read_with(lines); }), AllOf(StartsWith("2 "), testing::AnyOf(HasSubstr("EXPOSURE"), HasSubstr("COLORCORR"))))
        << lines;
  }
  EXPECT_THAT(error_of([] { read_with("EXPOSURE=-2\n"); }), HasSubstr("a': EXPOSURE: expected a number above 0, found '-2'"));
}

TEST(ReadHdr, AnUnusualOrientationIsRefused) {
  for (const char* axes : {"+Y {h} +X {w}", "-Y {h} -X {w}"}) {
    EXPECT_THAT(error_of([&] {
                  read_bytes(hdr(1, 2, {{1, 1, 1, 136}, {2, 2, 2, 136}}, axes));
                }),
                AllOf(StartsWith("2 "), HasSubstr("save it upright")))
        << axes;
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

// A telephone stores what its sensor sees, and says in EXIF which way up that is. Stored: blocks 129 130 131 over 132 133 134.
TEST(ReadJpeg, IsTurnedUprightAsItsExifSays) {
  const std::string stored = jpeg(3);
  const std::vector<std::vector<int>> upright[8]{{{129, 130, 131}, {132, 133, 134}},   {{131, 130, 129}, {134, 133, 132}},
                                                 {{134, 133, 132}, {131, 130, 129}},   {{132, 133, 134}, {129, 130, 131}},
                                                 {{129, 132}, {130, 133}, {131, 134}}, {{132, 129}, {133, 130}, {134, 131}},
                                                 {{134, 131}, {133, 130}, {132, 129}}, {{131, 134}, {130, 133}, {129, 132}}};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const std::string exif =
        std::string("Exif\0\0MM\0\x2a\0\0\0\x08\0\1\x01\x12\0\3\0\0\0\1\0", 25) + static_cast<char>(orientation) + std::string(6, '\0');
    const std::string bytes =
        stored.substr(0, 2) + "\xff\xe1" + big(static_cast<std::uint32_t>(exif.size() + 2), 2) + exif + stored.substr(2);
    const Picture p = read_bytes(bytes);
    const auto& rows = upright[orientation - 1];
    ASSERT_EQ(p.image.width(), 8 * static_cast<int>(rows[0].size())) << orientation;
    ASSERT_EQ(p.image.height(), 8 * static_cast<int>(rows.size()));
    EXPECT_EQ(p.file_width, p.image.width());
    EXPECT_EQ(p.file_height, p.image.height());
    for (int y = 0; y < p.image.height(); ++y)
      for (int x = 0; x < p.image.width(); ++x)
        ASSERT_EQ(texel<std::uint8_t>(p.image, x, y)[1], rows[static_cast<std::size_t>(y / 8)][static_cast<std::size_t>(x / 8)])
            << orientation;
  }
}

}  // namespace
}  // namespace rainref::image_io
