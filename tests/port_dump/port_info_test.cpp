// port.json is read key by key; what is not understood is refused.
#include "port_dump/port_info.h"

#include <fmt/format.h>

#include "port_dump/apis.h"
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

// Versions, spellings and what follows do not matter; a name as a whole does.
TEST(PortInfo, AnApiIsKnownByItsNames) {
  for (const auto& [text, name] : {std::pair{"Vulkan 1.3", "Vulkan"},
                                   {"vulkan1.4, by MoltenVK", "Vulkan"},
                                   {"WebGPU", "WebGPU"},
                                   {"D3D12", "Direct3D"},
                                   {"DirectX 11", "Direct3D"},
                                   {"DX12 (SM 6.6)", "Direct3D"},
                                   {"CUDA 12.4", "CUDA"},
                                   {"Metal 3", "Metal"},
                                   {"OpenGL 4.6 core", "OpenGL"},
                                   {"GL 3.3", "OpenGL"},
                                   {"OpenGL ES 3.2", "OpenGL ES"},
                                   {"OpenGLES3", "OpenGL ES"},
                                   {"gles 3.0", "OpenGL ES"},
                                   {"WebGL2", "WebGL"},
                                   {"OpenCL 3.0, pocl", "OpenCL"},
                                   {"CPU", "CPU"}}) {
    ASSERT_TRUE(api_of(text)) << text;
    EXPECT_EQ(api_of(text)->name, name) << text;
    EXPECT_EQ(refusal(fmt::format(R"({{"api": "{}"}})", text)), "none");
  }
  EXPECT_EQ(parse_port_info(R"({"api": ""})", "'p'").api, "");
  for (const Api& api : apis()) EXPECT_EQ(api_of(api.name), &api) << api.name;
}
TEST(PortInfo, AnUnknownApiIsRefusedWithTheList) {
  EXPECT_EQ(
      refusal(R"({"api": "Vulcan 1.3"})"),
      "3 'port.json': api: expected one of Vulkan, WebGPU, Direct3D, CUDA, Metal, OpenGL, OpenGL ES, WebGL, OpenCL, CPU, with or without "
      "a version, found 'Vulcan 1.3'; did you mean 'Vulkan'?");
  EXPECT_THAT(refusal(R"({"api": "glsl"})"), HasSubstr("found 'glsl'"));
  EXPECT_THAT(refusal(R"({"api": "my engine on Vulkan"})"), HasSubstr("found 'my engine on Vulkan'"));
  EXPECT_THAT(refusal(R"({"api": ")" + std::string(1000, 'x') + R"("})"), HasSubstr("found '" + std::string(64, 'x') + "'"));
}

TEST(PortInfo, EveryTruncationIsRefused) {
  const std::string whole = R"({"api": "Vulkan", "half_store": "rne", "flush_denormals": true, "precise": false})";
  ASSERT_EQ(refusal(whole), "none");
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_THAT(refusal(whole.substr(0, size)), HasSubstr("not JSON")) << size;
}

}  // namespace
}  // namespace rainref::port_dump
