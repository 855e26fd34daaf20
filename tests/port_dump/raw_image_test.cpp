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

TEST(RawImage, RefusedSidecars) {
  const auto why = [](const std::string& json) { return refusal("rgba", json, image(Format::rgba8, 1, 1)); };
  EXPECT_THAT(why(R"({"format": "rgba8", "width": 1, "height": 1, "row_pich": 4})"),
              HasSubstr("out.b.json': unknown key 'row_pich'; did you mean 'row_pitch'?"));
  EXPECT_THAT(why(R"({"format": "rgba8", "width": 1, "height": 1, "swizzle": 4})"),
              HasSubstr("unknown key 'swizzle'; known are format, width"));
  EXPECT_THAT(why(R"({"width": 1, "height": 1})"), HasSubstr("format: missing"));
  EXPECT_THAT(why(R"({"format": "rgba8", "height": 1})"), HasSubstr("width: missing"));
  EXPECT_THAT(why(R"({"format": "rgba8", "width": 1})"), HasSubstr("height: missing"));
  EXPECT_THAT(why(R"({"format": "rgba16", "width": 1, "height": 1})"), HasSubstr("found 'rgba16'; did you mean 'rgba16f'?"));
  EXPECT_THAT(why(R"({"format": "rgba8", "width": -1, "height": 1})"), HasSubstr("width: expected a whole number, at least 0, found -1"));
  EXPECT_THAT(why(R"({"format": "rgba8", "width": 1.0, "height": 1})"), HasSubstr("width: expected a whole number"));
  EXPECT_THAT(why(R"({"format": "rgba8", "width": "1", "height": 1})"), HasSubstr("found '1'"));
  EXPECT_THAT(why(R"({"format": "rgba8", "width": 1, "height": 1, "fields": {"x": 0}})"), HasSubstr("fields: is for records"));
  EXPECT_THAT(why(R"({"format": "rgba8", "width": 1, "height": 1, "origin": "lower-left"})"),
              HasSubstr("origin: expected one of 'top-left', 'bottom-left'"));
  EXPECT_THAT(why(R"({"format": "rgba16f", "width": 1, "height": 1, "encoding": "srgb"})"),
              HasSubstr("encoding: 'srgb' is for 8-bit codes"));
  EXPECT_THAT(why(R"({"format": "records", "width": 1, "row_pitch": 4})"), HasSubstr("row_pitch: is for images"));
  EXPECT_THAT(why(R"({"format": "records", "width": 1, "height": 2})"), HasSubstr("records have height 1"));
  EXPECT_THAT(why(R"({"format": "records", "width": 1, "fields": {"x": -1}})"), HasSubstr("fields.x: expected a whole number"));
}

}  // namespace
}  // namespace rainref::port_dump
