// Raw bytes with their sidecar are images of the declared pitch, origin and order.
#include "port_dump/support.h"

namespace rainref::port_dump {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string read(const std::string& bytes, const std::string& json, const capture::Array& expected) {
  Dump dump;
  dump.file("out.b.bin", bytes).file("out.b.json", json);
  return dump.level(expected);
}
std::string refusal(const std::string& bytes, const std::string& json, const capture::Array& expected) {
  Dump dump;
  dump.file("out.b.bin", bytes).file("out.b.json", json);
  return dump.refusal(expected);
}

TEST(RawImage, TightRows) {
  EXPECT_EQ(read("abcdef", R"({"format": "r8", "width": 3, "height": 2})", image(Format::r8, 3, 2)), "abcdef");
  EXPECT_EQ(read("0123456789ab", R"({"format": "rg16f", "width": 1, "height": 3})", image(Format::rg16f, 1, 3)), "0123456789ab");
}

TEST(RawImage, OffsetAndPitch) {
  const std::string json = R"({"format": "r8", "width": 2, "height": 3, "offset": 5, "row_pitch": 4})";
  const capture::Array expected = image(Format::r8, 2, 3);
  EXPECT_EQ(read("junk!aa__bb__cc__", json, expected), "aabbcc");
  EXPECT_EQ(read("junk!aa__bb__cc", json, expected), "aabbcc");  // no padding behind the last row
  EXPECT_THAT(refusal("junk!aa__bb__c", json, expected), HasSubstr("truncated: expected 3 rows of 4 bytes behind offset 5, found 9 bytes"));
  EXPECT_THAT(refusal("junk!aa__bb__cc__d", json, expected), HasSubstr("1 bytes too many: expected 3 rows of 4 bytes"));
  EXPECT_THAT(refusal("junk", json, expected), HasSubstr("truncated: offset 5 in a file of 4 bytes"));
}

TEST(RawImage, APitchThatWouldFitIsNamed) {
  const capture::Array expected = image(Format::rg16f, 3, 4);
  const std::string json = R"({"format": "rg16f", "width": 3, "height": 4})",
                    padded = R"({"format": "rg16f", "width": 3, "height": 4, "row_pitch": 256})";
  EXPECT_THAT(refusal(std::string(4 * 256, 'x'), json, expected), HasSubstr("found 1024 bytes; row_pitch 256 would fit"));
  EXPECT_THAT(refusal(std::string(3 * 256 + 12, 'x'), json, expected), HasSubstr("; row_pitch 256 would fit"));  // the last row is short
  EXPECT_THAT(refusal(std::string(4 * 64, 'x'), padded, expected), HasSubstr("; row_pitch 64 would fit"));
  EXPECT_THAT(refusal(std::string(4 * 12, 'x'), padded, expected), HasSubstr("; row_pitch 12 would fit"));
  for (const std::size_t none : {4 * 12 + 1, 1025, 4 * 5000})
    EXPECT_THAT(refusal(std::string(none, 'x'), json, expected), testing::Not(HasSubstr("would fit"))) << none;
  // As NPY the padding has become columns.
  EXPECT_THAT(Dump().file("out.b.npy", npy("'<f2'", "(4, 64, 2)", std::string(1024, 'x'))).refusal(expected),
              HasSubstr("found 64x4; rows of 12 bytes are padded to multiples of 256: save the first 3 texels of each"));
}

TEST(RawImage, EveryTruncationIsRefused) {
  for (const int height : {1, 3}) {
    const std::string json = R"({"format": "r16f", "width": 2, "height": )" + std::to_string(height) + R"(, "row_pitch": 5})";
    const std::string whole(5 * height - 1, 'x');
    ASSERT_EQ(read(whole, json, image(Format::r16f, 2, height)).size(), 4u * height);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      EXPECT_THAT(refusal(whole.substr(0, size), json, image(Format::r16f, 2, height)), HasSubstr("truncated")) << size;
    }
  }
}

TEST(RawImage, TheSidecarsOriginOverridesThePorts) {
  PortInfo port;
  port.origin = Origin::bottom_left;
  Dump dump;
  dump.file("out.b.bin", "aabb").file("out.b.json", R"({"format": "r8", "width": 2, "height": 2})");
  EXPECT_EQ(dump.level(image(Format::r8, 2, 2), port), "bbaa");
  dump.file("out.b.json", R"({"format": "r8", "width": 2, "height": 2, "origin": "top-left"})");
  EXPECT_EQ(dump.level(image(Format::r8, 2, 2), port), "aabb");
  dump.file("out.b.json", R"({"format": "r8", "width": 2, "height": 2, "origin": "bottom-left"})");
  EXPECT_EQ(dump.level(image(Format::r8, 2, 2)), "bbaa");
}

