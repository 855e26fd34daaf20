// The WGSL port of display, run by a headless Chromium's WebGPU on its software adapter, and judged under `webgpu`.
#include "ports/runner/npy.h"
#include "ports/support.h"
#include "reports/browser.h"

namespace rainref::ports {
namespace {

using port_runner::Array;

constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
std::string to_base64(const std::vector<std::uint8_t>& bytes) {
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) { return k < bytes.size() ? bytes[k] : 0u; };
    const unsigned word = at(i) << 16 | at(i + 1) << 8 | at(i + 2);
    for (int k = 0; k < 4; ++k) out += i + static_cast<std::size_t>(k) > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63];
  }
  return out;
}
std::vector<std::uint8_t> from_base64(const std::string& text) {
  std::vector<std::uint8_t> out;
  unsigned word = 0, bits = 0;
  for (const char c : text) {
    const auto digit = std::string_view(digits).find(c);
    if (digit == std::string_view::npos) break;
    word = word << 6 | static_cast<unsigned>(digit);
    bits += 6;
    if (bits >= 8) out.push_back(static_cast<std::uint8_t>(word >> (bits -= 8)));
  }
  return out;
}

class Wgsl : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!Browser::is_installed()) GTEST_SKIP() << "chromium is not installed: no WebGPU";
  }
  /// Every case of display, in a folder as a port leaves it.
  Outcome judged(bool is_mutant) {
    const TemporaryFolder folder;
    std::string shader = contents(examples + "/wgsl/display.wgsl");
    const std::string stored = "vec4f(code, 1.0)";
    EXPECT_NE(shader.find(stored), std::string::npos);
    // The mutant encodes twice.
    if (is_mutant)
      shader.replace(shader.find(stored), stored.size(), "vec4f(select(pow(code, vec3f(0.4545)), encode_srgb(code), CORRECTED), 1.0)");
    const std::string pack = pack_of(GetParam());
    const auto manifest = nlohmann::json::parse(contents(pack + "/manifest.json"));
    Browser browser({"--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan"});
    browser.open(examples + "/wgsl/run.html");
    std::string adapter;
    for (const auto& c : manifest["cases"]) {
      if (c["pass"] != "display") continue;
      const auto &in = c["inputs"][0], &out = c["outputs"][0];
      const std::size_t width = in["width"], height = in["height"];
      const nlohmann::json call{shader,
                                to_base64(port_runner::read_file(pack + "/" + c["uniform_block"]["file"].get<std::string>())),
                                to_base64(port_runner::read_npy(pack + "/" + in["file"].get<std::string>(), "'<f2'", {height, width, 4})),
                                width,
                                height,
                                {{"CORRECTED", std::string(GetParam()) == "corrected" ? 1 : 0}}};
      const std::string arguments = call.dump();
      const auto result = browser.value("display(" + arguments.substr(1, arguments.size() - 2) + ")");
      adapter = result["adapter"];
      port_runner::write_npy(folder / out["file"].get<std::string>(), Array{"'|u1'", {height, width, 4}, from_base64(result["picture"])});
    }
    port_runner::write_file(folder / "port.json", nlohmann::json{{"api", "WebGPU"}, {"device", adapter}}.dump());
    return judge(pack, folder.path(), "--only display --profile webgpu");
  }
};
INSTANTIATE_TEST_SUITE_P(Variants, Wgsl, testing::Values("as-published", "corrected"),
                         [](const auto& variant) { return variant.param[0] == 'a' ? "AsPublished" : "Corrected"; });

TEST_P(Wgsl, DisplayPassesUnderWebgpuAndABugFails) {
  const Outcome meant = judged(false);
  EXPECT_EQ(meant.code, 0) << meant.text;
  EXPECT_THAT(meant.text, testing::HasSubstr("PASS"));
  EXPECT_EQ(judged(true).code, 1);
}

}  // namespace
}  // namespace rainref::ports
