// DDS files of ports are read in every format and layout that fits; others are refused.
#include "port_dump/dds.h"

#include "port_dump/support.h"

namespace rainref::port_dump {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Result {
  std::string level;  // or the refusal
  std::vector<std::string> notes;
};
Result read(const std::string& bytes, const capture::Array& expected) {
  Dump dump;
  dump.file("out.b.dds", bytes);
  const std::string refusal = dump.refusal(expected);
  if (refusal != "accepted") return {refusal, {}};
  Dump again;
  again.file("out.b.dds", bytes);
  const std::string level = again.level(expected);
  return {level, again.notes()};
}

TEST(Dds, EveryFormat) {
  struct Case {
    std::uint32_t dxgi;
    Format format;
  };
  const std::string texel = "0123456789abcdef";
  for (const Case& c : {Case{2, Format::rgba32f},
                        {10, Format::rgba16f},
                        {16, Format::rg32f},
                        {28, Format::rgba8},
                        {29, Format::rgba8_srgb},
                        {34, Format::rg16f},
                        {40, Format::r32f},
                        {41, Format::r32f},
                        {42, Format::r32ui},
                        {49, Format::rg8},
                        {54, Format::r16f},
                        {61, Format::r8},
                        {1, Format::rgba32f},
                        {9, Format::rgba16f},
                        {27, Format::rgba8_srgb},
                        {27, Format::rgba8}}) {
    const std::string data = texel.substr(0, info(c.format).texel_bytes()) + texel.substr(16 - info(c.format).texel_bytes());
    const Result r = read(DdsFile{.width = 1, .height = 2, .dxgi = c.dxgi}.with(data), image(c.format, 1, 2));
    EXPECT_EQ(r.level, data) << c.dxgi;
    EXPECT_THAT(r.notes, IsEmpty()) << c.dxgi;
  }
}

TEST(Dds, BlueFirst) {
  EXPECT_EQ(read(DdsFile{.dxgi = 87}.with("bgra"), image(Format::rgba8, 1, 1)).level, "rgba");
  EXPECT_EQ(read(DdsFile{.dxgi = 91}.with("bgra"), image(Format::rgba8_srgb, 1, 1)).level, "rgba");
  EXPECT_THAT(read(DdsFile{.dxgi = 88}.with("bgrx"), image(Format::rgba8, 1, 1)).level, HasSubstr("expected 4 channels of rgba8, found 3"));
  EXPECT_EQ(read(DdsFile{.width = 2, .dxgi = 88}.with("bgrxBGRX"), image(Format::rg8, 2, 1)).level, "rgRG");
}

TEST(Dds, OlderPixelFormats) {
  const std::string texel = "0123456789abcdef";
  const std::vector<Format> floats{Format::r16f, Format::rg16f, Format::rgba16f, Format::r32f, Format::rg32f, Format::rgba32f};
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::string data = texel.substr(0, info(floats[i]).texel_bytes());
    EXPECT_EQ(read(DdsFile{.code = 111 + i}.with(data), image(floats[i], 1, 1)).level, data);
  }
  const DdsFile rgba{.pixel_flags = 0x41, .code = 0, .bits = 32, .masks = {0xff, 0xff00, 0xff0000, 0xff000000}};
  const DdsFile bgra{.pixel_flags = 0x41, .code = 0, .bits = 32, .masks = {0xff0000, 0xff00, 0xff, 0xff000000}};
  const DdsFile grey{.pixel_flags = 0x20000, .code = 0, .bits = 8, .masks = {0xff, 0, 0, 0}};
  EXPECT_EQ(read(rgba.with("rgba"), image(Format::rgba8, 1, 1)).level, "rgba");
  EXPECT_EQ(read(bgra.with("bgra"), image(Format::rgba8, 1, 1)).level, "rgba");
  EXPECT_EQ(read(grey.with("r"), image(Format::r8, 1, 1)).level, "r");
}

TEST(Dds, EncodingIsALabel) {
  const Result r = read(DdsFile{.dxgi = 29}.with("rgba"), image(Format::rgba8, 1, 1));
  EXPECT_EQ(r.level, "rgba");
  EXPECT_THAT(r.notes, ElementsAre(HasSubstr("R8G8B8A8_UNORM_SRGB, the buffer is rgba8: the codes are taken as they are")));
  EXPECT_THAT(read(DdsFile{.dxgi = 28}.with("rgba"), image(Format::rgba8_srgb, 1, 1)).notes,
              ElementsAre(HasSubstr("R8G8B8A8_UNORM, the buffer is rgba8_srgb")));
}

TEST(Dds, MipLevels) {
  const std::string data = std::string(15, 'a') + "bb" + "c";
  const DdsFile chain{.width = 5, .height = 3, .levels = 3, .dxgi = 61};
  Dump dump;
  dump.file("out.b.dds", chain.with(data));
  EXPECT_EQ(dump.level(image(Format::r8, 5, 3, 3), {}, 1), "bb");
  EXPECT_EQ(dump.level(image(Format::r8, 5, 3, 3), {}, 2), "c");
  EXPECT_THAT(dump.notes(), IsEmpty());
  EXPECT_EQ(dump.level(image(Format::r8, 5, 3, 2), {}, 1), "bb");
  EXPECT_THAT(dump.notes(), ElementsAre(HasSubstr("3 mip levels, 2 read")));
  EXPECT_THAT(dump.refusal(image(Format::r8, 5, 3, 4)), HasSubstr("expected 4 mip levels, found 3"));
  // One file a level.
  dump.file("out.b.dds", DdsFile{.width = 5, .height = 3, .dxgi = 61}.with(std::string(15, 'x')));
  dump.file("out.b.L1.dds", DdsFile{.width = 2, .height = 1, .dxgi = 61}.with("yz"));
  EXPECT_EQ(dump.level(image(Format::r8, 5, 3, 2), {}, 1), "yz");
}

