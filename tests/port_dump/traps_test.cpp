// What real exporters do to a buffer on its way into a file (docs/dumps.md names them), and what becomes of it here.
#include "port_dump/support.h"

namespace rainref::port_dump {
namespace {

using image_io::exr;
using image_io::ExrChannel;
using image_io::ExrType;
using image_io::png;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<ExrChannel> rgba(ExrType type) {
  const auto sample = [=](int x, int) {
    return type == ExrType::half ? raw(static_cast<std::uint16_t>(0x3c00 + x)) : raw(1.0f + static_cast<float>(x));
  };
  return {{"A", type, sample}, {"B", type, sample}, {"G", type, sample}, {"R", type, sample}};
}

// RenderDoc before its pull request 1631, and Unity's EncodeToEXR without OutputAsFloat, write halves of a float target.
TEST(Traps, AnExrOfHalvesFromAFloatBuffer) {
  EXPECT_THAT(Dump().file("out.b.exr", exr({0, 0, 2, 1}, rgba(ExrType::half))).refusal(image(Format::rgba32f, 2, 1)),
              HasSubstr("expected rgba32f as floats, found halves: the exporter has rounded; export floats"));
}

// Unity's AsyncGPUReadback converts to the format that it is asked for.
TEST(Traps, AReadbackThatConverted) {
  const capture::Array half = image(Format::r16f, 2, 1), real = image(Format::r32f, 2, 1);
  EXPECT_EQ(Dump().file("out.b.npy", npy("'<f4'", "(1, 2)", values<float>({0.5f, 0x1p-24f}))).level(half),
            values<std::uint16_t>({0x3800, 0x0001}));
  EXPECT_THAT(Dump().file("out.b.npy", npy("'<f2'", "(1, 2)", "hhhh")).refusal(real), HasSubstr("found halves"));
  EXPECT_THAT(Dump().file("out.b.npy", npy("'|u1'", "(1, 2)", "uu")).refusal(half),
              HasSubstr("found 8-bit codes: the exporter has quantized"));
}

// WebGPU copies rows to multiples of 256 bytes and leaves anything in between; Direct3D 12 footprints do the same,
// CUDA's cudaMallocPitch and linear Vulkan images have pitches of their own.
TEST(Traps, PaddedRows) {
  const std::string garbage(256 - 12, '\xee'), bytes = "aaaabbbbcccc" + garbage + "ddddeeeeffff" + garbage;
  const capture::Array expected = image(Format::r32f, 3, 2);
  Dump dump;
  dump.file("out.b.bin", bytes).file("out.b.json", R"({"format": "r32f", "width": 3, "height": 2, "row_pitch": 256})");
  EXPECT_EQ(dump.level(expected), "aaaabbbbccccddddeeeeffff");
  // Forgotten, the pitch is missed by the length.
  dump.file("out.b.json", R"({"format": "r32f", "width": 3, "height": 2})");
  EXPECT_THAT(dump.refusal(expected),
              HasSubstr("488 bytes too many: expected 2 rows of 12 bytes behind offset 0, found 512 bytes; row_pitch 256 would fit"));
  // As NPY, padding would have become columns.
  EXPECT_THAT(Dump().file("out.b.npy", npy("'<f4'", "(2, 64)", bytes)).refusal(expected), HasSubstr("expected 3x2 texels, found 64x2"));
}

// RenderDoc's EXR holds A, B, G and R in this order whatever the target has: halves of what has up to 2 bytes a component, else floats.
TEST(Traps, AnExrOfRenderDoc) {
  Dump half, real;
  half.file("out.b.exr", exr({0, 0, 2, 1}, rgba(ExrType::half)));
  EXPECT_EQ(half.level(image(Format::rg16f, 2, 1)), values<std::uint16_t>({0x3c00, 0x3c00, 0x3c01, 0x3c01}));
  EXPECT_THAT(half.notes(), ElementsAre(HasSubstr("4 channels, the buffer has 2: ba not read")));
  real.file("out.b.exr", exr({0, 0, 2, 1}, rgba(ExrType::float32)));
  EXPECT_EQ(real.level(image(Format::r32f, 2, 1)), values<float>({1, 2}));
  // A 16-bit unorm target comes as halves, which hold 11 of its bits; one of 8 bits as well. Neither is the codes that were stored.
  EXPECT_THAT(Dump().file("out.b.exr", exr({0, 0, 2, 1}, rgba(ExrType::half))).refusal(image(Format::rgba8, 2, 1)),
              HasSubstr("expected rgba8 as 8-bit codes, found halves"));
}

// RenderDoc turns an uncompressed OpenGL texture over when it saves a file, so a pass that counts v as GL does has its first row last.
TEST(Traps, PicturesUpsideDown) {
  PortInfo port;
  port.origin = Origin::bottom_left;
  EXPECT_EQ(Dump().file("out.b.png", png(1, 3, 8, 0, {"c", "b", "a"})).level(image(Format::r8, 1, 3), port), "abc");
  EXPECT_EQ(Dump().file("out.b.dds", DdsFile{.height = 3, .dxgi = 61}.with("cba")).level(image(Format::r8, 1, 3), port), "abc");
}

// Its GetTextureData leaves GL's order, the bottom row first: beside files that were turned over the sidecar says so.
TEST(Traps, RawBytesOfTheSameTextureAreNotTurnedOver) {
  PortInfo port;
  port.origin = Origin::bottom_left;
  EXPECT_EQ(Dump()
                .file("out.b.bin", "abc")
                .file("out.b.json", R"({"format": "r8", "width": 1, "height": 3, "origin": "top-left"})")
                .level(image(Format::r8, 1, 3), port),
            "abc");
}

// Swap chains and Windows' own formats put blue first.
TEST(Traps, BlueFirst) {
  EXPECT_EQ(Dump().file("out.b.dds", DdsFile{.dxgi = 87}.with("bgra")).level(image(Format::rgba8, 1, 1)), "rgba");
  EXPECT_EQ(Dump()
                .file("out.b.bin", "bgra")
                .file("out.b.json", R"({"format": "rgba8", "width": 1, "height": 1, "channel_order": "bgra"})")
                .level(image(Format::rgba8, 1, 1)),
            "rgba");
}

// The bytes that RenderDoc's buffer viewer and GetTextureData give say nothing about themselves.
TEST(Traps, RawBytesWithoutASidecar) {
  EXPECT_THAT(Dump().file("out.b.bin", "rgba").refusal(image(Format::rgba8, 1, 1)), HasSubstr("raw bytes need 'out.b.json'"));
}

// RenderDoc lays the slices of an array or a cube out in a grid of RGBA8, or of RGBA32F where more than 8 bits go into an EXR.
TEST(Traps, SlicesInOneFile) {
  EXPECT_THAT(
      Dump().file("out.b.dds", DdsFile{.dxgi = 10, .array_size = 2}.with(std::string(16, 'x'))).refusal(image(Format::rgba16f, 1, 1)),
      HasSubstr("an array of 2 textures; save them one by one"));
  EXPECT_THAT(Dump().file("out.b.png", png(1, 6, 8, 6, std::vector<std::string>(6, "rgba"))).refusal(image(Format::rgba16f, 1, 1)),
              HasSubstr("expected 1x1 texels, found 1x6"));
}

// RenderDoc saved a one-channel target as RGB; BMP has no other form.
TEST(Traps, OneChannelSavedAsThree) {
  Dump dump;
  dump.file("out.b.png", png(2, 1, 8, 2, {"aaabbb"}));
  EXPECT_EQ(dump.level(image(Format::r8, 2, 1)), "ab");
  EXPECT_THAT(dump.notes(), ElementsAre(HasSubstr("gb not read")));
  EXPECT_THAT(Dump().file("out.b.bmp", "BM").refusal(image(Format::r8, 2, 1)), HasSubstr("RenderDoc makes RGB of R8"));
}

// Devices without storage textures of one channel make ports store four.
TEST(Traps, FourChannelsForOne) {
  Dump dump;
  dump.file("out.b.exr", exr({0, 0, 2, 1}, rgba(ExrType::half)));
  EXPECT_EQ(dump.level(image(Format::r16f, 2, 1)), values<std::uint16_t>({0x3c00, 0x3c01}));
  EXPECT_THAT(dump.notes(), ElementsAre(HasSubstr("4 channels, the buffer has 1: gba not read")));
}

// Unreal's and RenderDoc's HDR, anyone's JPEG, a PNG of a float target.
TEST(Traps, LossyPictures) {
  const capture::Array expected = image(Format::rgba16f, 8, 16);
  EXPECT_THAT(Dump().file("out.b.hdr", image_io::hdr(1, 1, {{1, 2, 3, 4}})).refusal(expected),
              HasSubstr("Radiance HDR keeps 8 bits and a shared exponent of each value, and nothing below 0"));
  EXPECT_THAT(Dump().file("out.b.jpg", image_io::jpeg(1)).refusal(expected), HasSubstr("JPEG is lossy"));
  EXPECT_THAT(Dump().file("out.b.png", png(1, 1, 8, 6, {"rgba"})).refusal(image(Format::rgba16f, 1, 1)),
              HasSubstr("the exporter has quantized"));
}

// A sampler or a writer that decodes sRGB changes codes; a label alone does not.
TEST(Traps, EncodingTwice) {
  EXPECT_THAT(Dump().file("out.b.npy", npy("'<f4'", "(1, 1, 4)", std::string(16, '\0'))).refusal(image(Format::rgba8_srgb, 1, 1)),
              HasSubstr("a copy of the codes in another type has been converted"));
  EXPECT_THAT(Dump()
                  .file("out.b.bin", "rgba")
                  .file("out.b.json", R"({"format": "rgba8", "width": 1, "height": 1, "encoding": "linear"})")
                  .refusal(image(Format::rgba8_srgb, 1, 1)),
              HasSubstr("the sidecar says 'linear'"));
}

}  // namespace
}  // namespace rainref::port_dump
