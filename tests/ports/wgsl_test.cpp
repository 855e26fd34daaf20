// WGSL ports, run by a headless Chromium's WebGPU on its software adapter, and judged under `webgpu`. Each pass by one pack;
// scripts/full/wgsl takes every pack.
#include <fstream>
#include <map>
#include <memory>

#include "ports/any_effect.h"
#include "reports/browser.h"

namespace rainref::ports {
namespace {

constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
std::string to_base64(const std::string& bytes) {
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) { return k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u; };
    const unsigned word = at(i) << 16 | at(i + 1) << 8 | at(i + 2);
    for (int k = 0; k < 4; ++k) out += i + static_cast<std::size_t>(k) > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63];
  }
  return out;
}
std::string from_base64(const std::string& text) {
  std::string out;
  unsigned word = 0, bits = 0;
  for (const char c : text) {
    const auto digit = std::string_view(digits).find(c);
    if (digit == std::string_view::npos) break;
    word = word << 6 | static_cast<unsigned>(digit);
    bits += 6;
    if (bits >= 8) out += static_cast<char>(word >> (bits -= 8) & 255);
  }
  return out;
}

const std::string folder = examples + "/wgsl";

using Files = std::map<std::string, std::string>;  // from a path to bytes
Files port_files() {
  Files files;
  std::vector<std::string> folders = packed_effects();
  folders.push_back("common");
  for (const std::string& f : folders)
    for (const auto& file : fs::directory_iterator(folder + "/" + f))
      files[f + "/" + file.path().filename().string()] = contents(file.path());
  return files;
}
// What some passes need of a pack: their cases alone, and the files that they read.
Files pack_files(const std::string& pack, const std::vector<std::string>& passes) {
  auto manifest = nlohmann::json::parse(contents(pack + "/manifest.json"));
  auto cases = nlohmann::json::array();
  for (const auto& c : manifest["cases"])
    if (std::find(passes.begin(), passes.end(), c["pass"]) != passes.end()) cases.push_back(c);
  manifest["cases"] = cases;
  Files files{{"manifest.json", manifest.dump()}};
  const auto add = [&](const nlohmann::json& of) {
    const std::string name = of["file"];
    files[name] = contents(pack + "/" + name);
  };
  for (const auto& c : cases) {
    add(c["uniform_block"]);
    for (const auto& input : c["inputs"]) {
      add(input);
      for (const auto& mip : input.value("mips", nlohmann::json::array())) add(mip);
    }
  }
  return files;
}
std::string base64_object(const Files& files) {
  nlohmann::json out = nlohmann::json::object();
  for (const auto& [name, bytes] : files) out[name] = to_base64(bytes);
  return out.dump();
}
void replace(std::string& text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  ASSERT_NE(at, std::string::npos) << what;
  text.replace(at, what.size(), by);
}

