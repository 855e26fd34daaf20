// What cannot be executed is refused in one sentence, with the shader's line where the module says it; nothing crashes.
#include <gmock/gmock.h>

#include <functional>

#include "source_folder.h"
#include "spirv/any_module.h"
#include "spirv/compiled.h"

namespace rainref::spirv {
namespace {

using testing::AllOf, testing::EndsWith, testing::HasSubstr, testing::StartsWith;

const std::string seeds = test::source_folder() + "/tests/fuzz/seeds/spirv/";
std::vector<std::byte> seed(const std::string& name) { return read_file(seeds + name); }

/// What is said of a module; "" where it is executed.
std::string refusal(const std::vector<std::byte>& spirv) {
  try {
    execute_any(spirv);
  } catch (const Refusal& e) {
    EXPECT_EQ(e.code(), ExitCode::port_files);
    EXPECT_THAT(e.what(), StartsWith("'a.spv': "));
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return std::string(e.what()).substr(9);
  }
  return "";
}

std::vector<std::uint32_t> words_of(const std::vector<std::byte>& bytes) {
  std::vector<std::uint32_t> words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), bytes.size());
  return words;
}
std::vector<std::byte> bytes_of(const std::vector<std::uint32_t>& words) {
  std::vector<std::byte> bytes(4 * words.size());
  std::memcpy(bytes.data(), words.data(), bytes.size());
  return bytes;
}
/// Calls f(words of an instruction) for the first one of this kind that it is willing to change.
std::vector<std::byte> changed(const std::vector<std::byte>& bytes, Op op, const std::function<bool(std::span<std::uint32_t>)>& f) {
  std::vector<std::uint32_t> words = words_of(bytes);
  for (std::size_t at = 5; at < words.size(); at += words[at] >> 16) {
    if (static_cast<Op>(words[at] & 0xffffu) == op && f(std::span(words).subspan(at, words[at] >> 16))) return bytes_of(words);
  }
  ADD_FAILURE() << "no instruction to change";
  return bytes;
}

TEST(Refusals, NoSpirv) {
  EXPECT_EQ(refusal({}), "expected SPIR-V, found 0 bytes");
  EXPECT_EQ(refusal(std::vector<std::byte>(20)), "expected SPIR-V, found no magic number of it");
  EXPECT_EQ(refusal(bytes_of({0x07230203, 0x10300, 0, 0xffffffff, 0})), "a bound of 4294967295 ids is not read, at most 1048576");
  EXPECT_EQ(refusal(bytes_of({0x07230203, 0x10300, 0, 8, 0})), "it has no entry point of a compute shader");
}
TEST(Refusals, EveryTruncationAtAWord) {
  for (const char* name : {"list.spv", "picture.spv", "picture_opt.spv", "list_debug.spv"}) {
    const std::vector<std::byte> whole = seed(name);
    EXPECT_EQ(refusal(whole), "") << name;
    for (std::size_t size = 0; size < whole.size(); size += 4)
      EXPECT_NE(refusal({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}), "");
  }
}
// Each word of each instruction, one after the other: refused or executed, in little time.
TEST(Refusals, EveryWordChanged) {
  int refused = 0, all = 0;
  for (const char* name : {"list.spv", "picture_opt.spv"}) {
    const std::vector<std::uint32_t> words = words_of(seed(name));
    for (std::size_t i = 3; i < words.size(); ++i) {
      for (const std::uint32_t wrong : {0u, words[i] + 1, words[i] - 1, 0x7fffffffu, 0xffffffffu}) {
        std::vector<std::uint32_t> other = words;
        other[i] = wrong;
        refused += refusal(bytes_of(other)) != "";
        ++all;
      }
    }
  }
  EXPECT_GT(refused, all / 4);
}

