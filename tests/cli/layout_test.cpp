// `rainref describe --layout`, compiled in each language: the offsets that the compiler gives the members find the
// values that the small packs' manifests name in the packs' uniform bytes.
#include <cstdlib>
#include <cstring>
#include <map>
#include <regex>
#include <set>

#include <nlohmann/json.hpp>

#include "cli/support.h"
#include "shipped_packs.h"

namespace rainref::cli {
namespace {

using nlohmann::ordered_json;

/// Offsets of a block or record, by member, and its size.
struct Offsets {
  std::map<std::string, int> of;
  int size = 0;
};

bool is_there(const char* tool) { return std::system(fmt::format("command -v {} > /dev/null 2>&1", tool).c_str()) == 0; }

class Layout : public CommandLine, public testing::WithParamInterface<std::string> {
 protected:
  Layout() {
    for (const rainref::test::PackPasses& p : rainref::test::packs_of(GetParam(), rainref::test::proven_packs())) {
      const std::filesystem::path pack = rainref::test::pack_folder(p.name);
      ordered_json manifest = ordered_json::parse(contents(pack / "manifest.json"));
      for (const auto& [list, key] : {std::pair("passes", "name"), std::pair("cases", "pass")}) {
        ordered_json proven = ordered_json::array();
        for (const ordered_json& one : manifest[list])
          if (p.has(one[key])) proven.push_back(one);
        manifest[list] = proven;
      }
      packs.emplace_back(pack, std::move(manifest));
    }
  }

