// EXR files keep the bits of their halves and floats, and layers are read by name.
#include <bit>
#include <cmath>

#include <gmock/gmock.h>

#include "image_io/read.h"
#include "image_io/tiny_files.h"

namespace rainref::image_io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Halves = std::array<std::uint16_t, 4>;
using Floats = std::array<float, 4>;

Picture read_bytes(const std::string& bytes, std::string_view layer = {}) {
  const TemporaryFolder folder;
  put(folder / "a.exr", bytes);
  return read(folder / "a.exr", layer);
}

/// What is said of a file, which was a mistake of who gave it.
std::string refusal(const std::string& bytes) {
  const std::string said = error_of([&] { read_bytes(bytes); });
  EXPECT_THAT(said, testing::StartsWith("2 "));
  return said;
}

ExrChannel half_channel(const std::string& name, std::uint16_t bits) {
  return {name, ExrType::half, [=](int, int) { return raw(bits); }};
}
ExrChannel float_channel(const std::string& name, float value) {
  return {name, ExrType::float32, [=](int, int) { return raw(value); }};
}

TEST(ReadExr, EveryFiniteHalfKeepsItsBits) {
  // 248 x 256 texels: the 63 488 codes whose exponent is not 31, once in each channel.
  const auto code = [](int x, int y, int shift) {
    const int i = (256 * x + y + shift) % 63488;
    return static_cast<std::uint16_t>(i < 31744 ? i : i + 1024);
  };
  const auto channel = [&](const std::string& name, int shift) {
    return ExrChannel{name, ExrType::half, [=](int x, int y) { return raw(code(x, y, shift)); }};
  };
  const Picture p = read_bytes(exr({0, 0, 248, 256}, {channel("A", 3), channel("B", 2), channel("G", 1), channel("R", 0)}));
  ASSERT_EQ(p.image.format(), Format::rgba16f);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 248; ++x) {
      ASSERT_EQ(texel<std::uint16_t>(p.image, x, y), (Halves{code(x, y, 0), code(x, y, 1), code(x, y, 2), code(x, y, 3)}));
    }
  }
  EXPECT_FALSE(p.srgb_encoded);
  EXPECT_FALSE(p.lossy);
  EXPECT_EQ(p.compression, "none");
}

TEST(ReadExr, FloatsKeepTheirBitsTopRowFirst) {
  const std::vector<float> values{0.0f, -0.0f, 0x1p-149f, -0x1.fffffep+127f, 0.1f, 1.0f};
  const ExrChannel r{"R", ExrType::float32, [&](int x, int y) { return raw(values[2 * y + x]); }};
  const Picture p = read_bytes(exr({0, 0, 2, 3}, {float_channel("B", 3), float_channel("G", 2), r}));
  ASSERT_EQ(p.image.format(), Format::rgba32f);
  for (int i = 0; i < 6; ++i) {
    const Floats t = texel<float>(p.image, i % 2, i / 2);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(t[0]), std::bit_cast<std::uint32_t>(values[i]));
    EXPECT_EQ(t[1], 2.0f);
    EXPECT_EQ(t[2], 3.0f);
    EXPECT_EQ(t[3], 1.0f);
  }
}

TEST(ReadExr, GreyIsReplicatedAndMissingAlphaIsOne) {
  EXPECT_EQ(texel<std::uint16_t>(read_bytes(exr({0, 0, 1, 1}, {half_channel("Y", 0x1234)})).image, 0, 0),
            (Halves{0x1234, 0x1234, 0x1234, 0x3c00}));
  EXPECT_EQ(texel<float>(read_bytes(exr({0, 0, 1, 1}, {float_channel("A", .5f), float_channel("Y", 7)})).image, 0, 0),
            (Floats{7, 7, 7, .5f}));
  EXPECT_EQ(texel<std::uint16_t>(read_bytes(exr({0, 0, 1, 1}, {half_channel("G", 2), half_channel("R", 1)})).image, 0, 0),
            (Halves{1, 2, 0, 0x3c00}));
}

TEST(ReadExr, HalfBesideFloatIsWidened) {
  const Picture p =
      read_bytes(exr({0, 0, 3, 2}, {half_channel("A", 0x0001), float_channel("B", .1f), half_channel("G", 0xc000), float_channel("R", 5)}));
  ASSERT_EQ(p.image.format(), Format::rgba32f);
  EXPECT_EQ(texel<float>(p.image, 2, 1), (Floats{5, -2, .1f, 0x1p-24f}));
}

TEST(ReadExr, ALayerIsReadByName) {
  const std::string bytes = exr({0, 0, 2, 2}, {half_channel("B", 3), half_channel("G", 2), half_channel("R", 1),
                                               float_channel("depth.Z", 9), half_channel("id.X", 7), half_channel("id.Y", 8)});
  EXPECT_EQ(texel<std::uint16_t>(read_bytes(bytes).image, 1, 1), (Halves{1, 2, 3, 0x3c00}));
  EXPECT_EQ(texel<float>(read_bytes(bytes, "depth").image, 1, 1), (Floats{9, 9, 9, 1}));
  EXPECT_EQ(texel<std::uint16_t>(read_bytes(bytes, "id").image, 1, 1), (Halves{7, 8, 0, 0x3c00}));
  EXPECT_EQ(read_bytes(bytes).channel_names.size(), 6u);
  EXPECT_THROW(read_bytes(bytes, "normal"), Error);
}