TEST(Refusals, IdsOutOfRange) {
  const auto with_id = [](Op op, std::size_t word, std::uint32_t id) {
    return refusal(changed(seed("list.spv"), op, [&](std::span<std::uint32_t> w) {
      w[word] = id;
      return true;
    }));
  };
  EXPECT_THAT(with_id(Op::Load, 3, 100000), HasSubstr("id 100000 is not below the bound of"));
  EXPECT_THAT(with_id(Op::Load, 3, 1), EndsWith("list.comp:8: id 1 of OpLoad is no value there"));
  EXPECT_THAT(with_id(Op::Branch, 1, 1), HasSubstr("OpBranch leads to id 1, which is no block of the function"));
  EXPECT_THAT(with_id(Op::BitwiseAnd, 4, 3), EndsWith("list.comp:11: id 3 of OpBitwiseAnd is no value there"));
}

TEST(Refusals, LoopsWithoutEnd) {
  RAINREF_NEED_COMPILER();
  const std::string said = refusal(compiled_body("while (words[0] == 0u) words[1] += 1u;", "", "-g"));
  EXPECT_THAT(said, AllOf(StartsWith("shader.comp:5: "), EndsWith("more than 20000 steps are not executed: is it a loop without end?")));
}
TEST(Refusals, Recursion) {
  RAINREF_NEED_COMPILER();
  const std::vector<std::byte> spirv = compiled_body(
      "words[0] = uint(outer(1.0));", "float inner(float x) { return x + 1.0; }\nfloat outer(float x) { return inner(x) * 2.0; }", "-g");
  std::uint32_t outer = 0;
  changed(spirv, Op::FunctionCall, [&](std::span<std::uint32_t> w) {  // main's is the first
    outer = w[3];
    return true;
  });
  const std::string said = refusal(changed(spirv, Op::FunctionCall, [&](std::span<std::uint32_t> w) {
    if (w[3] == outer) return false;
    w[3] = outer;
    return true;
  }));
  EXPECT_THAT(said, AllOf(HasSubstr("'outer("), EndsWith("calls itself: recursion is not executed")));
}
TEST(Refusals, CallsTooDeep) {
  RAINREF_NEED_COMPILER();
  std::string functions = "float f0(float x) { return x; }\n";
  for (int i = 1; i <= 40; ++i) functions += "float f" + std::to_string(i) + "(float x) { return f" + std::to_string(i - 1) + "(x); }\n";
  EXPECT_THAT(refusal(compiled_body("words[0] = uint(f40(1.0));", functions)), EndsWith("calls more than 32 deep are not executed"));
  // Twice each: 2^30 calls. The steps are bounded, too.
  functions = "float f0(float x) { return x; }\n";
  for (int i = 1; i <= 30; ++i) {
    const std::string below = "f" + std::to_string(i - 1) + "(x)";
    functions += "float f" + std::to_string(i) + "(float x) { return " + below + " + " + below + "; }\n";
  }
  EXPECT_THAT(refusal(compiled_body("words[0] = uint(f30(1.0));", functions)), HasSubstr("more than 20000 steps"));
}
TEST(Refusals, TooMuchMemory) {
  RAINREF_NEED_COMPILER();
  EXPECT_THAT(refusal(compiled_body("float a[4000000]; a[words[0]] = 1.0; words[1] = uint(a[2]);")),
              HasSubstr("a type of 4000000 numbers is not executed"));
  EXPECT_THAT(refusal(compiled_body("float a[600000], b[600000]; a[words[0]] = 1.0; b[words[1]] = 2.0; words[1] = uint(a[2] + b[1]);")),
              HasSubstr("variables of more than 1048576 numbers are not executed"));
  EXPECT_THAT(
      refusal(compiled_body("float a[300000]; a[words[0]] = 1.0; barrier(); words[1] = uint(a[2]);", "layout(local_size_x = 64) in;")),
      HasSubstr("take more memory than they may"));
}

