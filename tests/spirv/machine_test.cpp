// Small shaders whose results are known: integers, numbers, matrices, branches, memory, workgroups.
#include <bit>

#include "math/numbers.h"
#include "math/path_enumeration.h"
#include "math/profiles.h"
#include "source_folder.h"
#include "spirv/any_module.h"
#include "spirv/compiled.h"

namespace rainref::spirv {
namespace {

constexpr std::uint32_t ones = 0xffffffffu;

/// The words after main() made the body of them; 64 words, of which the first are `given`.
std::vector<std::uint32_t> run(const std::vector<std::byte>& spirv, const std::vector<std::uint32_t>& given = {}) {
  const Module module(spirv, "'test.spv'");
  std::vector<std::byte> buffer(256);
  std::memcpy(buffer.data(), given.data(), 4 * given.size());
  const MadeUp bound(module, buffer);
  Machine<Float> machine(module, bound.resources());
  dispatch(machine, {1, 1, 1});
  return bound.words(0);
}
std::vector<float> run_floats(const std::string& body, const std::vector<float>& given, std::size_t count, const std::string& before = "") {
  std::vector<std::uint32_t> words;
  for (const float x : given) words.push_back(std::bit_cast<std::uint32_t>(x));
  std::vector<float> out;
  const std::string accessors =
      "float f(int i) { return uintBitsToFloat(words[i]); }\nvoid put(int i, float x) { words[i] = floatBitsToUint(x); }\n";
  for (const std::uint32_t w : run(compiled_body(body, accessors + before), words)) out.push_back(std::bit_cast<float>(w));
  out.resize(count);
  return out;
}
std::vector<std::uint32_t> first(std::vector<std::uint32_t> words, std::size_t count) {
  words.resize(count);
  return words;
}

TEST(Machine, IntegersAreThoseOfTheLanguage) {
  RAINREF_NEED_COMPILER();
  const auto words = run(compiled_body(R"(
    int a = int(words[0]), b = int(words[1]);
    uint c = words[0];
    words[2] = uint(a / b); words[3] = c / 7u; words[4] = c % 7u; words[5] = uint(a >> 2); words[6] = c >> 2;
    words[7] = uint(bitfieldExtract(a, 1, 3)); words[8] = bitfieldExtract(c, 1, 3); words[9] = bitfieldInsert(0u, 5u, 4, 3);
    words[10] = uint(bitCount(c)); words[11] = bitfieldReverse(1u); words[12] = uint(findMSB(c)); words[13] = uint(findLSB(8u));
    uint high, low, carry; umulExtended(c, c, high, low); words[14] = high; words[15] = low;
    words[16] = uaddCarry(c, 9u, carry); words[17] = carry; words[18] = uint(clamp(a, -3, 3)); words[19] = ~c ^ (c << 3);)"),
                         {0u - 9u, 4});
  EXPECT_EQ(first({words.begin() + 2, words.end()}, 18),
            (std::vector<std::uint32_t>{0u - 2u, 4294967287u / 7u, 4294967287u % 7u, 0u - 3u, 4294967287u >> 2, 3, 3, 5u << 4, 31, 1u << 31,
                                        31, 3, static_cast<std::uint32_t>(std::uint64_t{4294967287u} * 4294967287u >> 32), 81, 0, 1,
                                        0u - 3u, 8u ^ (4294967287u << 3)}));
}
// Whole numbers, so that every product and sum is exact. The inverses are those that mathematics gives.
TEST(Machine, DeterminantsAndInversesAreExactOfWholeNumbers) {
  RAINREF_NEED_COMPILER();
  const std::vector<float> found = run_floats(R"(
    mat2 a = mat2(f(0), 2.0, 3.0, 8.0);
    mat3 b = mat3(f(1), 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 3.0, 1.0);
    mat4 c = mat4(f(1), 0.0, 0.0, 5.0, 0.0, 1.0, 0.0, 0.0, 0.0, 7.0, 4.0, 0.0, 1.0, 0.0, 0.0, 3.0);
    mat2 p = inverse(a); mat3 q = inverse(b); mat4 r = inverse(c);
    put(0, determinant(a)); put(1, determinant(b)); put(2, determinant(c));
    put(3, p[0][0]); put(4, p[0][1]); put(5, p[1][0]); put(6, p[1][1]);
    mat3 one = b * q; mat4 unit = r * c;
    float off = 0.0;
    for (int i = 0; i < 3; ++i) for (int k = 0; k < 3; ++k) off += abs(one[i][k] - float(i == k));
    for (int i = 0; i < 4; ++i) for (int k = 0; k < 4; ++k) off += abs(unit[i][k] - float(i == k));
    put(7, off);)",
                                              {1, 2}, 8);
  // det b = 2 (1 - 0) - 1 (0 - 3) = 5 by columns; 1/5 is rounded, so its products are off by a few units of 2^-24.
  EXPECT_EQ(std::vector<float>(found.begin(), found.begin() + 7), (std::vector<float>{2, 5, 4, 4, -1, -1.5f, 0.5f}));
  EXPECT_LE(found[7], 16 * 0x1p-22f);
}
// For SPIR-V 1.0 glslang writes lines of its own before the source, and `#line 1`.
TEST(Machine, ALineHasItsOwnTextForEachTarget) {
  RAINREF_NEED_COMPILER();
  const std::string first = "layout(local_size_x = 1) in;", second = "layout(std430, binding = 0) buffer Words { float words[]; };",
                    third = "void main() { words[1] = sqrt(words[0]); }";
  for (const char* target : {"vulkan1.0", "vulkan1.1"}) {
    const Module module(compiled(first + "\n" + second + "\n" + third + "\n", std::string("-g --target-env ") + target), "'test.spv'");
    int lines = 0;
    for (std::uint32_t i = 0; i < module.code.size(); ++i) {
      const capture::SourceLine line = module.source_line(i);
      if (line.line == 0) continue;
      EXPECT_EQ(line.line, 4u) << target;  // compiled() begins with #version
      EXPECT_EQ(line.text, third) << target;
      ++lines;
    }
    EXPECT_GT(lines, 3) << target;
  }
}
// What SPIR-V leaves open has one result, and no trap.
TEST(Machine, UndefinedIntegersHaveOneResult) {
  RAINREF_NEED_COMPILER();
  const auto words = run(compiled_body(R"(
    int least = int(words[0]), zero = int(words[1]);
    words[2] = uint(least / -1 + zero); words[3] = uint(least / zero); words[4] = words[0] % words[1]; words[5] = 1u << (words[1] + 33u);
    float huge = uintBitsToFloat(0x7f800000u) + float(zero);
    words[6] = uint(int(huge)); words[7] = uint(huge); words[8] = uint(-huge); words[9] = uint(int(uintBitsToFloat(0x7fc00000u)));)"),
                         {1u << 31, 0});
  EXPECT_EQ(first({words.begin() + 2, words.end()}, 8), (std::vector<std::uint32_t>{1u << 31, 0, 1u << 31, 2, 0x7fffffffu, ones, 0, 0}));
}

TEST(Machine, NumbersAreThoseOfOurModels) {
  RAINREF_NEED_COMPILER();
  const std::vector<float> x{0.7f, -2.25f, 2.5f, 8.0f};
  const std::vector<float> got = run_floats(R"(
    float a = f(0), b = f(1), c = f(2), d = f(3);
    put(4, exp(a)); put(5, pow(a, c)); put(6, atan(b, a)); put(7, mix(a, b, c)); put(8, mod(b, 2.0)); put(9, roundEven(c)); put(10, log2(d));
    put(11, sign(b)); put(12, trunc(b)); put(13, ceil(b)); put(14, inversesqrt(d)); put(15, length(vec2(a, b)));
    put(16, dot(vec4(a, b, c, d), vec4(d, c, b, a))); vec3 n = normalize(vec3(a, b, c)); put(17, n.x); put(18, cross(vec3(a, b, c), n).z);
    put(19, smoothstep(0.0, 2.0, a)); put(20, step(a, b)); put(21, unpackHalf2x16(packHalf2x16(vec2(a, b))).x); put(22, fma(a, b, c));
    put(23, refract(vec3(0, 0, -1), vec3(0, 0, 1), a).z); put(24, reflect(vec2(a, b), vec2(0, 1)).y); put(25, asin(a)); put(26, tan(a));
    put(27, isnan(0.0 / (a - a)) ? 1.0 : 0.0); put(28, fract(b)); put(29, unpackUnorm4x8(packUnorm4x8(vec4(a))).x); put(30, distance(a, b));)",
                                            x, 31);
  using namespace scalar;
  using S = Scalar<float>;
  const S a(x[0]), b(x[1]), c(x[2]), d(x[3]), one(1.0f);
  const Vec3<S> n = normalize(Vec3<S>(a, b, c));
  const S asine = atan2(a, sqrt(one - a * a));
  const std::vector<float> expected{exp(a).v,
                                    pow(a, c).v,
                                    atan2(b, a).v,
                                    mix(a, b, c).v,
                                    1.75f,
                                    2.0f,
                                    3.0f,
                                    -1.0f,
                                    -2.0f,
                                    -2.0f,
                                    (one / sqrt(d)).v,
                                    length(a, b).v,
                                    (((a * d + b * c) + c * b) + d * a).v,
                                    n.x.v,
                                    (a * n.y - b * n.x).v,
                                    smoothstep(0.0f, 2.0f, a).v,
                                    0.0f,
                                    rainref::to_float(to_half(x[0])),
                                    (a * b + c).v,
                                    -1.0f,
                                    2.25f,
                                    asine.v,
                                    (sin(a) / cos(a)).v,
                                    1.0f,
                                    0.75f,
                                    rainref::to_float(to_unorm8(x[0])),
                                    2.95f};
  EXPECT_EQ(std::vector<float>(got.begin() + 4, got.end()), expected);
}