TEST(RawImage, BlueFirst) {
  EXPECT_EQ(read("bgraBGRA", R"({"format": "rgba8", "width": 2, "height": 1, "channel_order": "bgra"})", image(Format::rgba8, 2, 1)),
            "rgbaRGBA");
  EXPECT_EQ(read("bbggrraa", R"({"format": "rgba16f", "width": 1, "height": 1, "channel_order": "bgra"})", image(Format::rgba16f, 1, 1)),
            "rrggbbaa");
  EXPECT_THAT(refusal("bg", R"({"format": "rg8", "width": 1, "height": 1, "channel_order": "bgra"})", image(Format::rg8, 1, 1)),
              HasSubstr("out.b.json': channel_order: 'bgra' needs four channels; rg8 has 2"));
}

TEST(RawImage, EncodingMustBeTheBuffers) {
  const std::string head = R"({"format": "rgba8_srgb", "width": 1, "height": 1, "encoding": )";
  EXPECT_EQ(read("rgba", head + R"("srgb"})", image(Format::rgba8_srgb, 1, 1)), "rgba");
  EXPECT_THAT(refusal("rgba", head + R"("linear"})", image(Format::rgba8_srgb, 1, 1)),
              HasSubstr("rgba8_srgb stores sRGB codes, the sidecar says 'linear'"));
  EXPECT_THAT(refusal("rgba", head + R"("srgb"})", image(Format::rgba8, 1, 1)),
              HasSubstr("rgba8 stores linear codes, the sidecar says 'srgb'"));
  Dump dump;
  dump.file("out.b.bin", "rgba").file("out.b.json", R"({"format": "rgba8_srgb", "width": 1, "height": 1})");
  EXPECT_EQ(dump.level(image(Format::rgba8, 1, 1)), "rgba");
  EXPECT_THAT(dump.notes(), ElementsAre(HasSubstr("rgba8_srgb, the buffer is rgba8: the codes are taken as they are")));
}

TEST(RawImage, RefusedSizes) {
  const capture::Array expected = image(Format::r32f, 3, 2);
  EXPECT_THAT(refusal("", R"({"format": "r32f", "width": 2, "height": 3})", expected), HasSubstr("expected 3x2 texels, found 2x3"));
  EXPECT_THAT(refusal("", R"({"format": "r32f", "width": 18446744073709551615, "height": 18446744073709551615})", expected),
              HasSubstr("expected 3x2 texels"));
  EXPECT_THAT(refusal(std::string(24, 'x'), R"({"format": "r32f", "width": 3, "height": 2, "row_pitch": 11})", expected),
              HasSubstr("row_pitch 11 is less than a row of 3 r32f texels, 12 bytes"));
  EXPECT_THAT(refusal(std::string(24, 'x'), R"({"format": "r32f", "width": 3, "height": 2, "row_pitch": 18446744073709551615})", expected),
              HasSubstr("truncated"));
  EXPECT_THAT(refusal(std::string(12, 'x'), R"({"format": "r16f", "width": 3, "height": 2})", expected),
              HasSubstr("expected r32f as floats, found halves"));
  EXPECT_THAT(refusal("", R"({"format": "records", "width": 3})", expected), HasSubstr("an image was expected"));
}