TEST(ReadExr, NanAndInfinityAreRefusedWithTheirPlace) {
  const auto bad = [](float value) {
    return exr({0, 0, 4, 3}, {float_channel("B", 0),
                              {"G", ExrType::float32, [=](int x, int y) { return raw(x >= 2 && y >= 1 ? value : 1.0f); }},
                              float_channel("R", 0)});
  };
  const auto half = [](std::uint16_t bits) { return exr({0, 0, 1, 1}, {half_channel("Y", bits)}); };
  EXPECT_THAT(refusal(bad(std::nanf(""))), HasSubstr("a.exr': NaN at x 2, y 1 (from the top), channel 'G'"));
  EXPECT_THAT(refusal(bad(-INFINITY)), HasSubstr("infinity at x 2, y 1"));
  EXPECT_THAT(refusal(half(0xfc00)), HasSubstr("infinity at x 0, y 0 (from the top), channel 'Y'"));
  EXPECT_THAT(refusal(half(0x7c01)), HasSubstr("NaN at x 0, y 0"));
}

TEST(ReadExr, NanInAChannelThatIsNotReadDoesNotMatter) {
  const std::string bytes = exr({0, 0, 1, 1}, {half_channel("R", 1), half_channel("Z", 0x7c01)});
  EXPECT_EQ(texel<std::uint16_t>(read_bytes(bytes).image, 0, 0)[0], 1);
}

Picture read_depth(const std::string& bytes, Content content = Content::depth) {
  const TemporaryFolder folder;
  put(folder / "a.exr", bytes);
  return read(folder / "a.exr", {}, content);
}

TEST(ReadExr, ADepthBesideColoursIsTaken) {
  const std::string bytes = exr({0, 0, 2, 2}, {half_channel("A", 0x3c00), half_channel("B", 3), half_channel("G", 2), half_channel("R", 1),
                                               float_channel("Z", 70000)});
  const Picture p = read_depth(bytes);
  EXPECT_EQ(texel<float>(p.image, 1, 1), (Floats{70000, 70000, 70000, 1}));
  EXPECT_EQ(p.taken, "Z");
  EXPECT_THAT(p.remarks, ElementsAre("channel Z of R G B A Z is taken"));
  EXPECT_EQ(read_bytes(bytes).taken, "");
  EXPECT_THAT(read_bytes(bytes).remarks, ElementsAre());
}

TEST(ReadExr, ADepthMayBeInfiniteAndAColourMayNot) {
  for (const std::string& bytes : {exr({0, 0, 1, 1}, {half_channel("Z", 0x7c00)}), exr({0, 0, 1, 1}, {float_channel("Z", INFINITY)})}) {
    EXPECT_NO_THROW(read_depth(bytes));
    EXPECT_THROW(read_bytes(bytes), Error);
    EXPECT_THROW(read_depth(bytes, Content::quantity), Error);
  }
  EXPECT_THROW(read_depth(exr({0, 0, 1, 1}, {half_channel("Z", 0xfc00)})), Error);
  EXPECT_THROW(read_depth(exr({0, 0, 1, 1}, {half_channel("Z", 0x7c01)})), Error);
}

TEST(ReadExr, UnlikeChannelsAreNoQuantity) {
  const ExrChannel green{"G", ExrType::float32, [](int x, int y) { return raw(x == 2 && y == 1 ? 3.0f : 2.0f); }};
  const std::string bytes = exr({0, 0, 4, 3}, {float_channel("A", 9), float_channel("B", 2), green, float_channel("R", 2)});
  for (const Content content : {Content::depth, Content::quantity}) {
    EXPECT_THAT(
        error_of([&] { read_depth(bytes, content); }),
        testing::MatchesRegex("2 .*a.exr': expected one quantity, found R 2 beside G 3 at x 2, y 1 .from the top.; save one channel "
                              "alone, or a depth as channel Z"));
  }
  // Alike they are one, whatever alpha says.
  const Picture grey =
      read_depth(exr({0, 0, 1, 1}, {float_channel("A", 9), float_channel("B", 2), float_channel("G", 2), float_channel("R", 2)}));
  EXPECT_EQ(texel<float>(grey.image, 0, 0), (Floats{2, 2, 2, 9}));
  EXPECT_EQ(grey.taken, "R");
  EXPECT_THAT(grey.remarks, ElementsAre());
  EXPECT_EQ(texel<float>(read_depth(exr({0, 0, 1, 1}, {float_channel("G", 2)})).image, 0, 0)[0], 2);
}

TEST(ReadExr, IntegersCropsAndOverscanAreRefused) {
  EXPECT_THAT(refusal(exr({0, 0, 1, 1}, {{"R", ExrType::uint, [](int, int) { return raw(1u); }}})),
              HasSubstr("channel 'R' is of type uint"));
  EXPECT_THAT(refusal(exr({1, 0, 2, 2}, {half_channel("Y", 1)}, ExrWindow{0, 0, 4, 4})),
              HasSubstr("data window 2x2+1+0 differs from display window 4x4+0+0"));
  // Both windows at the same place: only their origin is unusual.
  EXPECT_EQ(read_bytes(exr({-3, 10, 2, 2}, {half_channel("Y", 1)})).image.width(), 2);
}

TEST(ReadExr, ASizeBeyondMeasureIsRefusedNotAllocated) {
  const std::string small = exr({0, 0, 1, 1}, {half_channel("Y", 1)});
  const std::size_t at = small.find("box2i") + 10, display = small.find("box2i", at) + 10;
  for (const auto& [width, height] : {std::pair{100000, 1}, {1, 100000}, {65536, 65536}, {0x7fffffff, 0x7fffffff}, {0, 5}, {-5, 5}}) {
    std::string bytes = small;
    bytes.replace(at + 8, 8, little(width - 1) + little(height - 1));
    bytes.replace(display + 8, 8, little(width - 1) + little(height - 1));
    EXPECT_NE(refusal(bytes), "none") << width << "x" << height;
  }
}

}  // namespace
}  // namespace rainref::image_io