TEST(Machine, MatricesAreByColumns) {
  RAINREF_NEED_COMPILER();
  // m = (1 3 5; 2 4 6): three columns of two.
  const std::vector<float> got = run_floats(R"(
    mat3x2 m = mat3x2(f(0), f(1), f(2), f(3), f(4), f(5));
    int k = int(f(6)); vec2 right = m * vec3(1, 10, 100); vec3 left = vec2(1, 10) * m; mat3 square = transpose(m) * m; mat2x3 outer = outerProduct(vec3(1, 2, 3), vec2(4, 5));
    put(0, right.x); put(1, right.y); put(2, left.x); put(3, left.z); put(4, square[2][1]); put(5, (m * 2.0)[1].y); put(6, outer[1].z);
    put(7, m[k].y); put(8, vec3(7, 8, 9)[k]); vec3 v = vec3(0); v[k] = 4.0; put(9, v.z);)",
                                            {1, 2, 3, 4, 5, 6, 2}, 10);
  EXPECT_EQ(got, (std::vector<float>{531, 642, 21, 65, 39, 8, 15, 6, 9, 4}));
}
// Rows lie one behind the other in the buffer, with 16 bytes each.
TEST(Machine, BuffersAreReadByTheirLayout) {
  RAINREF_NEED_COMPILER();
  const std::vector<std::byte> spirv = compiled(R"(
    struct Part { vec3 v; float s; };
    layout(std140, row_major, binding = 0) buffer Block { uint words[2]; layout(offset = 32) mat2x3 m; layout(offset = 80) Part parts[]; } u;
    void main() { vec2 row = vec2(u.m[0].z, u.m[1].y); Part p = u.parts[1]; p.s += row.x; u.parts[0] = p; u.words[1] = uint(row.y); u.words[0] = u.parts.length(); })");
  std::vector<std::uint32_t> given(64);
  const auto number = [&](std::size_t byte, float x) { given[byte / 4] = std::bit_cast<std::uint32_t>(x); };
  number(32 + 2 * 16, 5);      // row 2, column 0
  number(32 + 16 + 4, 7);      // row 1, column 1
  number(80 + 16 + 8, 3);      // parts[1].v.z
  number(80 + 16 + 12, 0.5f);  // parts[1].s
  const auto words = run(spirv, given);
  EXPECT_EQ(words[4], 7u);
  EXPECT_EQ(words[0], (256u - 80u) / 16u);
  EXPECT_EQ(std::bit_cast<float>(words[80 / 4 + 2]), 3.0f);
  EXPECT_EQ(std::bit_cast<float>(words[80 / 4 + 3]), 5.5f);
}