TEST(RawImage, FormatNamesOfOtherApisAreTranslated) {
  const auto why = [](const std::string& name) {
    return refusal("x", R"({"format": ")" + name + R"(", "width": 1, "height": 1})", image(Format::r8, 1, 1));
  };
  for (const auto& [name, own] : std::vector<std::pair<std::string, std::string>>{{"DXGI_FORMAT_R16G16_FLOAT", "rg16f"},
                                                                                  {"DXGI_FORMAT_R8G8B8A8_UNORM_SRGB", "rgba8_srgb"},
                                                                                  {"DXGI_FORMAT_R32_UINT", "r32ui"},
                                                                                  {"VK_FORMAT_R16G16_SFLOAT", "rg16f"},
                                                                                  {"VK_FORMAT_R8G8B8A8_SRGB", "rgba8_srgb"},
                                                                                  {"R32G32B32A32_SFLOAT", "rgba32f"},
                                                                                  {"GL_RG16F", "rg16f"},
                                                                                  {"GL_RGBA8", "rgba8"},
                                                                                  {"GL_SRGB8_ALPHA8", "rgba8_srgb"},
                                                                                  {"GL_R32UI", "r32ui"},
                                                                                  {"MTLPixelFormatRG16Float", "rg16f"},
                                                                                  {"MTLPixelFormat.rgba8Unorm_srgb", "rgba8_srgb"},
                                                                                  {"rg16float", "rg16f"},
                                                                                  {"rgba8unorm-srgb", "rgba8_srgb"},
                                                                                  {"r32float", "r32f"},
                                                                                  {"wgpu::TextureFormat::Rgba16Float", "rgba16f"},
                                                                                  {"RenderTextureFormat.ARGBHalf", "rgba16f"},
                                                                                  {"RGFloat", "rg32f"},
                                                                                  {"Image.FORMAT_RGH", "rg16f"}})
    EXPECT_THAT(why(name), HasSubstr("found '" + name + "'; did you mean '" + own + "'?")) << name;
  EXPECT_THAT(why("VK_FORMAT_B8G8R8A8_UNORM"), HasSubstr("; did you mean 'rgba8' with channel_order 'bgra'?"));
  // What no buffer has gets no such word.
  for (const char* none : {"DXGI_FORMAT_R16G16B16A16_UNORM", "VK_FORMAT_A2B10G10R10_UNORM_PACK32", "GL_R11F_G11F_B10F", "GL_RGB16F"})
    EXPECT_THAT(why(none), testing::Not(HasSubstr("did you mean"))) << none;
}

TEST(RawImage, RefusedSidecars) {
  const auto why = [](const std::string& json) { return refusal("rgba", json, image(Format::rgba8, 1, 1)); };
  EXPECT_THAT(why(R"({"format": "rgba8", "width": 1, "height": 1, "row_pich": 4})"),
              HasSubstr("out.b.json': unknown key 'row_pich'; did you mean 'row_pitch'?"));
  EXPECT_THAT(why(R"({"format": "rgba8", "width": 1, "height": 1, "swizzle": 4})"),
              HasSubstr("unknown key 'swizzle'; known are format, width"));
  EXPECT_THAT(why(R"({"width": 1, "height": 1})"), HasSubstr("'format' is missing"));
  EXPECT_THAT(why(R"({"format": "rgba8", "height": 1})"), HasSubstr("'width' is missing"));
  EXPECT_THAT(why(R"({"format": "rgba8", "width": 1})"), HasSubstr("'height' is missing"));
  EXPECT_THAT(why(R"({"format": "rgba16", "width": 1, "height": 1})"), HasSubstr("found 'rgba16'; did you mean 'rgba16f'?"));
  EXPECT_THAT(why(R"({"format": "rgba8", "width": -1, "height": 1})"), HasSubstr("width: expected a whole number, at least 0, found -1"));
  EXPECT_THAT(why(R"({"format": "rgba8", "width": 1.0, "height": 1})"), HasSubstr("width: expected a whole number"));
  EXPECT_THAT(why(R"({"format": "rgba8", "width": "1", "height": 1})"), HasSubstr("found \"1\""));
  EXPECT_THAT(why(R"({"format": "rgba8", "width": 1, "height": 1, "fields": {"x": 0}})"), HasSubstr("fields: is for records"));
  EXPECT_THAT(why(R"({"format": "rgba8", "width": 1, "height": 1, "origin": "lower-left"})"),
              HasSubstr("origin: expected one of top-left, bottom-left"));
  EXPECT_THAT(why(R"({"format": "rgba16f", "width": 1, "height": 1, "encoding": "srgb"})"),
              HasSubstr("encoding: 'srgb' is for 8-bit codes"));
  EXPECT_THAT(why(R"({"format": "records", "width": 1, "row_pitch": 4})"), HasSubstr("row_pitch: is for images"));
  EXPECT_THAT(why(R"({"format": "records", "width": 1, "height": 2})"), HasSubstr("records have height 1"));
  EXPECT_THAT(why(R"({"format": "records", "width": 1, "fields": {"x": -1}})"), HasSubstr("fields.x: expected a whole number"));
}

}  // namespace
}  // namespace rainref::port_dump
