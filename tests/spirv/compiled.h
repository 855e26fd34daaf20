// Shaders that tests write in GLSL, as glslangValidator compiles them.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/read_file.h"
#include "base/shell.h"
#include "base/temporary_folder.h"

namespace rainref::spirv {

inline bool has_compiler() { return std::string(RAINREF_GLSLANG) != ""; }
/// Skips a test where there is none.
#define RAINREF_NEED_COMPILER() \
  if (!has_compiler()) GTEST_SKIP() << "needs glslangValidator"

/// SPIR-V of a compute shader. Throws where it does not compile.
inline std::vector<std::byte> compiled(const std::string& glsl, const std::string& options = "") {
  const TemporaryFolder folder;
  const std::filesystem::path source = folder / "shader.comp", module = folder / "shader.spv";
  std::ofstream(source) << "#version 450\n" << glsl;
  const auto [text, status] = output_of("cd '" + folder.path().string() + "' && '" RAINREF_GLSLANG "' -V --target-env vulkan1.1 " +
                                        options + " shader.comp -o shader.spv");
  if (status != 0) throw std::runtime_error(text);
  return read_file(module);
}
/// The body of main() of one invocation, with `uint words[]` to read and write.
inline std::vector<std::byte> compiled_body(const std::string& body, const std::string& before = "", const std::string& options = "") {
  return compiled("layout(std430, binding = 0) buffer Words { uint words[]; };\n" + before + "\nvoid main() {\n" + body + "\n}\n", options);
}

}  // namespace rainref::spirv