  std::string described(const std::string& language, const std::vector<std::string>& more = {}) const {
    return good(copied(joined({"describe", GetParam(), "--layout", language}, more))).out;
  }
  /// The text of one block or record: from its own comment to the next empty line.
  static std::string section(const std::string& text, const std::string& name) {
    const std::size_t begin = text.find(fmt::format("// {}: ", name));
    EXPECT_NE(begin, std::string::npos) << name;
    return begin == std::string::npos ? "" : text.substr(begin, text.find("\n\n", begin) - begin + 1);
  }
  /// Blocks of the passes and records of the packs, by name.
  std::map<std::string, ordered_json> layouts(bool records) const {
    std::map<std::string, ordered_json> out;
    for (const auto& [path, manifest] : packs) {
      if (records) {
        for (const ordered_json& r : manifest["records"]) out[r["name"]] = r;
      } else {
        for (const ordered_json& p : manifest["passes"]) out[p["uniform_block"]["name"]] = p["uniform_block"];
      }
    }
    EXPECT_TRUE(records || !out.empty());
    return out;
  }
  /// What a compiler found agrees with the manifest and, for a block, with the bytes of every case.
  void expect_agrees(const ordered_json& layout, const Offsets& found) const {
    const std::string name = layout["name"];
    EXPECT_EQ(found.size, layout["size"].get<int>()) << name;
    for (const ordered_json& m : layout["members"]) {
      const auto at = found.of.find(m["name"]);
      ASSERT_NE(at, found.of.end()) << name << '.' << m["name"];
      EXPECT_EQ(at->second, m["offset"].get<int>()) << name << '.' << m["name"];
    }
    for (const auto& [path, manifest] : packs) {
      for (const ordered_json& c : manifest["cases"]) {
        const auto pass = std::find_if(manifest["passes"].begin(), manifest["passes"].end(),
                                       [&](const ordered_json& p) { return p["name"] == c["pass"]; });
        if ((*pass)["uniform_block"]["name"] != name) continue;
        const std::string bytes = contents(path / c["uniform_block"]["file"].get<std::string>());
        ASSERT_EQ(static_cast<int>(bytes.size()), found.size);
        for (const ordered_json& u : c["uniforms"]) {
          const ordered_json bits = u["bits"].is_array() ? u["bits"] : ordered_json::array({u["bits"]});
          for (std::size_t k = 0; k < bits.size(); ++k) {
            std::uint32_t word;
            std::memcpy(&word, bytes.data() + found.of.at(u["name"]) + 4 * k, 4);
            EXPECT_EQ(fmt::format("0x{:08x}", word), bits[k].get<std::string>()) << c["id"] << ' ' << u["name"];
          }
        }
      }
    }
  }
  /// A program that prints offsetof and sizeof of all that `source` declares.
  std::string printing_program(const std::string& source) const {
    std::string text = "#include <stddef.h>\n#include <stdio.h>\n" + source + "int main(void) {\n";
    for (const bool records : {false, true}) {
      for (const auto& [name, layout] : layouts(records)) {
        for (const ordered_json& m : layout["members"]) {
          text += fmt::format("  printf(\"{0} {1} %d\\n\", (int)offsetof({0}, {1}));\n", name, m["name"].get<std::string>());
        }
        text += fmt::format("  printf(\"{0} = %d\\n\", (int)sizeof({0}));\n", name);
      }
    }
    return text + "  return 0;\n}\n";
  }
  void expect_printed(const std::string& printed) const {
    std::map<std::string, Offsets> found;
    for (const std::string& line : lines_of(printed)) {
      const std::size_t a = line.find(' '), b = line.rfind(' ');
      const std::string member = line.substr(a + 1, b - a - 1);
      const int value = std::atoi(line.c_str() + b + 1);
      if (member == "=")
        found[line.substr(0, a)].size = value;
      else
        found[line.substr(0, a)].of[member] = value;
    }
    for (const bool records : {false, true}) {
      for (const auto& [name, layout] : layouts(records)) expect_agrees(layout, found[name]);
    }
  }
  /// Offsets from glslang's reflection: "drops[0].x: offset 0, type ...", and the size of the block.
  Offsets reflected(const std::string& file, const std::string& options, const std::string& block, bool is_record) const {
    Offsets out;
    static const std::regex member("([A-Za-z0-9_]+): offset ([0-9]+), .*"),
        whole("([A-Za-z0-9_]+): offset -1, type [0-9a-f]+, size ([0-9]+), .*");
    for (std::string line :
         lines_of(output(fmt::format("glslangValidator {} -l -q --reflect-all-block-variables -S comp {}", options, file)))) {
      std::smatch m;
      if (std::regex_match(line, m, whole)) {
        if (m[1] == block) out.size = std::stoi(m[2]);
        continue;
      }
      if (is_record && line.find('.') == std::string::npos) continue;  // the result's own buffer
      line.erase(0, line.find('.') == std::string::npos ? 0 : line.rfind('.', line.find(':')) + 1);
      if (std::regex_match(line, m, member)) out.of[m[1]] = std::stoi(m[2]);
    }
    return out;
  }
  static std::string first_member(const ordered_json& layout) {
    // Components beyond the first need no name: a use of any part keeps the block alive.
    const ordered_json& m = layout["members"][0];
    return fmt::format("{}{}", m["name"].get<std::string>(), m["components"] == 1 ? "" : ".x");
  }
  static std::string snake(const std::string& name) {
    std::string out;
    for (const char c : name) {
      if (std::isupper(static_cast<unsigned char>(c)) && !out.empty()) out += '_';
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return out;
  }

  std::vector<std::pair<std::filesystem::path, ordered_json>> packs;  ///< manifests of the passes that the proofs take of each
};

INSTANTIATE_TEST_SUITE_P(Effects, Layout, testing::ValuesIn(rainref::test::packed_effects()),
                         [](const auto& effect) { return effect.param; });

TEST_P(Layout, C) {
  put(folder / "a.c", printing_program(described("c")));
  output(fmt::format("{} -x c -std=c99 -pedantic -Wall -Wextra -Werror -o program a.c", RAINREF_CXX_COMPILER));
  expect_printed(output("./program"));
}

// CUDA as far as a C++ compiler tells, with the alignments that its programming guide gives the vector types.
TEST_P(Layout, CudaTextInCpp) {
  std::string vectors;
  for (const auto& [name, of] : {std::pair("float", "float"), std::pair("int", "int"), std::pair("uint", "unsigned int")}) {
    vectors += fmt::format(
        "struct alignas(8) {0}2 {{ {1} x, y; }};\nstruct {0}3 {{ {1} x, y, z; }};\nstruct alignas(16) {0}4 {{ {1} x, y, z, w; }};\n", name,
        of);
  }
  put(folder / "a.cpp", printing_program(vectors + described("cuda")));
  output(fmt::format("{} -x c++ -std=c++17 -Wall -Wextra -Werror -o program a.cpp", RAINREF_CXX_COMPILER));
  expect_printed(output("./program"));
}

TEST_P(Layout, CudaByNvcc) {
  if (!is_there("nvcc")) GTEST_SKIP() << "no nvcc on this machine";
  put(folder / "a.cu", printing_program(described("cuda")));
  output("nvcc -o program a.cu");
  expect_printed(output("./program"));
}

TEST_P(Layout, Glsl) {
  if (!is_there("glslangValidator")) GTEST_SKIP() << "no glslangValidator on this machine (Debian: glslang-tools)";
  const std::string text = described("glsl");
  for (const bool records : {false, true}) {
    for (const auto& [name, layout] : layouts(records)) {
      const std::string use = records ? "list[1]" : snake(name);
      const std::string list = fmt::format("layout(std430, binding = 1) readonly buffer ListBuffer {{ {} list[]; }};\n", name);
      put(folder / "a.comp",
          fmt::format(
              "#version 450\n{}{}layout(std430, binding = 9) buffer Out {{ float result; }};\nvoid main() {{ result = float({}.{}); }}\n",
              section(text, name), records ? list : "", use, first_member(layout)));
      expect_agrees(layout, reflected("a.comp", "", records ? "ListBuffer" : name, records));
    }
  }
}

TEST_P(Layout, Hlsl) {
  if (!is_there("glslangValidator")) GTEST_SKIP() << "no glslangValidator on this machine (Debian: glslang-tools)";
  const std::string text = described("hlsl");
  for (const bool records : {false, true}) {
    for (const auto& [name, layout] : layouts(records)) {
      const std::string use = records ? fmt::format("list[1].{}", first_member(layout)) : first_member(layout);
      const std::string list = fmt::format("StructuredBuffer<{}> list : register(t0);\n", name);
      put(folder / "a.hlsl",
          fmt::format(
              "{}{}RWStructuredBuffer<float> result : register(u0);\n[numthreads(1, 1, 1)] void main() {{ result[0] = float({}); }}\n",
              section(text, name), records ? list : "", use));
      expect_agrees(layout, reflected("a.hlsl", "-V -o a.spv -D -e main", records ? "list" : name, records));
    }
  }
}

// The text of one pass of one variant can be pasted as it is: each list has a binding of its own, and nothing is there that it does not
// need.
TEST_P(Layout, OnePassAloneCompilesInEachLanguage) {
  const bool has_glslang = is_there("glslangValidator");
  std::string glsl;
  std::vector<std::string> hlsl;
  for (const auto& [path, manifest] : packs) {
    const std::string variant = manifest["variant"];
    for (const ordered_json& pass : manifest["passes"]) {
      const std::string name = pass["name"], block = pass["uniform_block"]["name"];
      const std::vector<std::string> alone{"--pass", name, "--variant", variant};
      std::map<std::string, std::string> texts;
      for (const char* language : {"glsl", "hlsl", "wgsl", "c", "glsl330", "gdshader"}) {
        const std::string text = texts[language] = described(language, alone);
        EXPECT_THAT(text, testing::HasSubstr(fmt::format("// Pass {}, {}. ", name, variant)));
        for (const auto& [other, layout] : layouts(false))
          EXPECT_EQ(std::regex_search(text, std::regex(fmt::format("// {}[:.] ", other))), other == block) << text;
      }
      // Whatever the pass reads or writes is declared, lists in GLSL 3.30 and Godot as far as a fragment shader can.
      for (const ordered_json& buffer : pass["reads"])
        for (const char* language : {"glsl", "hlsl", "wgsl", "glsl330", "gdshader"})
          EXPECT_TRUE(std::regex_search(texts[language], std::regex(fmt::format("\\b{}\\b[ \\[]?[;:\\]]", buffer.get<std::string>()))))
              << language << ' ' << buffer << '\n'
              << texts[language];
      const std::regex place("binding ?[=(] ?([0-9]+)|register\\(([btu][0-9]+)\\)");
      std::size_t lists = 0;
      for (const auto& c : manifest["cases"]) {
        if (c["pass"] != name) continue;
        lists = 0;
        for (const char* side : {"inputs", "outputs"})
          for (const ordered_json& b : c[side]) lists += b["format"] == "records";
      }
      for (const char* language : {"glsl", "hlsl", "wgsl"}) {
        std::vector<std::string> places;
        const std::string& text = texts[language];
        for (std::sregex_iterator m(text.begin(), text.end(), place), end; m != end; ++m) places.push_back((*m)[0]);
        // WGSL: a fragment shader's outputs have no place, an image that is read has one more for its sampler.
        const std::size_t bound = pass["reads"].size() + pass["writes"].size();
        EXPECT_GE(places.size(), 1 + (language == std::string("wgsl") ? std::max(lists, pass["reads"].size()) : bound)) << text;
        std::sort(places.begin(), places.end());
        EXPECT_EQ(std::adjacent_find(places.begin(), places.end()), places.end()) << text;
      }
      const std::string stem = name + "_" + variant;
      put(folder / (stem + ".comp"), "#version 450\n" + texts["glsl"] + "void main() {}\n");
      put(folder / (stem + ".hlsl"), texts["hlsl"] + "[numthreads(1, 1, 1)] void main() {}\n");
      put(folder / (stem + ".c"), texts["c"]);
      std::set<std::string> uniforms;
      const std::regex uniform("uniform \\w+ (\\w+);");
      for (std::sregex_iterator m(texts["gdshader"].begin(), texts["gdshader"].end(), uniform), end; m != end; ++m)
        EXPECT_TRUE(uniforms.insert((*m)[1]).second) << texts["gdshader"];
      put(folder / (stem + "_330.frag"), "#version 330\n" + texts["glsl330"] + "void main() {}\n");
      put(folder / (stem + "_es.frag"), "#version 300 es\n" + texts["glsl330"] + "void main() {}\n");
      // Godot writes uniforms with another name, so that one may be called as a function is.
      put(folder / (stem + "_godot.frag"),
          "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n" +
              std::regex_replace(texts["gdshader"], std::regex("(uniform \\w+) (\\w+);  //"), "$1 m_$2;  //") + "void main() {}\n");
      glsl += fmt::format(" {0}.comp {0}_330.frag {0}_es.frag {0}_godot.frag", stem);
      hlsl.push_back(stem + ".hlsl");
    }
  }
  // One at a time: the driver of C++ takes the files after the first for C++.
  output(fmt::format("for f in *.c; do {} -x c -std=c99 -pedantic -Wall -Wextra -Werror -fsyntax-only $f || exit 1; done",
                     RAINREF_CXX_COMPILER));
  if (!has_glslang) GTEST_SKIP() << "no glslangValidator on this machine (Debian: glslang-tools)";
  output("glslangValidator" + glsl);
  for (const std::string& file : hlsl) output("glslangValidator -V -o a.spv -D -e main -S comp " + file);
}

// WGSL by the rules of its specification (alignment and size, "Structure member layout"), applied to the printed text.
TEST_P(Layout, WgslByItsRules) {
  const std::string text = described("wgsl");
  const std::regex member("  ([a-z0-9_]+) : (?:vec([234])<)?[fiu]32>?,.*");
  for (const bool records : {false, true}) {
    for (const auto& [name, layout] : layouts(records)) {
      Offsets found;
      int end = 0, largest = 0;
      for (const std::string& line : lines_of(section(text, name))) {
        std::smatch m;
        if (!std::regex_match(line, m, member)) continue;
        const int n = m[2].matched ? std::stoi(m[2]) : 1, alignment = n == 1 ? 4 : n == 2 ? 8 : 16;
        found.of[m[1]] = (end + alignment - 1) / alignment * alignment;
        end = found.of[m[1]] + 4 * n;
        largest = std::max(largest, alignment);
      }
      found.size = (end + largest - 1) / largest * largest;
      // A uniform buffer's size is that of the bytes bound to it; a record's is the stride of the array.
      expect_agrees(layout, found);
    }
  }
}

TEST_P(Layout, WgslByWgslReflect) {
  if (!is_there("node") || std::system("node -e \"require.resolve('wgsl_reflect')\" > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "no node with wgsl_reflect on this machine (it is no Debian package; NODE_PATH says where it is)";
  }
  // import looks for no NODE_PATH; require does.
  put(folder / "a.mjs", R"(import { createRequire } from 'module';
import { readFileSync } from 'fs';
import { dirname, join } from 'path';
const found = createRequire(import.meta.url).resolve('wgsl_reflect');
const { WgslReflect } = await import(join(dirname(found), 'wgsl_reflect.module.js'));
for (const s of new WgslReflect(readFileSync('a.wgsl', 'utf8')).structs) {
  for (const m of s.members) console.log(`${s.name} ${m.name} ${m.offset}`);
  console.log(`${s.name} = ${s.size}`);
}
)");
  const std::string text = described("wgsl");
  std::string structs;
  for (const bool records : {false, true})
    for (const auto& [name, layout] : layouts(records)) structs += section(text, name);
  put(folder / "a.wgsl", structs);
  expect_printed(output("node a.mjs"));
}

}  // namespace
}  // namespace rainref::cli