TEST(Machine, LoopsSwitchesAndCallsBranch) {
  RAINREF_NEED_COMPILER();
  const std::string body = R"(
    int a = 1, b = 1;
    for (int i = 0; i < 10; ++i) { int c = a; a = b; b = c + b; if (i == 8) continue; if (i == 9) break; words[1] += 1u; }
    words[0] = uint(a);
    for (int i = 0; i < 4; ++i) switch (i) { case 0: words[2] = 5u; case 2: words[3] += 1u; break; case 7: words[4] = 9u; break; default: words[5] += twice(uint(i)); }
    int twin[3] = int[3](7, 8, 9); words[6] = uint(twin[int(words[7])]);)";
  const std::string twice = "uint twice(uint x) { if (x > 2u) return 100u; return 2u * x; }";
  const std::vector<std::uint32_t> expected{89, 8, 5, 2, 0, 102, 8, 1};
  EXPECT_EQ(first(run(compiled_body(body, twice), {0, 0, 0, 0, 0, 0, 0, 1}), 8), expected);
}
// Values of a loop that take each other's place: in SSA they are two OpPhi that read each other.
TEST(Machine, PhisTakeTheValuesOfBefore) {
  const std::string seed = test::source_folder() + "/tests/fuzz/seeds/spirv/";
  for (const char* name : {"picture.spv", "picture_opt.spv"}) EXPECT_NO_THROW(execute_any(read_file(seed + name))) << name;
  const Module plain(read_file(seed + "picture.spv"), "a"), optimized(read_file(seed + "picture_opt.spv"), "b");
  std::vector<std::byte> buffer(256, std::byte{0});
  const std::array<float, 24> values{1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 0.5f, 0.25f, 1, 0.5f};
  std::memcpy(buffer.data(), values.data(), sizeof values);
  const std::uint32_t count = 6;
  std::memcpy(buffer.data() + 64, &count, 4);
  std::vector<std::vector<std::byte>> pictures;
  for (const Module* module : {&plain, &optimized}) {
    const MadeUp bound(*module, buffer);
    Machine<Float> machine(*module, bound.resources());
    dispatch(machine, {2, 2, 1});
    for (const Resource<Float>& r : bound.resources())
      if (r.storage != nullptr) pictures.push_back(static_cast<StoredImage*>(r.storage)->array().levels[0]);
  }
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_EQ(pictures[0], pictures[1]);
  EXPECT_NE(pictures[0], std::vector<std::byte>(pictures[0].size()));
}

