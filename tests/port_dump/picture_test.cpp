// EXR and PNG files of ports keep their codes; what would convert or claim too much is refused.
#include <bit>
#include <limits>

#include "image/images.h"
#include "image_io/evidence.h"
#include "image_io/write.h"
#include "port_dump/support.h"
#include "source_folder.h"

namespace rainref::port_dump {
namespace {

using image_io::exr;
using image_io::ExrChannel;
using image_io::ExrType;
using image_io::png;
using image_io::png_chunk;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ExrChannel halves(const std::string& name, int first) {
  return {name, ExrType::half, [=](int x, int y) { return raw(static_cast<std::uint16_t>(first + 16 * y + x)); }};
}
ExrChannel floats(const std::string& name, float first) {
  return {name, ExrType::float32, [=](int x, int y) { return raw(first + 16 * static_cast<float>(y) + static_cast<float>(x)); }};
}
std::string read(const std::string& extension, const std::string& bytes, const capture::Array& expected) {
  Dump dump;
  dump.file("out.b." + extension, bytes);
  const std::string refusal = dump.refusal(expected);
  return refusal == "accepted" ? dump.level(expected) : refusal;
}

TEST(ExrDump, HalvesOfEveryCode) {
  // 256 x 256 texels: all 65 536 codes, NaN and infinity among them.
  const ExrChannel all{"R", ExrType::half, [](int x, int y) { return raw(static_cast<std::uint16_t>(256 * y + x)); }};
  std::string expected;
  for (int i = 0; i < 65536; ++i) expected += raw(static_cast<std::uint16_t>(i));
  EXPECT_EQ(read("exr", exr({0, 0, 256, 256}, {all}), image(Format::r16f, 256, 256)), expected);
}

TEST(ExrDump, ChannelsByName) {
  const auto texel = [](int r, int g, int b, int a) {
    return values<std::uint16_t>({std::uint16_t(r), std::uint16_t(g), std::uint16_t(b), std::uint16_t(a)});
  };
  const capture::Array rgba = image(Format::rgba16f, 1, 1), rg = image(Format::rg16f, 1, 1), r = image(Format::r16f, 1, 1);
  EXPECT_EQ(read("exr", exr({0, 0, 1, 1}, {halves("A", 4), halves("B", 3), halves("G", 2), halves("R", 1)}), rgba), texel(1, 2, 3, 4));
  EXPECT_EQ(read("exr", exr({0, 0, 1, 1}, {halves("W", 4), halves("X", 1), halves("Y", 2), halves("Z", 3)}), rgba), texel(1, 2, 3, 4));
  EXPECT_EQ(read("exr", exr({0, 0, 1, 1}, {halves("a.A", 4), halves("a.B", 3), halves("a.G", 2), halves("a.R", 1)}), rgba),
            texel(1, 2, 3, 4));
  EXPECT_EQ(read("exr", exr({0, 0, 1, 1}, {halves("U", 1), halves("V", 2)}), rg), texel(1, 2, 0, 0).substr(0, 4));
  EXPECT_EQ(read("exr", exr({0, 0, 1, 1}, {halves("A", 2), halves("Y", 1)}), rg), texel(1, 2, 0, 0).substr(0, 4));
  EXPECT_EQ(read("exr", exr({0, 0, 1, 1}, {halves("height", 1)}), r), texel(1, 0, 0, 0).substr(0, 2));
  EXPECT_EQ(read("exr", exr({0, 0, 1, 1}, {halves("Y", 1)}), r), texel(1, 0, 0, 0).substr(0, 2));
  EXPECT_THAT(read("exr", exr({0, 0, 1, 1}, {halves("height", 1), halves("velocity", 1)}), rg),
              HasSubstr("the order of channels height velocity cannot be told"));
  EXPECT_THAT(read("exr", exr({0, 0, 1, 1}, {halves("G", 2), halves("n.X", 1)}), rg), HasSubstr("several layers: G n.X"));
  EXPECT_THAT(read("exr", exr({0, 0, 1, 1}, {halves("A", 4), halves("B", 3), halves("G", 2), halves("R", 1), halves("Z", 1)}), rgba),
              HasSubstr("5 channels; expected 1 to 4"));
  EXPECT_THAT(read("exr", exr({0, 0, 1, 1}, {halves("B", 3), halves("G", 2), halves("R", 1)}), rgba),
              HasSubstr("expected 4 channels of rgba16f, found 3"));
}

// RenderDoc's EXR holds A, B, G and R whatever the target has, and devices without storage textures of one channel store four: halves of
// what has up to 2 bytes a component, else floats.
TEST(ExrDump, FourChannelsOfABufferOfLess) {
  const std::vector<ExrChannel> rgba{halves("A", 4), halves("B", 3), halves("G", 2), halves("R", 1)};
  Dump dump;
  dump.file("out.b.exr", exr({0, 0, 2, 1}, rgba));
  EXPECT_EQ(dump.level(image(Format::rg16f, 2, 1)), values<std::uint16_t>({1, 2, 2, 3}));
  EXPECT_THAT(dump.notes(), ElementsAre(HasSubstr("4 channels, the buffer has 2: ba not read")));
  EXPECT_EQ(read("exr", exr({0, 0, 2, 1}, {floats("A", 4), floats("B", 3), floats("G", 2), floats("R", 1)}), image(Format::r32f, 2, 1)),
            values<float>({1, 2}));
  EXPECT_THAT(dump.refusal(image(Format::rgba32f, 2, 1)),
              HasSubstr("expected rgba32f as floats, found halves: the exporter has rounded; export floats"));
  EXPECT_THAT(dump.refusal(image(Format::rgba8, 2, 1)), HasSubstr("expected rgba8 as 8-bit codes, found halves"));
}

TEST(ExrDump, FloatsAndIntegers) {
  const ExrChannel odd{"R", ExrType::float32,
                       [](int x, int) { return raw(x == 0 ? std::numeric_limits<float>::infinity() : std::bit_cast<float>(0xffc12345u)); }};
  EXPECT_EQ(read("exr", exr({0, 0, 2, 1}, {odd}), image(Format::r32f, 2, 1)), values<std::uint32_t>({0x7f800000u, 0xffc12345u}));
  const ExrChannel ids{"id", ExrType::uint, [](int x, int) { return raw(0xfffffffeu + x); }};
  EXPECT_EQ(read("exr", exr({0, 0, 2, 1}, {ids}), image(Format::r32ui, 2, 1)), values<std::uint32_t>({0xfffffffeu, 0xffffffffu}));
  EXPECT_THAT(read("exr", exr({0, 0, 2, 1}, {ids}), image(Format::r32f, 2, 1)), HasSubstr("found 32-bit unsigned integers"));
  // A float file of a half buffer: exact or refused.
  EXPECT_EQ(read("exr", exr({0, 0, 2, 2}, {floats("R", 1)}), image(Format::r16f, 2, 2)),
            values<std::uint16_t>({0x3c00, 0x4000, 0x4c40, 0x4c80}));
  EXPECT_THAT(read("exr", exr({0, 0, 2, 2}, {floats("R", .1f)}), image(Format::r16f, 2, 2)),
              HasSubstr("texel x 0, y 0, channel r is 0.1 (0x3dcccccd), which no half equals"));
  // Both in one file, as some exporters store alpha.
  EXPECT_EQ(read("exr", exr({0, 0, 1, 1}, {halves("G", 0x3c01), floats("R", 2)}), image(Format::rg16f, 1, 1)),
            values<std::uint16_t>({0x4000, 0x3c01}));
}

TEST(ExrDump, RowsAsInTheFile) {
  PortInfo port;
  Dump dump;
  dump.file("out.b.exr", exr({0, 0, 1, 3}, {halves("R", 0)}));
  EXPECT_EQ(dump.level(image(Format::r16f, 1, 3), port), values<std::uint16_t>({0, 16, 32}));
  port.origin = Origin::bottom_left;
  EXPECT_EQ(dump.level(image(Format::r16f, 1, 3), port), values<std::uint16_t>({32, 16, 0}));
  // A window away from the origin moves no texel as long as both windows agree.
  dump.file("out.b.exr", exr({-5, 7, 1, 3}, {halves("R", 0)}));
  EXPECT_EQ(dump.level(image(Format::r16f, 1, 3)), values<std::uint16_t>({0, 16, 32}));
}

TEST(ExrDump, OurOwnWriter) {
  const Image in =
      make_image(Format::rgba16f, 33, 17, [](int x, int y, int c) { return Half{static_cast<std::uint16_t>(1000 * y + 10 * x + c)}; });
  Dump dump;
  image_io::write_exr(dump.path() / "out.b.exr", {{"", {"R", "G", "B", "A"}, &in}});
  EXPECT_EQ(dump.level(image(Format::rgba16f, 33, 17)), bytes_of(in));
  EXPECT_THAT(dump.notes(), IsEmpty());
}

TEST(ExrDump, EveryLosslessCompression) {
  std::vector<std::uint16_t> expected;
  for (int y = 0; y < 3; ++y) {
    for (int i = 0; i < 20; ++i) expected.push_back(static_cast<std::uint16_t>(0x3c01 + 100 * y + i / 4 + i % 4));
  }
  for (const std::string name : {"none", "rle", "zips", "zip", "piz", "tiled"}) {
    const std::string file = contents(std::filesystem::path(rainref::test::source_folder()) / "tests/fuzz/seeds/exr" / (name + ".exr"));
    ASSERT_NE(file, "");
    EXPECT_EQ(read("exr", file, image(Format::rgba16f, 5, 3)), values(expected)) << name;
  }
}

TEST(ExrDump, Refusals) {
  const capture::Array r16f = image(Format::r16f, 2, 1);
  const std::string good = exr({0, 0, 2, 1}, {halves("R", 0)});
  const std::size_t compression = good.find("compression") + 12 + 12 + 4;  // behind the second name and the size
  ASSERT_EQ(good[compression], '\0');
  for (const int lossy : {5, 6, 7, 8, 9}) {
    EXPECT_THAT(read("exr", std::string(good).replace(compression, 1, 1, static_cast<char>(lossy)), r16f),
                HasSubstr("is lossy: its values are not the buffer's"));
  }
  EXPECT_THAT(read("exr", std::string(good).replace(compression, 1, 1, '\x0b'), r16f), HasSubstr("'unknown'"));
  EXPECT_THAT(read("exr", exr({0, 0, 2, 1}, {halves("R", 0)}, image_io::ExrWindow{0, 0, 4, 4}), r16f),
              HasSubstr("data window differs from its display window"));
  EXPECT_THAT(read("exr", std::string(good).replace(5, 1, "\x08"), r16f), HasSubstr("deep"));
  EXPECT_THAT(read("exr", std::string(good).replace(5, 1, "\x10"), r16f), HasSubstr("several parts"));
  EXPECT_THAT(read("exr", good, image(Format::r16f, 1, 2)), HasSubstr("expected 1x2 texels, found 2x1"));
  EXPECT_THAT(read("exr", exr({0, 0, 2, 1}, {floats("R", 0)}), image(Format::rgba8, 2, 1)), HasSubstr("expected 4 channels of rgba8"));
  EXPECT_THAT(read("exr", exr({0, 0, 2, 1}, {floats("R", 0)}), image(Format::r8, 2, 1)),
              HasSubstr("expected r8 as 8-bit codes, found floats"));
  EXPECT_THAT(read("exr", "", r16f), HasSubstr("empty file"));
  EXPECT_THAT(read("exr", "what", r16f), HasSubstr("not an EXR or PNG file"));
}

TEST(ExrDump, GiganticWindowsAreRefusedBeforeTheLibrarySeesThem) {
  EXPECT_THAT(read("exr", exr({0, 0, 2147483647, 0}, {halves("R", 0)}), image(Format::r16f, 2, 1)), HasSubstr("size 2147483647x0"));
  std::string wide = exr({0, 0, 1, 1}, {halves("R", 0)});
  for (const char* name : {"dataWindow", "displayWindow"})
    wide.replace(wide.find(name) + std::string(name).size() + 1 + 6 + 4 + 8, 4, little(0x7fffffff));
  EXPECT_THAT(read("exr", wide, image(Format::r16f, 1, 1)), HasSubstr("size 2147483648x1"));
}

TEST(ExrDump, AttributesThatClaimMemoryAreRefused) {
  // One more attribute in front of the others; byte 5 holds the flags.
  const auto with = [](const std::string& name, const std::string& type, const std::string& value, char flags = 0) {
    std::string out = exr({0, 0, 2, 1}, {halves("R", 0)});
    out[5] = flags;
    return out.insert(8, name + '\0' + type + '\0' + little(static_cast<std::uint32_t>(value.size())) + value);
  };
  const capture::Array r16f = image(Format::r16f, 2, 1);
  EXPECT_THAT(read("exr", with("tiles", "tiledesc", little(0x8000) + little(0x8000) + '\0', 2), r16f),
              HasSubstr("tiles of 32768x32768; expected at most 2048"));
  EXPECT_THAT(read("exr", with("tiles", "tiledesc", little(8) + little(8) + '\1', 2), r16f),
              HasSubstr("mip levels in one EXR; save one file a level"));
  EXPECT_THAT(read("exr", with("preview", "preview", little(0xffff) + little(0xffff)), r16f), HasSubstr("an attribute of type preview"));
  EXPECT_THAT(read("exr", with("ids", "idmanifest", little(1)), r16f), HasSubstr("an attribute of type idmanifest"));
  // Others are nobody's business. (The texels cannot be read: their offsets do not know of the insertion.)
  const std::string comment = with("comment", "string", "hello");
  EXPECT_EQ(image_io::evidence_size("'a'", std::as_bytes(std::span(comment))).width, 2u);
}

TEST(ExrDump, EveryTruncationIsRefused) {
  const std::string whole = exr({0, 0, 3, 2}, {halves("G", 0), halves("R", 7)});
  ASSERT_EQ(read("exr", whole, image(Format::rg16f, 3, 2)).size(), 24u);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THAT(read("exr", whole.substr(0, size), image(Format::rg16f, 3, 2)), HasSubstr("out.b.exr'")) << size;
}

TEST(PngDump, CodesKeepTheirValues) {
  std::string all;
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  EXPECT_EQ(read("png", png(256, 1, 8, 0, {all}), image(Format::r8, 256, 1)), all);
  EXPECT_EQ(read("png", png(128, 1, 8, 4, {all}), image(Format::rg8, 128, 1)), all);
  EXPECT_EQ(read("png", png(64, 1, 8, 6, {all}), image(Format::rgba8, 64, 1)), all);  // alpha multiplies nothing
  EXPECT_EQ(read("png", png(64, 1, 8, 6, {all}), image(Format::rgba8_srgb, 64, 1)), all);
}

TEST(PngDump, ColourChunksConvertNothing) {
  std::string all;
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  const std::string gamma = png_chunk("gAMA", image_io::big(100000)), srgb = png_chunk("sRGB", std::string(1, '\0')),
                    primaries =
                        png_chunk("cHRM", image_io::big(31270) + image_io::big(32900) + image_io::big(64000) + image_io::big(33000) +
                                              image_io::big(30000) + image_io::big(60000) + image_io::big(15000) + image_io::big(6000));
  for (const std::string& chunk : {gamma, srgb, gamma + primaries, primaries + srgb}) {
    EXPECT_EQ(read("png", png(64, 1, 8, 6, {all}, chunk), image(Format::rgba8, 64, 1)), all);
    EXPECT_EQ(read("png", png(64, 1, 8, 6, {all}, chunk), image(Format::rgba8_srgb, 64, 1)), all);
  }
}

TEST(PngDump, OurOwnWriter) {
  const Image in =
      make_image(Format::rgba8_srgb, 9, 5, [](int x, int y, int c) { return Unorm8{static_cast<std::uint8_t>(50 * y + 5 * x + c)}; });
  Dump dump;
  image_io::write_png(dump.path() / "out.b.png", in, image_io::PngChannels::rgba);
  EXPECT_EQ(dump.level(image(Format::rgba8_srgb, 9, 5)), bytes_of(in));
  image_io::write_png(dump.path() / "out.b.png", in, image_io::PngChannels::rgb);
  EXPECT_THAT(dump.refusal(image(Format::rgba8_srgb, 9, 5)), HasSubstr("expected 4 channels of rgba8_srgb, found 3"));
}

// A screenshot, or an EXR of three channels, of a buffer whose alpha is declared as 1.
TEST(PngDump, ThreeChannelsAreTakenWhereAlphaIsOne) {
  Dump dump;
  dump.file("out.b.png", png(2, 1, 8, 2, {"rgbRGB"}));
  EXPECT_EQ(dump.opaque(image(Format::rgba8, 2, 1)), "rgb\xffRGB\xff");
  EXPECT_THAT(dump.notes(), ElementsAre(HasSubstr("3 channels, the buffer's fourth is 1 everywhere: taken as 1")));
  EXPECT_THAT(dump.refusal(image(Format::rgba8, 2, 1)), HasSubstr("expected 4 channels of rgba8, found 3"));
}
TEST(ExrDump, ThreeChannelsAreTakenWhereAlphaIsOne) {
  const capture::Array half = image(Format::rgba16f, 1, 1);
  EXPECT_EQ(Dump().file("out.b.exr", exr({0, 0, 1, 1}, {halves("B", 3), halves("G", 2), halves("R", 1)})).opaque(half),
            values<std::uint16_t>({1, 2, 3, 0x3c00}));
  EXPECT_EQ(Dump().file("out.b.npy", npy("'<f4'", "(1, 1, 3)", values<float>({1, 2, 3}))).opaque(image(Format::rgba32f, 1, 1)),
            values<float>({1, 2, 3, 1}));
  EXPECT_EQ(Dump().file("out.b.dds", DdsFile{.dxgi = 88}.with("bgrx")).opaque(image(Format::rgba8, 1, 1)), "rgb\xff");
  // Two are too few.
  EXPECT_THAT(error_of([&] {
                Dump().file("out.b.exr", exr({0, 0, 1, 1}, {halves("G", 2), halves("R", 1)})).opaque(half);
              }),
              HasSubstr("expected 4 channels of rgba16f, found 2"));
}

TEST(PngDump, RowsAsInTheFile) {
  PortInfo port;
  port.origin = Origin::bottom_left;
  EXPECT_EQ(Dump().file("out.b.png", png(1, 3, 8, 0, {"c", "b", "a"})).level(image(Format::r8, 1, 3), port), "abc");
}

TEST(PngDump, ExtraChannelsAreNamed) {
  Dump dump;
  dump.file("out.b.png", png(2, 1, 8, 2, {"rgbRGB"}));
  EXPECT_EQ(dump.level(image(Format::r8, 2, 1)), "rR");
  EXPECT_THAT(dump.notes(), ElementsAre(HasSubstr("3 channels, the buffer has 1: gb not read")));
}

TEST(PngDump, Refusals) {
  EXPECT_THAT(read("png", png(1, 1, 16, 0, {"xx"}), image(Format::r8, 1, 1)), HasSubstr("a PNG of 16 bits"));
  EXPECT_THAT(read("png", png(1, 1, 4, 0, {"x"}), image(Format::r8, 1, 1)), HasSubstr("a PNG of 4 bits"));
  EXPECT_THAT(read("png", png(1, 1, 8, 3, {std::string(1, '\0')}, png_chunk("PLTE", "rgb")), image(Format::r8, 1, 1)),
              HasSubstr("palette"));
  EXPECT_THAT(read("png", png(1, 1, 8, 0, {"x"}, png_chunk("tRNS", std::string("\0x", 2))), image(Format::r8, 1, 1)),
              HasSubstr("transparent colour"));
  EXPECT_THAT(read("png", png(1, 1, 8, 0, {"x"}), image(Format::r16f, 1, 1)),
              HasSubstr("a PNG holds 8-bit codes, the buffer is r16f: the exporter has quantized"));
  EXPECT_THAT(read("png", png(1, 1, 8, 0, {"x"}), image(Format::r8, 2, 1)), HasSubstr("expected 2x1 texels, found 1x1"));
  EXPECT_THAT(read("png", png(0x7fffffff, 0x7fffffff, 8, 6, {"x"}), image(Format::rgba8, 2, 1)),
              HasSubstr("each side must be from 1 to 65536"));
  EXPECT_THAT(read("png", image_io::jpeg(1), image(Format::r8, 8, 16)), HasSubstr("its content is JPEG, which is lossy"));
  EXPECT_THAT(read("exr", image_io::hdr(1, 1, {{1, 2, 3, 4}}), image(Format::rgba16f, 1, 1)), HasSubstr("its content is Radiance HDR"));
}

TEST(PngDump, EveryTruncationIsRefused) {
  const std::string whole = png(2, 2, 8, 6, {"rgbargba", "rgbargba"});
  ASSERT_EQ(read("png", whole, image(Format::rgba8, 2, 2)), "rgbargbargbargba");
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THAT(read("png", whole.substr(0, size), image(Format::rgba8, 2, 2)), HasSubstr("out.b.png'")) << size;
}

}  // namespace
}  // namespace rainref::port_dump