TEST(Dds, LevelsTurnOverOneByOne) {
  PortInfo port;
  port.origin = Origin::bottom_left;
  Dump dump;
  dump.file("out.b.dds", DdsFile{.width = 2, .height = 4, .levels = 2, .dxgi = 61}.with("aabbccddxy"));
  EXPECT_EQ(dump.level(image(Format::r8, 2, 4, 2), port), "ddccbbaa");
  EXPECT_EQ(dump.level(image(Format::r8, 2, 4, 2), port, 1), "yx");
}

TEST(Dds, APaddedPitchIsTakenWhereTheLengthProvesIt) {
  const DdsFile padded{.width = 3, .height = 2, .dxgi = 61, .flags = 0x1007 | 0x8, .pitch = 4};
  EXPECT_EQ(read(padded.with("abc_def_"), image(Format::r8, 3, 2)).level, "abcdef");
  // Some writers state a padded pitch and store tight rows.
  EXPECT_EQ(read(padded.with("abcdef"), image(Format::r8, 3, 2)).level, "abcdef");
  EXPECT_THAT(read(padded.with("abc_def"), image(Format::r8, 3, 2)).level, HasSubstr("bytes too many"));
}

TEST(Dds, Refusals) {
  const capture::Array r8 = image(Format::r8, 1, 1);
  const auto why = [&](const DdsFile& file, const std::string& data = "x") { return read(file.with(data), r8).level; };
  EXPECT_THAT(why({.dxgi = 71}), HasSubstr("block compression (BC) is lossy"));
  EXPECT_THAT(why({.dxgi = 98}), HasSubstr("block compression (BC) is lossy"));
  EXPECT_THAT(why({.code = 0x31545844}), HasSubstr("'DXT1': block compression is lossy"));
  EXPECT_THAT(why({.dxgi = 26}), HasSubstr("DXGI format 26"));
  EXPECT_THAT(why({.code = 36}), HasSubstr("export with a DX10 header"));
  EXPECT_THAT(why({.dxgi = 61, .dimension = 2}), HasSubstr("expected a two-dimensional texture"));
  EXPECT_THAT(why({.dxgi = 61, .misc = 4}), HasSubstr("a cube"));
  EXPECT_THAT(why({.dxgi = 61, .array_size = 6}), HasSubstr("an array of 6 textures"));
  EXPECT_THAT(why({.dxgi = 61, .caps2 = 0x200}), HasSubstr("a cube"));
  EXPECT_THAT(why({.dxgi = 61, .caps2 = 0x200000}), HasSubstr("a volume"));
  EXPECT_THAT(why({.width = 0, .dxgi = 61}), HasSubstr("size 0x1"));
  EXPECT_THAT(why({.width = 0xffffffff, .height = 0xffffffff, .dxgi = 2}), HasSubstr("each side must be from 1 to 65536"));
  EXPECT_THAT(why({.width = 65536, .height = 65536, .dxgi = 2}), HasSubstr("needs 68719476736 bytes behind the header, found 1"));
  EXPECT_THAT(why({.levels = 0xffffffff, .dxgi = 61}), HasSubstr("4294967295 mip levels"));
  EXPECT_THAT(why({.dxgi = 61}, ""), HasSubstr("truncated"));
  EXPECT_THAT(why({.dxgi = 61}, "xy"), HasSubstr("bytes too many"));
  EXPECT_THAT(why({.dxgi = 41}, "four"), HasSubstr("expected r8 as 8-bit codes, found floats"));
  EXPECT_THAT(read("DDS ", r8).level, HasSubstr("truncated in its DDS header"));
  EXPECT_THAT(read("", r8).level, HasSubstr("empty file"));
  EXPECT_THAT(read("BM", r8).level, HasSubstr("not a DDS file"));
  EXPECT_THAT(read(DdsFile{.dxgi = 61}.with("x").replace(4, 1, "\x7d"), r8).level, HasSubstr("DDS header is not 124"));
  EXPECT_THAT(read(DdsFile{.dxgi = 61}.with("x").replace(76, 1, "\x7d"), r8).level, HasSubstr("pixel format is not 32"));
}

TEST(Dds, EveryTruncationIsRefused) {
  const std::string whole = DdsFile{.width = 5, .height = 3, .levels = 2, .dxgi = 54}.with(std::string(34, 'x'));
  const capture::Array expected = image(Format::r16f, 5, 3, 2);
  ASSERT_EQ(read(whole, expected).level, std::string(30, 'x'));
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THAT(read(whole.substr(0, size), expected).level, HasSubstr("out.b.dds'")) << size;
}

}  // namespace
}  // namespace rainref::port_dump