TEST(Machine, WorkgroupsShareMemoryAndWaitForEachOther) {
  RAINREF_NEED_COMPILER();
  const std::vector<std::byte> spirv = compiled(R"(
    layout(local_size_x = 8) in;
    layout(std430, binding = 0) buffer Words { uint words[]; };
    shared uint mine[8], most;
    void main() {
      uint i = gl_LocalInvocationIndex;
      if (i == 0u) most = 0u;
      mine[i] = i * i;
      barrier();
      words[i] = mine[7u - i];
      atomicMax(most, mine[i]); atomicAdd(words[8], 1u + i); atomicXor(words[9], 1u << i);
      if (i > 3u) return;
      uint before = atomicCompSwap(words[10], i, i + 1u);
      words[11 + i] = before;
      // The last one waits until the others have come by.
      if (i == 0u) for (int k = 0; k < 1000 && atomicOr(words[15], 0u) < 3u; ++k);
      if (i != 0u) atomicAdd(words[15], 1u);
      words[16 + i] = most;
    })");
  EXPECT_EQ(first(run(spirv), 17), (std::vector<std::uint32_t>{49, 36, 25, 16, 9, 4, 1, 0, 36, 255, 4, 0, 1, 2, 3, 3, 49}));
}

TEST(Machine, SpecializationIsDoneHere) {
  RAINREF_NEED_COMPILER();
  const std::vector<std::byte> spirv = compiled(R"(
    layout(constant_id = 3) const int N = 2; layout(constant_id = 4) const bool LONG = false; layout(constant_id = 5) const float SHARE = 0.5;
    const int M = LONG ? 3 * N + 1 : N;
    layout(std430, binding = 0) buffer Words { uint words[]; };
    void main() { uint kept[M]; for (int i = 0; i < M; ++i) kept[i] = uint(i); words[0] = uint(kept.length()); words[1] = kept[M - 1]; words[2] = uint(SHARE * 8.0); })");
  const auto with = [&](const Specialization& values) {
    const Module module(spirv, "'test.spv'", values);
    const MadeUp bound(module);
    Machine<Float> machine(module, bound.resources());
    dispatch(machine, {1, 1, 1});
    return first(bound.words(0), 3);
  };
  EXPECT_EQ(with({}), (std::vector<std::uint32_t>{2, 1, 4}));
  EXPECT_EQ(with({{3, 5}, {4, 1}, {5, std::bit_cast<std::uint32_t>(2.0f)}}), (std::vector<std::uint32_t>{16, 15, 16}));
}

