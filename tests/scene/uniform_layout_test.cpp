// Layouts are printed in each language, and compiled they have the offsets of the block.
#include "scene/uniform_layout.h"

#include <array>
#include <cstdlib>

#include <fmt/format.h>

#include "base/shell.h"
#include "base/temporary_folder.h"
#include "scene/binding_layout.h"
#include "scene/example_effect.h"

namespace rainref::scene {
namespace {

// Every scalar type and every vector length, with gaps within a row, at its end and at the end of the block.
struct WaveStepUniforms {
  std::array<float, 3> camera_position;
  float pixel_scale;
  std::int32_t drop_count;
  float padding0;
  std::array<float, 2> texel;
  std::array<std::uint32_t, 2> seed_bits;
  std::uint32_t frame_index;
  float padding1;
  std::array<std::int32_t, 3> cell;
  float padding2;
  std::array<float, 4> tint;
  std::array<std::int32_t, 2> wave_size;
  float padding3[2];
  std::array<std::uint32_t, 4> hash_bits;
  std::array<std::int32_t, 4> bounds;
  float time;
  float padding4[3];
};

UniformBlock uniforms() {
  return uniform_block<WaveStepUniforms>({
      member<&WaveStepUniforms::camera_position>("m", any_word, "Where the camera is."),
      member<&WaveStepUniforms::pixel_scale>("1", any_word, "Height of a pixel at distance 1."),
      member<&WaveStepUniforms::drop_count>("1", any_word, "Number of drops."),
      member<&WaveStepUniforms::texel>("1", any_word, "One over the size."),
      member<&WaveStepUniforms::seed_bits>("1", any_word, "The seed."),
      member<&WaveStepUniforms::frame_index>("frame", any_word, "The frame."),
      member<&WaveStepUniforms::cell>("1", any_word, "The cell."),
      member<&WaveStepUniforms::tint>("1", any_word, "The tint."),
      member<&WaveStepUniforms::wave_size>("texel", any_word, "Size of the wave buffer."),
      member<&WaveStepUniforms::hash_bits>("1", any_word, "A hash."),
      member<&WaveStepUniforms::bounds>("texel", any_word, "A rectangle."),
      member<&WaveStepUniforms::time>("s", any_word, "Time of the frame."),
  });
}

struct Drop {
  float x, y;
  float strength;
  float padding0;
  std::array<float, 2> velocity;
  std::uint32_t id;
  float padding1;
};

UniformBlock drop() {
  return record<Drop>({
      member<&Drop::x>("texel", "Centre."),
      member<&Drop::y>("texel", "Centre."),
      member<&Drop::strength>("1", "Strength."),
      member<&Drop::velocity>("texel/s", "Velocity."),
      member<&Drop::id>("1", "Stable id."),
  });
}

class LayoutFile : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const { put(folder_ / name, text); }
  // The output of a shell command, which must succeed.
  static std::string output(const std::string& command) {
    const auto [text, status] = output_of(command);
    EXPECT_EQ(status, 0) << command << "\n" << text;
    return text;
  }
  // "name offset" lines and "size N", as this C or C++ compiler lays the structs out.
  std::string offsets(const std::string& compiler, const std::string& file, const std::string& source) const {
    std::string program = "#include <stddef.h>\n#include <stdio.h>\n" + source + "int main(void) {\n";
    for (const UniformBlock& block : {uniforms(), drop()}) {
      for (const Member& m : block.members) {
        program += fmt::format("  printf(\"{1} %d\\n\", (int)offsetof({0}, {1}));\n", block.name, m.name);
      }
      program += fmt::format("  printf(\"size %d\\n\", (int)sizeof({}));\n", block.name);
    }
    write(file, program + "  return 0;\n}\n");
    output(fmt::format("{} -Wall -Wextra -Werror -pedantic -o {} {}", compiler, path("program"), path(file)));
    return output(path("program"));
  }
  static std::string expected_offsets() {
    std::string out;
    for (const UniformBlock& block : {uniforms(), drop()}) {
      for (const Member& m : block.members) out += fmt::format("{} {}\n", m.name, m.offset);
      out += fmt::format("size {}\n", block.size);
    }
    return out;
  }