TEST(Refusals, PlacesOutside) {
  RAINREF_NEED_COMPILER();
  EXPECT_EQ(refusal(compiled_body("words[words[0] + 64u] = 1u;", "", "-g")), "shader.comp:5: writes bytes 256 to 260 of '', which has 256");
  EXPECT_EQ(refusal(compiled_body("words[0] = words[words[0] - 1u];", "", "-g")),
            "shader.comp:5: element -1 of an array in a buffer is asked for");
  EXPECT_EQ(refusal(compiled_body("uint a[3]; a[words[0] + 3u] = 2u; words[1] = a[words[2]];", "", "-g")),
            "shader.comp:5: element 3 of 3 is asked for");
  EXPECT_EQ(
      refusal(compiled("layout(binding = 0) readonly buffer Words { uint words[]; }; layout(binding = 1) uniform Block { vec4 a[40]; };"
                       "layout(binding = 2) buffer Out { float o; }; void main() { o = a[words[0] + 20u].x; }")),
      "reads bytes 320 to 324 of '', which has 256");
}
TEST(Refusals, WhatIsNotExecutedHasItsNameAndLine) {
  RAINREF_NEED_COMPILER();
  const std::string image = "layout(binding = 1) uniform sampler2D image;";
  EXPECT_EQ(refusal(compiled_body("words[0] = uint(textureGather(image, vec2(0.5)).x);", image, "-g")),
            "shader.comp:5: OpImageGather is not executed");
  EXPECT_THAT(refusal(compiled_body("words[0] = uint(textureGrad(image, vec2(0.5), vec2(0), vec2(0)).x);", image, "-g")),
              EndsWith("image operands 0x4 of OpImageSampleExplicitLod are not executed"));
  EXPECT_EQ(refusal(compiled_body("words[0] = uint(double(words[0]) * 2.0lf);")), "floats of 64 bits are not executed");
  EXPECT_EQ(refusal(compiled_body("words[0] = uint(texelFetch(cube, ivec3(0), 0).x);", "layout(binding = 1) uniform sampler3D cube;")),
            "images that have layers, samples or not two dimensions are not executed");
  EXPECT_THAT(refusal(compiled_body("mediump float low = float(words[0]); words[0] = uint(low * low);")),
              HasSubstr("RelaxedPrecision (mediump, min16float)"));
  EXPECT_THAT(refusal(compiled_body("words[0] = uint(sinh(asinh(float(words[0]))));", "", "-g")),
              "shader.comp:5: function 22 of GLSL.std.450 is not executed");
  EXPECT_THAT(refusal(compiled_body("words[0] = p.x;", "layout(push_constant) uniform P { uint x; } p;")), HasSubstr("push constant"));
}
TEST(Refusals, BarriersThatNotAllReach) {
  RAINREF_NEED_COMPILER();
  const std::string two = "layout(local_size_x = 2) in;";
  EXPECT_THAT(
      refusal(compiled_body(
          "if (gl_LocalInvocationIndex == 0u) { words[0] = 1u; barrier(); words[1] = 1u; } else { barrier(); words[2] = 2u; }", two)),
      HasSubstr("wait at this barrier while others wait at another one"));
}

// Both ways in which compilers write lines; and over the ends of blocks, where they write none.
TEST(Refusals, LinesOfBothKinds) {
  RAINREF_NEED_COMPILER();
  const std::string body = "uint i = words[0];\nuint k = i > 3u ? 1u :\n 2u;\nwords[k] = 1u / k; words[200] = 3u;";
  for (const char* option : {"-g", "-gVS"})
    EXPECT_THAT(refusal(compiled_body(body, "", option)), AllOf(HasSubstr("shader.comp:8: "), HasSubstr("writes bytes 800 to 804")))
        << option;
  EXPECT_THAT(refusal(compiled_body(body)), StartsWith("writes bytes 800 to 804")) << "a module without lines";
  try {
    execute_any(compiled_body(body, "", "-g"));
    ADD_FAILURE();
  } catch (const Refusal& e) {
    EXPECT_EQ(e.at().line, 8);
    EXPECT_EQ(e.at().file, "shader.comp");
  }
}

}  // namespace
}  // namespace rainref::spirv