/// What an invocation wrote, with any number.
template <class N>
class Written final : public StorageImage<N> {
 public:
  Written() : StorageImage<N>(1, 1) {}
  void write(int, int, const N* texel, int) override { value = texel[0]; }
  void read(int, int, N*) const override {}
  N value;
};
// The same machine with intervals: both answers of an open comparison are given, one after the other.
template <class N>
std::vector<N> answers(const Module& module) {
  const std::vector<float> texels{0.25f};
  SampledImage image;
  image.texture = {texels.data(), 1, 1, {1}, {1}, {0}};
  image.is_linear = true;
  Written<N> written;
  std::vector<Resource<N>> resources(module.descriptors.size());
  for (std::size_t i = 0; i < resources.size(); ++i) {
    if (module.descriptors[i].bound == Bound::sampled_image) resources[i].image = &image;
    if (module.descriptors[i].bound == Bound::storage_image) resources[i].storage = &written;
  }
  Machine<N> machine(module, resources);
  Invocation<N> invocation(machine);
  std::vector<N> all;
  enclosed::PathEnumeration paths;
  EXPECT_TRUE(paths.for_each_alternative([&] {
    invocation.begin({});
    EXPECT_EQ(invocation.run(), Stop::finished);
    all.push_back(written.value);
  }));
  return all;
}
TEST(Machine, EnclosuresAreExecutedToo) {
  RAINREF_NEED_COMPILER();
  const std::vector<std::byte> spirv = compiled(R"(
    layout(binding = 0) uniform sampler2D image; layout(binding = 1) uniform writeonly image2D given;
    void main() {
      float x = textureLod(image, vec2(0.5), 0.0).x / 3.0 + 1.0;
      imageStore(given, ivec2(0), vec4(x > 0.25 / 3.0 + 1.0 ? exp(x) : -x));
    })");
  const Module module(spirv, "'test.spv'");
  const float x = 0.25f / 3.0f + 1.0f;
  ASSERT_EQ(answers<Float>(module).size(), 1u);
  EXPECT_EQ(answers<Float>(module)[0].v, -x);
  const auto exact = answers<enclosed::Enclosure>(module);
  ASSERT_EQ(exact.size(), 1u);
  EXPECT_TRUE(exact[0].is_point() && exact[0].contains(-x));
  const enclosed::Profile& vulkan = test::profile_named("vulkan");
  const enclosed::ProfileScope scope(vulkan);
  const auto open = answers<enclosed::Enclosure>(module);
  ASSERT_EQ(open.size(), 2u);
  const auto any_contains = [&](float value) { return open[0].contains(value) || open[1].contains(value); };
  EXPECT_TRUE(any_contains(-x));
  EXPECT_TRUE(any_contains(exp(Float(x)).v));
  EXPECT_FALSE(any_contains(0));
}

}  // namespace
}  // namespace rainref::spirv