  TemporaryFolder folder_;
};

TEST_F(LayoutFile, CompiledCHasTheOffsetsOfTheBlock) {
  const std::string source = layout(uniforms(), Language::c) + record_layout(drop(), Language::c);
  EXPECT_EQ(offsets("cc -std=c99", "layout.c", source), expected_offsets());
}

TEST_F(LayoutFile, CompiledCudaHasTheOffsetsOfTheBlock) {
  // The alignments of CUDA's vector types, from its programming guide.
  std::string types;
  for (const auto& [name, of] : {std::pair("float", "float"), std::pair("int", "int"), std::pair("uint", "unsigned int")}) {
    types += fmt::format(
        "struct alignas(8) {0}2 {{ {1} x, y; }};\nstruct {0}3 {{ {1} x, y, z; }};\n"
        "struct alignas(16) {0}4 {{ {1} x, y, z, w; }};\n",
        name, of);
  }
  const std::string source = types + layout(uniforms(), Language::cuda) + record_layout(drop(), Language::cuda);
  EXPECT_EQ(offsets("c++ -std=c++17", "layout.cpp", source), expected_offsets());
}

// The offset that glslang's reflection gives each member, where it lists it: "….name: offset N, …".
void expect_reflected(const std::string& reflection, const UniformBlock& block) {
  for (const Member& m : block.members) {
    EXPECT_THAT(reflection, testing::ContainsRegex(fmt::format("[^a-z_]{}: offset {},", m.name, m.offset)));
  }
}

// Also when glslangValidator is on PATH: GLSL and HLSL compile, and reflection finds the same offsets. Elsewhere this
// test checks the printed text alone.
TEST_F(LayoutFile, ShadersDeclareTheBlock) {
  const ListBinding list{"drops", "Drop"};
  const std::string glsl = layout(uniforms(), Language::glsl), hlsl = layout(uniforms(), Language::hlsl);
  const std::string glsl_record = record_layout(drop(), Language::glsl) + list_layout(list, Language::glsl);
  const std::string hlsl_record = record_layout(drop(), Language::hlsl) + list_layout(list, Language::hlsl);
  EXPECT_THAT(glsl, testing::HasSubstr("layout(std140, binding = 0) uniform WaveStepUniforms {"));
  EXPECT_THAT(hlsl, testing::HasSubstr("cbuffer WaveStepUniforms : register(b0) {"));
  if (std::system("command -v glslangValidator > /dev/null 2>&1") != 0) return;
  write("a.comp", "#version 450\n" + glsl + glsl_record +
                      "layout(std430, binding = 2) buffer Out { float result; };\n"
                      "void main() { result = wave_step_uniforms.time + drops[1].strength; }\n");
  const std::string options = " -l -q --reflect-all-block-variables -S comp ";
  const std::string reflected = output("glslangValidator" + options + path("a.comp"));
  expect_reflected(reflected, uniforms());
  expect_reflected(reflected, drop());
  write("a.hlsl", hlsl + hlsl_record +
                      "RWStructuredBuffer<float> result : register(u0);\n"
                      "[numthreads(1, 1, 1)] void main() { result[0] = time + drops[1].strength; }\n");
  expect_reflected(output("glslangValidator -V -o " + path("a.spv") + " -D -e main" + options + path("a.hlsl")), uniforms());
}

// A block of one row for the exact texts.
struct SmallUniforms {
  std::array<float, 2> texel;
  std::uint32_t frame_index;
  float padding0;
};
UniformBlock small() {
  return uniform_block<SmallUniforms>({member<&SmallUniforms::texel>("1", any_word, "One over the size."),
                                       member<&SmallUniforms::frame_index>("frame", any_word, "The frame.")});
}
const std::string head = "// SmallUniforms: 16 bytes, little endian. Comments: offset in bytes, [unit], meaning.\n";

TEST(Layout, C) {
  EXPECT_EQ(layout(small(), Language::c), head + R"(#include <stdint.h>
#ifndef rainref_float2_DEFINED
#define rainref_float2_DEFINED
typedef struct { float x, y; } rainref_float2;
#endif
typedef struct {
  rainref_float2 texel;  //   0  [1] One over the size.
  uint32_t frame_index;  //   8  [frame] The frame.
  float padding_0;       //  12  padding
} SmallUniforms;
typedef char SmallUniforms_has_16_bytes[sizeof(SmallUniforms) == 16 ? 1 : -1];
)");
}

TEST(Layout, Cuda) {
  EXPECT_EQ(layout(small(), Language::cuda), head + R"(struct SmallUniforms {
  float2 texel;              //   0  [1] One over the size.
  unsigned int frame_index;  //   8  [frame] The frame.
  float padding_0;           //  12  padding
};
static_assert(sizeof(SmallUniforms) == 16, "layout of SmallUniforms");
)");
}

