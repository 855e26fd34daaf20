// Headers that our reader and OpenEXR would read differently: refused, because OpenEXR allocates by what it misreads.
#include "image_io/exr_header.h"

#include <gmock/gmock.h>

#include "image_io/tiny_files.h"

namespace rainref::image_io {
namespace {

using testing::HasSubstr;

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + little(static_cast<std::uint32_t>(value.size())) + value;
}
std::string channel(const std::string& name) { return name + '\0' + little(1) + little(0) + little(1) + little(1); }
const std::string window = raw(std::array<std::int32_t, 4>{0, 0, 7, 3}), end(1, '\0');

std::string header(const std::string& attributes) {
  return "\x76\x2f\x31\x01" + little(2) + attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window) +
         attributes + end;
}
ExrHeader parse(const std::string& bytes) { return parse_exr_header("x.exr", std::as_bytes(std::span(bytes))); }
std::string refusal(const std::string& attributes) {
  return error_of([&] { parse(header(attributes)); });
}

TEST(ExrHeaderFile, WholeAttributesPass) {
  const ExrHeader h =
      parse(header(attribute("channels", "chlist", channel("G") + channel("R") + end) + attribute("compression", "compression", "\x03") +
                   attribute("views", "stringvector", little(4) + "left" + little(0)) + attribute("own", "anything", "12345") +
                   attribute("note", "string", "")));
  EXPECT_EQ(h.data_window, (std::array<std::int32_t, 4>{0, 0, 7, 3}));
  EXPECT_EQ(h.compression, 3);
}
TEST(ExrHeaderFile, TypesOfOneSizeHaveThatSize) {
  for (const auto& [type, bytes] :
       {std::pair{"float", 4}, {"v2f", 8}, {"box2i", 16}, {"chromaticities", 32}, {"m44f", 64}, {"tiledesc", 9}}) {
    EXPECT_EQ(refusal(attribute("own", type, std::string(static_cast<std::size_t>(bytes), '\1'))), "none");
    for (const int other : {bytes - 1, bytes + 4}) {
      EXPECT_EQ(refusal(attribute("own", type, std::string(static_cast<std::size_t>(other), '\1'))),
                "3 x.exr: damaged in its EXR header: attribute 'own' of type " + std::string(type) + " has " + std::to_string(other) +
                    " bytes; expected " + std::to_string(bytes));
    }
  }
}
TEST(ExrHeaderFile, ListsEndWithTheirAttribute) {
  EXPECT_THAT(refusal(attribute("channels", "chlist", channel("R"))), HasSubstr("damaged in its EXR header"));
  EXPECT_THAT(refusal(attribute("channels", "chlist", channel("R") + end + "xy")),
              HasSubstr("2 bytes behind the last channel of 'channels'"));
  EXPECT_THAT(refusal(attribute("channels", "chlist", channel("R").substr(0, 9) + end)), HasSubstr("truncated in its EXR header"));
  EXPECT_THAT(refusal(attribute("views", "stringvector", little(4) + "lef")), HasSubstr("truncated in its EXR header"));
  EXPECT_THAT(refusal(attribute("views", "stringvector", little(0x6f646e77) + "left")), HasSubstr("truncated in its EXR header"));
}

}  // namespace
}  // namespace rainref::image_io
