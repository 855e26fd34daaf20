// A port's .npy is taken where its type and shape are the buffer's, with its bits kept.
#include <bit>
#include <limits>

#include "math/half.h"
#include "port_dump/support.h"

namespace rainref::port_dump {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string bytes24 = "abcdefghijklmnopqrstuvwx";

TEST(NpyBuffer, EveryFormatKeepsItsBytes) {
  struct Case {
    Format format;
    const char *descr, *shape;
    int width, height;
  };
  for (const Case& c : {Case{Format::r8, "'|u1'", "(4, 6)", 6, 4},
                        {Format::rg8, "'|u1'", "(4, 3, 2)", 3, 4},
                        {Format::rgba8, "'|u1'", "(2, 3, 4)", 3, 2},
                        {Format::rgba8_srgb, "'|u1'", "(2, 3, 4)", 3, 2},
                        {Format::r16f, "'<f2'", "(4, 3, 1)", 3, 4},
                        {Format::rg16f, "'<f2'", "(2, 3, 2)", 3, 2},
                        {Format::rgba16f, "'<f2'", "(1, 3, 4)", 3, 1},
                        {Format::r32f, "'<f4'", "(2, 3)", 3, 2},
                        {Format::rg32f, "'<f4'", "(1, 3, 2)", 3, 1},
                        {Format::r32ui, "'<u4'", "(2, 3)", 3, 2}}) {
    Dump dump;
    dump.file("out.b.npy", npy(c.descr, c.shape, bytes24));
    EXPECT_EQ(dump.level(image(c.format, c.width, c.height)), bytes24) << info(c.format).name;
    EXPECT_THAT(dump.notes(), IsEmpty());
  }
  Dump dump;
  dump.file("out.b.npy", npy("'<f4'", "(1, 1, 4)", bytes24.substr(0, 16)));
  const capture::Array array = dump.read(image(Format::rgba32f, 1, 1));
  EXPECT_EQ(array.width, 1);
  EXPECT_EQ(array.format, Format::rgba32f);
  EXPECT_EQ(array.levels[0].size(), 16u);
}

TEST(NpyBuffer, NanAndInfinityAreKept) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const std::string data = values<float>({infinity, -infinity, std::bit_cast<float>(0x7fc00123u), -0.0f});
  Dump dump;
  dump.file("out.b.npy", npy("'<f4'", "(2, 2)", data));
  EXPECT_EQ(dump.level(image(Format::r32f, 2, 2)), data);
  // The same as halves: 0x7c00, 0xfc00, a NaN, -0.
  EXPECT_EQ(dump.level(image(Format::r16f, 2, 2)), values<std::uint16_t>({0x7c00, 0xfc00, 0x7e00, 0x8000}));
}

TEST(NpyBuffer, RowsComeOutByOrigin) {
  const std::string rows = "aabbcc";
  PortInfo bottom_left;
  bottom_left.origin = Origin::bottom_left;
  Dump dump;
  dump.file("out.b.npy", npy("'|u1'", "(3, 2)", rows));
  EXPECT_EQ(dump.level(image(Format::r8, 2, 3)), "aabbcc");
  EXPECT_EQ(dump.level(image(Format::r8, 2, 3), bottom_left), "ccbbaa");
}

TEST(NpyBuffer, MipLevelsAreFiles) {
  Dump dump;
  dump.file("out.b.npy", npy("'|u1'", "(3, 5)", std::string(15, 'a')));
  dump.file("out.b.L1.npy", npy("'|u1'", "(1, 2)", "bb"));
  dump.file("out.b.L2.npy", npy("'|u1'", "(1, 1)", "c"));
  const capture::Array expected = image(Format::r8, 5, 3, 3);
  EXPECT_EQ(dump.level(expected, {}, 1), "bb");
  EXPECT_EQ(dump.level(expected, {}, 2), "c");
  EXPECT_THAT(dump.refusal(image(Format::r8, 5, 3, 4)), HasSubstr("no 'out.b.L3' as .npy"));
  dump.file("out.b.L1.npy", npy("'|u1'", "(2, 1)", "bb"));
  EXPECT_THAT(dump.refusal(expected), AllOf(HasSubstr("out.b.L1.npy': expected 2x1 texels, found 1x2"), HasSubstr("exchanged")));
}

TEST(NpyBuffer, AFloatIsTakenForTheHalfThatItEquals) {
  std::vector<float> floats;
  std::vector<std::uint16_t> halves;
  for (std::uint32_t code = 0; code < 65536; ++code) {
    if ((code & 0x7fff) > 0x7c00) continue;  // NaN
    halves.push_back(static_cast<std::uint16_t>(code));
    floats.push_back(to_float(Half{halves.back()}));
  }
  ASSERT_EQ(floats.size(), 2u * 31745);
  Dump dump;
  dump.file("out.b.npy", npy("'<f4'", "(2, 31745)", values(floats)));
  EXPECT_EQ(dump.level(image(Format::r16f, 31745, 2)), values(halves));
}