TEST(Layout, Glsl) {
  EXPECT_EQ(layout(small(), Language::glsl), head + R"(layout(std140, binding = 0) uniform SmallUniforms {
  vec2 texel;        //   0  [1] One over the size.
  uint frame_index;  //   8  [frame] The frame.
  float padding_0;   //  12  padding
} small_uniforms;
)");
}

TEST(Layout, Hlsl) {
  EXPECT_EQ(layout(small(), Language::hlsl), head + R"(cbuffer SmallUniforms : register(b0) {
  float2 texel;      //   0  [1] One over the size.
  uint frame_index;  //   8  [frame] The frame.
  float padding_0;   //  12  padding
};
)");
}

TEST(Layout, Wgsl) {
  EXPECT_EQ(layout(small(), Language::wgsl), head + R"(struct SmallUniforms {
  texel : vec2<f32>,  //   0  [1] One over the size.
  frame_index : u32,  //   8  [frame] The frame.
  padding_0 : f32,    //  12  padding
}
@group(0) @binding(0) var<uniform> small_uniforms : SmallUniforms;
)");
}

TEST(Layout, ListsAreBoundWhereThePassHasThem) {
  EXPECT_THAT(record_layout(drop(), Language::c), testing::HasSubstr("} Drop;\n"));
  const ListBinding read{"count_thresholds", "CountThreshold", false, {2, 1}}, written{"drops_out", "Drop", true, {3, 0}, 1};
  EXPECT_EQ(list_layout(read, Language::glsl),
            "layout(std430, binding = 2) readonly buffer CountThresholdsBuffer { CountThreshold count_thresholds[]; };\n");
  EXPECT_EQ(list_layout(read, Language::hlsl), "StructuredBuffer<CountThreshold> count_thresholds : register(t1);\n");
  EXPECT_EQ(list_layout(read, Language::wgsl), "@group(0) @binding(2) var<storage, read> count_thresholds : array<CountThreshold>;\n");
  EXPECT_EQ(list_layout(written, Language::glsl), R"(layout(std430, binding = 3) buffer DropsOutBuffer {
  uint drops_out_count;
  uint drops_out_padding[3];
  Drop drops_out[];
};
)");
  EXPECT_EQ(list_layout(written, Language::hlsl),
            "RWStructuredBuffer<Drop> drops_out : register(u0);\nRWStructuredBuffer<uint> drops_out_count : register(u1);\n");
  EXPECT_EQ(list_layout(written, Language::wgsl), R"(struct DropsOutBuffer {
  count : u32,
  padding_0 : u32,
  padding_1 : u32,
  padding_2 : u32,
  records : array<Drop>,
}
@group(0) @binding(3) var<storage, read_write> drops_out : DropsOutBuffer;
)");
  for (const Language language : {Language::c, Language::cuda}) EXPECT_EQ(list_layout(read, language), "");
}

TEST(Layout, RefusesABlockThatIsNotTheSameEverywhere) {
  const UniformBlock bad{"Bad", 16, {{"a", Scalar::float32, 3, 4, "m", "A."}}};
  for (const Language language : {Language::c, Language::wgsl}) {
    EXPECT_EQ(error_of([&] { layout(bad, language); }), "5 layout Bad: 'a' at 4 is not aligned to 16");
    EXPECT_EQ(error_of([&] { record_layout(bad, language); }), "5 layout Bad: 'a' at 4 is not aligned to 16");
  }
}

TEST(Layout, LanguagesHaveNames) {
  for (const char* language : {"c", "glsl", "hlsl", "wgsl", "cuda", "glsl330", "gdshader"}) {
    EXPECT_STREQ(name(language_from_name(language)), language);
  }
  EXPECT_EQ(error_of([] { language_from_name("wglsl"); }),
            "2 layout: expected one of 'c', 'glsl', 'hlsl', 'wgsl', 'cuda', 'glsl330', 'gdshader', found 'wglsl'; did you mean 'glsl'?");
}

}  // namespace
}  // namespace rainref::scene
