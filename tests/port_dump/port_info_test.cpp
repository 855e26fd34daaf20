// port.json is read key by key; what is not understood is refused.
#include "port_dump/port_info.h"

#include "port_dump/support.h"

namespace rainref::port_dump {
namespace {

using ::testing::HasSubstr;

std::string refusal(const std::string& text) {
  const std::string error = error_of([&] { parse_port_info(text, "'port.json'"); });
  EXPECT_THAT(error, ::testing::AnyOf("none", ::testing::StartsWith("3 'port.json': ")));
  return error;
}

TEST(PortInfo, EveryKey) {
  const PortInfo info = parse_port_info(R"({"api": "Vulkan 1.3", "device": "H100", "driver": "580", "half_store": "rtz",
    "flush_denormals": true, "origin": "bottom-left", "precise": true, "notes": "ütf-8"})",
                                        "'port.json'");
  EXPECT_EQ(info.api, "Vulkan 1.3");
  EXPECT_EQ(info.device, "H100");
  EXPECT_EQ(info.driver, "580");
  EXPECT_EQ(info.half_store, Rounding::rtz);
  EXPECT_EQ(info.flush_denormals, true);
  EXPECT_EQ(info.origin, Origin::bottom_left);
  EXPECT_TRUE(info.precise);
  EXPECT_EQ(info.notes, "ütf-8");
  EXPECT_EQ(parse_port_info(R"({"half_store": "rne", "flush_denormals": false})", "'p'").half_store, Rounding::rne);
}

TEST(PortInfo, DefaultsAndAbsentFile) {
  const TemporaryFolder folder;
  for (const PortInfo& info :
       {parse_port_info("{}", "'p'"), parse_port_info(R"({"half_store": "unknown"})", "'p'"), read_port_info(folder.path())}) {
    EXPECT_EQ(info.half_store, std::nullopt);
    EXPECT_EQ(info.flush_denormals, std::nullopt);
    EXPECT_EQ(info.origin, Origin::top_left);
    EXPECT_FALSE(info.precise);
    EXPECT_EQ(info.api, "");
  }
  put(folder / "port.json", R"({"origin": "bottom-left"})");
  EXPECT_EQ(read_port_info(folder.path()).origin, Origin::bottom_left);
  put(folder / "port.json", R"({"origin": "up"})");
  EXPECT_THAT(error_of([&] { read_port_info(folder.path()); }), HasSubstr((folder / "port.json").string()));
}

TEST(PortInfo, Refusals) {
  EXPECT_THAT(refusal(R"({"half_stor": "rne"})"), HasSubstr("unknown key 'half_stor'; did you mean 'half_store'?"));
  EXPECT_THAT(refusal(R"({"half_store": "rtn"})"),
              HasSubstr("half_store: expected one of rne, rtz, unknown, found 'rtn'; did you mean 'rt"));
  EXPECT_THAT(refusal(R"({"flush_denormals": "yes"})"), HasSubstr("flush_denormals: expected true or false, found \"yes\""));
  EXPECT_THAT(refusal(R"({"flush_denormals": null})"), HasSubstr("found null"));
  EXPECT_THAT(refusal(R"({"api": 12})"), HasSubstr("api: expected a text, found 12"));
  EXPECT_THAT(refusal(R"({"api": ["a"]})"), HasSubstr("found an array"));
  EXPECT_THAT(refusal(R"({"api": "a", "api": "b"})"), HasSubstr("key 'api' appears twice"));
  EXPECT_THAT(refusal("[]"), HasSubstr("expected an object, found an array"));
  EXPECT_THAT(refusal(""), HasSubstr("not JSON"));
  EXPECT_THAT(refusal("{\n \"api\": \"x\",\n}"), HasSubstr("not JSON: line 3, column 1"));
  EXPECT_THAT(refusal(R"({"api": "x"} x)"), HasSubstr("not JSON"));
  EXPECT_THAT(refusal("{\"api\": \"\xff\"}"), HasSubstr("not JSON"));
  EXPECT_THAT(refusal(std::string(500000, '[')), HasSubstr("nested deeper than 8"));
  EXPECT_THAT(refusal(R"({"notes": )" + std::string(100000, '{')), HasSubstr("not JSON"));
  EXPECT_THAT(refusal(std::string(2000000, ' ')), HasSubstr("expected at most"));
  EXPECT_THAT(refusal("{\"" + std::string(100, 'x') + "\": 1}"), HasSubstr("an unknown key of 100 bytes"));
}

TEST(PortInfo, EveryTruncationIsRefused) {
  const std::string whole = R"({"api": "Vulkan", "half_store": "rne", "flush_denormals": true, "precise": false})";
  ASSERT_EQ(refusal(whole), "none");
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_THAT(refusal(whole.substr(0, size)), HasSubstr("not JSON")) << size;
}

}  // namespace
}  // namespace rainref::port_dump