class Wgsl : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!Browser::is_installed()) return;
    // A page of a file may import its modules only with the last option.
    browser = std::make_unique<Browser>(std::vector<std::string>{"--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader",
                                                                 "--enable-features=Vulkan", "--allow-file-access-from-files"});
    browser->open(folder + "/run.html");
  }
  static void TearDownTestSuite() { browser.reset(); }
  void SetUp() override {
    if (!browser) GTEST_SKIP() << "chromium is not installed: no WebGPU";
  }
  static nlohmann::json run(const std::string& pack, const std::vector<std::string>& passes, const Files& port) {
    return browser->value("runFiles(" + base64_object(pack_files(pack, passes)) + ", " + base64_object(port) + ")");
  }
  static Outcome judged(const std::string& pack, const std::vector<std::string>& passes, const Files& port) {
    const TemporaryFolder out;
    const nlohmann::json files = run(pack, passes, port)["files"];
    for (const auto& [name, bytes] : files.items()) {
      fs::create_directories((out / name).parent_path());
      std::ofstream(out / name, std::ios::binary) << from_base64(bytes);
    }
    std::string only;
    for (const std::string& pass : passes) only += (only.empty() ? "--only " : ",") + pass;
    return judge(pack, out.path(), only + " --profile webgpu");
  }
  // What the page says of a port that it cannot run.
  static std::string complaint(const std::string& pass, const Files& port) {
    try {
      run(pack_of("corrected"), {pass}, port);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  static inline std::unique_ptr<Browser> browser;
};

TEST_F(Wgsl, EveryPassPassesUnderWebgpu) {
  const Files port = port_files();
  for (PackPasses p : proven_packs()) {
    std::erase(p.passes, "ground_noise");  // the host makes it
    const Outcome outcome = judged(pack_folder(p.name), p.passes, port);
    // SwiftShader's sine is off by what the profile allows and GPUs are not; the published march of a grazing ray has no useful bound.
    for (const std::string& pass : p.passes)
      EXPECT_THAT(outcome.text, testing::ContainsRegex((pass == "bake_rivulets" ? "(PASS|WARN)  "
                                                        : pass == "surface_hit" ? "(PASS|UNTESTED)  "
                                                                                : "PASS  ") +
                                                       pass + " "))
          << p.name;
  }
}

TEST_F(Wgsl, PortsOfForeignEffectsPassUnderWebgpu) {
  if (!AnyEffect::made()) GTEST_SKIP() << "needs NumPy for /usr/bin/python3";
  const std::map<std::string, std::vector<std::string>> passes{{"fogged_glass", {"fog", "shade"}},
                                                               {"caustics", {"wave", "caustics", "floor"}}};
  for (const auto& [effect, names] : passes) {
    Files port;
    for (const auto& file : fs::directory_iterator(source + "/examples/any_effect/" + effect + "/wgsl"))
      port[effect + "/" + file.path().filename().string()] = contents(file.path());
    const Outcome outcome = judged(AnyEffect::made()->pack(effect), names, port);
    EXPECT_EQ(outcome.code, 0) << outcome.text;
  }
}

TEST_F(Wgsl, ABugFails) {
  Files port = port_files();
  replace(port["puddle/display_corrected.wgsl"], "vec4f(code, 1.0)", "vec4f(encode_srgb(code), 1.0)");
  EXPECT_EQ(judged(pack_of("corrected"), {"display"}, port).code, 1);
}

TEST_F(Wgsl, WhatCannotRunIsNamed) {
  const std::string file = "puddle/display_corrected.wgsl";
  Files port = port_files();
  replace(port[file], "let pixel", "lett pixel");
  EXPECT_THAT(complaint("display", port), testing::HasSubstr("display_corrected.wgsl:4:"));
  port = port_files();
  replace(port["puddle/display.wgsl"], "@binding(1)", "@binding(3)");
  EXPECT_THAT(complaint("display", port), testing::HasSubstr("colour: the pass has no binding 3"));
  port = port_files();
  replace(port["puddle/surface_hit_corrected.wgsl"], "@binding(2)", "@binding(1)");
  EXPECT_THAT(complaint("surface_hit", port), testing::HasSubstr("bounds: its binding is 2, the shader declares it at 1"));
  port = port_files();
  replace(port["puddle/raindrops_corrected.wgsl"], "storage, read_write", "storage, read");
  EXPECT_THAT(complaint("raindrops", port),
              testing::HasSubstr("binding 5 is drops: expected var<storage, read_write>, found var<storage, read>"));
}

// No browser needed: programs and texts agree with this version's formulas and layouts.
TEST(WgslText, EveryFormulaOfThePacksHasAProgramOfFilesThatAreThere) {
  const Files port = port_files();
  for (const PackPasses& pack : test::shipped_packs()) {
    const auto manifest = nlohmann::json::parse(contents(pack_folder(pack.name) / "manifest.json"));
    const std::string& effect = pack.effect;
    const auto programs = nlohmann::json::parse(port.at(effect + "/programs.json"))["programs"];
    for (const auto& pass : manifest["passes"]) {
      if (pass["name"] == "ground_noise") continue;  // the host makes it
      const auto names = programs.value(pass["formula"].get<std::string>(), nlohmann::json::array());
      EXPECT_FALSE(names.empty()) << pass["formula"];
      for (std::string name : names) {
        name = name.rfind("../", 0) == 0 ? name.substr(3) : effect + "/" + name;
        EXPECT_EQ(port.count(name), 1u) << name;
      }
    }
  }
}

TEST(WgslText, BlocksAndRecordsAreWhatDescribePrints) {
  int structs = 0;
  for (const std::string& effect : packed_effects()) {
    const std::string described = call(RAINREF_PROGRAM " describe " + effect + " --layout wgsl").text;
    for (const auto& [name, text] : port_files()) {
      if (name.rfind(effect + "/", 0) != 0) continue;
      // Those with offsets in comments; a port's own structures have none.
      for (std::size_t begin = 0; (begin = text.find("struct ", begin)) != std::string::npos; ++begin) {
        const std::string block = text.substr(begin, text.find("\n}", begin) + 2 - begin);
        if (block.find("  //   0  ") == std::string::npos) continue;
        EXPECT_THAT(described, testing::HasSubstr(block)) << name;
        ++structs;
      }
    }
  }
  EXPECT_GE(structs, 30);
}

}  // namespace
}  // namespace rainref::ports
