// The writers that docs/dumps.md offers, compiled and run as they stand there, must give files that are read back.
#include <cstdlib>

#include "port_dump/support.h"
#include "source_folder.h"

namespace rainref::port_dump {
namespace {

const std::filesystem::path document = std::filesystem::path(rainref::test::source_folder()) / "docs/dumps.md";

// The first fenced block of this language.
std::string block(const std::string& language) {
  const std::string text = contents(document), fence = "```" + language + "\n";
  const std::size_t start = text.find(fence);
  if (start == std::string::npos) return "";
  return text.substr(start + fence.size(), text.find("```", start + fence.size()) - start - fence.size());
}

int run(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()); }

// Halves 0x6162, 0x6364, ... of a 3x2 image of two channels.
const std::string texels = "abcdefghijklmnopqrstuvwx";

TEST(Document, TheWriterInCpp) {
  Dump dump;
  const std::string folder = dump.path().string();
  dump.file("main.cpp", block("cpp") + "int main(int, char** a) { save_npy(a[1], \"" + texels + "\", 24, \"<f2\", 2, 3, 2); }\n");
  ASSERT_EQ(run(std::string(RAINREF_CXX_COMPILER) + " -std=c++11 -Wall -Wextra -Werror " + folder + "/main.cpp -o " + folder + "/main"), 0);
  ASSERT_EQ(run(folder + "/main " + folder + "/out.b.npy"), 0);
  EXPECT_EQ(dump.level(image(Format::rg16f, 3, 2)), texels);
}

TEST(Document, TheWriterInPython) {
  if (run("python3 -c pass") != 0) GTEST_SKIP() << "no python3 here";
  Dump dump;
  const std::string folder = dump.path().string();
  dump.file("main.py", block("python") + "import sys\nsave_npy(sys.argv[1], b'" + texels + "', '<f2', 2, 3, 2)\n");
  ASSERT_EQ(run("python3 " + folder + "/main.py " + folder + "/out.b.npy"), 0);
  EXPECT_EQ(dump.level(image(Format::rg16f, 3, 2)), texels);
}

TEST(Document, TheWriterInCSharp) {
  if (run("mcs --version && mono --version") != 0) GTEST_SKIP() << "no Mono here (Debian: mono-mcs)";
  Dump dump;
  const std::string folder = dump.path().string();
  // Halves as an engine without such a type holds them: 16-bit codes, of which the file has the lower byte first.
  dump.file("main.cs", "class Program {\n" + block("csharp") +
                           "static void Main(string[] a) {\n"
                           "  var codes = new ushort[12];\n"
                           "  for (int i = 0; i < 12; ++i) codes[i] = (ushort)(" +
                           std::to_string('a') + " + 2 * i + 256 * (" + std::to_string('b') +
                           " + 2 * i));\n"
                           "  SaveNpy(a[0], codes, \"<f2\", 2, 3, 2);\n}\n}\n");
  ASSERT_EQ(run("mcs -warnaserror " + folder + "/main.cs -out:" + folder + "/main.exe"), 0);
  ASSERT_EQ(run("mono " + folder + "/main.exe " + folder + "/out.b.npy"), 0);
  EXPECT_EQ(dump.level(image(Format::rg16f, 3, 2)), texels);
  const std::string file = contents(dump.path() / "out.b.npy");
  EXPECT_EQ((10 + static_cast<unsigned char>(file.at(8)) + 256 * static_cast<unsigned char>(file.at(9))) % 64, 0);  // as the others pad
}

// npy.js, which the document names.
TEST(Document, TheWriterInJavaScript) {
  if (run("node --version") != 0) GTEST_SKIP() << "no node here";
  Dump dump;
  const std::string folder = dump.path().string();
  dump.file("main.mjs", "import {writeFileSync} from 'fs';\nimport {npyFile} from '" + rainref::test::source_folder() +
                            "/examples/ports/wgsl/npy.js';\nwriteFileSync(process.argv[2], npyFile(\"'<f2'\", [2, 3, 2], Buffer.from('" +
                            texels + "')));\n");
  ASSERT_EQ(run("node " + folder + "/main.mjs " + folder + "/out.b.npy"), 0);
  EXPECT_EQ(dump.level(image(Format::rg16f, 3, 2)), texels);
}

// The example client in Godot has them word by word.
TEST(Document, TheExampleClientHasTheFunctionsInGdscript) {
  EXPECT_THAT(contents(std::filesystem::path(rainref::test::source_folder()) / "examples/clients/godot/main.gd"),
              ::testing::HasSubstr(block("gdscript")));
}
// A flat pack of one case, run by a port that copies.
TEST(Document, TheFunctionsInGdscript) {
  if (run("command -v godot3-server") != 0) GTEST_SKIP() << "no Godot here (Debian: godot3-server)";
  Dump dump;
  const std::string folder = dump.path().string();
  dump.file("in.b.bin", texels)
      .file("flat.json", R"({"cases": [{"inputs": [{"file": "in.b.bin", "bytes": 24}],
                                        "outputs": [{"file": "port/out.b.bin", "format": "rg16f", "width": 3, "height": 2}]}]})")
      .file("main.gd", "extends SceneTree\n\n" + block("gdscript") + "\nfunc _init():\n\tvar folder := \"" + folder +
                           "\"\n\tvar case: Dictionary = load_flat(folder)[\"cases\"][0]\n"
                           "\tsave_image(folder, case[\"outputs\"][0], load_bytes(folder, case[\"inputs\"][0]))\n\tquit()\n");
  ASSERT_EQ(run("cd '" + folder + "' && HOME=" + folder + " timeout 60 godot3-server -s main.gd"), 0);
  for (const char* name : {"out.b.bin", "out.b.json"}) std::filesystem::rename(dump.path() / "port" / name, dump.path() / name);
  EXPECT_EQ(dump.level(image(Format::rg16f, 3, 2)), texels);
}

TEST(Document, ItsJsonIsAccepted) {
  const std::string text = contents(document);
  std::vector<std::string> blocks;
  for (std::size_t at = text.find("```json\n"); at != std::string::npos; at = text.find("```json\n", at + 8)) {
    blocks.push_back(text.substr(at + 8, text.find("```", at + 8) - at - 8));
  }
  ASSERT_EQ(blocks.size(), 3u);
  EXPECT_EQ(parse_port_info(blocks[0], "'port.json'").half_store, Rounding::rtz);
  EXPECT_EQ(parse_port_info(blocks[1], "'port.json'").encodings["drops"].members.size(), 4u);
  Dump dump;
  dump.file("out.b.bin", std::string(256 * 37, 'x')).file("out.b.json", blocks[2]);
  EXPECT_EQ(dump.level(image(Format::rg16f, 61, 37)).size(), 61u * 37 * 4);
}

}  // namespace
}  // namespace rainref::port_dump