TEST(NpyBuffer, AFloatThatIsNoHalfIsRefused) {
  // One ulp off, a tie, beyond the largest half, below the smallest: each would have to be rounded.
  for (const float value : {0x1.000002p0f, 0x1.002p0f, 65520.0f, 0x1p-25f, 0.1f}) {
    Dump dump;
    dump.file("out.b.npy", npy("'<f4'", "(2, 2)", values<float>({1, 2, value, 4})));
    EXPECT_THAT(dump.refusal(image(Format::r16f, 2, 2)), AllOf(HasSubstr("texel x 0, y 1, channel r is"), HasSubstr("no half equals")));
  }
}

TEST(NpyBuffer, OtherTypesAreRefused) {
  const auto refusal = [](const std::string& descr, int bytes, Format format) {
    Dump dump;
    dump.file("out.b.npy", npy(descr, "(2, 2)", std::string(4 * bytes, '\0')));
    return dump.refusal(image(format, 2, 2));
  };
  EXPECT_THAT(refusal("'<f2'", 2, Format::r32f), HasSubstr("expected r32f as floats, found halves: the exporter has rounded"));
  EXPECT_THAT(refusal("'|u1'", 1, Format::r32f), HasSubstr("found 8-bit codes: the exporter has quantized"));
  EXPECT_THAT(refusal("'|u1'", 1, Format::r16f), HasSubstr("found 8-bit codes"));
  EXPECT_THAT(refusal("'<f4'", 4, Format::r8), HasSubstr("expected r8 as 8-bit codes, found floats"));
  EXPECT_THAT(refusal("'<u4'", 4, Format::r32f), HasSubstr("found 32-bit unsigned integers"));
  EXPECT_THAT(refusal("'<f4'", 4, Format::r32ui), HasSubstr("expected r32ui as 32-bit unsigned integers, found floats"));
  EXPECT_THAT(refusal("'<f8'", 8, Format::r32f), HasSubstr("found '<f8'"));
  EXPECT_THAT(refusal("[('x', '<f4')]", 4, Format::r32f), HasSubstr("records; an image was expected"));
  // A sampler or a writer that decodes sRGB changes codes.
  EXPECT_THAT(Dump().file("out.b.npy", npy("'<f4'", "(1, 1, 4)", std::string(16, '\0'))).refusal(image(Format::rgba8_srgb, 1, 1)),
              HasSubstr("a copy of the codes in another type has been converted"));
}

TEST(NpyBuffer, OtherShapesAreRefused) {
  const auto refusal = [](const std::string& shape, int count, Format format) {
    Dump dump;
    dump.file("out.b.npy", npy("'|u1'", shape, std::string(count, 'x')));
    return dump.refusal(image(format, 3, 2));
  };
  EXPECT_THAT(refusal("(6,)", 6, Format::r8), HasSubstr("expected a shape of (height, width)"));
  EXPECT_THAT(refusal("()", 1, Format::r8), HasSubstr("found ()"));
  EXPECT_THAT(refusal("(1, 2, 3, 1)", 6, Format::r8), HasSubstr("found (1, 2, 3, 1)"));
  EXPECT_THAT(refusal("(2, 3, 5)", 30, Format::r8), HasSubstr("channels up to 4"));
  EXPECT_THAT(refusal("(2, 3, 0)", 0, Format::r8), HasSubstr("channels up to 4"));
  EXPECT_THAT(refusal("(0, 0)", 0, Format::r8), HasSubstr("expected 3x2 texels, found 0x0"));
  EXPECT_THAT(refusal("(3, 2)", 6, Format::r8), HasSubstr("expected 3x2 texels, found 2x3; width and height are exchanged"));
  EXPECT_THAT(refusal("(2, 3, 3)", 18, Format::rgba8), HasSubstr("expected 4 channels of rgba8, found 3"));
}

TEST(NpyBuffer, ExtraChannelsAreNamed) {
  Dump dump;
  dump.file("out.b.npy", npy("'|u1'", "(1, 2, 4)", "rgbaRGBA"));
  EXPECT_EQ(dump.level(image(Format::rg8, 2, 1)), "rgRG");
  EXPECT_THAT(dump.notes(), ElementsAre(HasSubstr("4 channels, the buffer has 2: ba not read")));
}

TEST(NpyBuffer, AFileLongerThanAnyLayoutIsRefusedUnread) {
  Dump dump;
  dump.file("out.b.npy", "");
  std::filesystem::resize_file(dump.path() / "out.b.npy", std::uintmax_t{1} << 36);  // a hole of 64 GiB
  EXPECT_THAT(dump.refusal(image(Format::r8, 2, 2)), HasSubstr("68719476736 bytes are too many for 2x2 texels of r8"));
}

}  // namespace
}  // namespace rainref::port_dump
