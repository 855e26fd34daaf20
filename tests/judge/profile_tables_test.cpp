// Each number of each profile against the specification that it claims to follow. The figures here are taken from the
// specifications, not from the data files; what no specification says is named a choice.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "image/code_range.h"
#include "judge/profiles.h"
#include "math/half.h"
#include "port_dump/apis.h"
#include "registry/registry.h"

namespace rainref::judge {
namespace {

using namespace enclosed;

Profile inexact(const char* name) {
  Profile p;
  p.name = name;
  p.reference = false;
  return p;
}
Accuracy ulp(double n) { return {n, 0, 0, 0}; }
Accuracy absolute(double error) { return {0, 0, 0, error}; }
Accuracy relative(double error) { return {0, 0, error, 0}; }
/// n + k |x| ULP.
Accuracy growing(double n, double k) { return {n, k, 0, 0}; }

constexpr double pi = 3.141592653589793, ln2 = 0.6931471805599453;

/// Vulkan 1.4, appendix "Vulkan Environment for SPIR-V", section "Precision and Operation of SPIR-V Instructions", the
/// columns of 32 bits; other places are named.
Profile vulkan() {
  Profile p = inexact("vulkan");
  p.basic = BasicRounding::either;                       // "Correctly Rounded": without a rounding mode either neighbour
  p.contraction = true;                                  // "Evaluation of Expressions": AllowContract by default
  p.flush = Flush::may;                                  // "Denormalized Values": may be flushed unless DenormPreserve
  p.rearrangement = Rearrangement::distributed;          // "Evaluation of Expressions" allows at least that; more is a choice against
  p.division = ulp(2.5);                                 // core instructions, OpFDiv, |y| in [2^-126, 2^126]
  p.inverse_sqrt = ulp(2);                               // GLSL.std.450, InverseSqrt
  p.sqrt_is_inherited = true;                            // Sqrt: from 1.0 / inversesqrt()
  p.exp = p.exp2 = growing(3, 2);                        // Exp, Exp2: 3 + 2 |x|
  p.log = p.log2 = ulp(3);                               // Log, Log2 outside [0.5, 2.0]
  p.log_near_one = p.log2_near_one = absolute(0x1p-21);  // inside
  p.pow_is_inherited = true;                             // Pow: from exp2(y log2(x))
  p.sin_cos = absolute(0x1p-11);                         // Sin, Cos inside [-pi, pi]
  p.sin_cos_domain = pi;
  p.sin_cos_beyond = 0x1p-12;                // a choice: nothing is promised there; VK-GL-CTS accepts |x| 2^-12
  p.atan2 = ulp(4096);                       // Atan2
  p.subtexel_bits = 8;                       // appendix "Core Revisions", 1.4: subTexelPrecisionBits from 4 to 8
  p.lod_bits = 6;                            // the same: mipmapPrecisionBits from 4 to 6
  p.coordinate_bits = 20;                    // a choice: as VK-GL-CTS verifies lookups
  p.unorm_load = ulp(1);                     // a choice
  p.half_store = StoreRounding::either;      // "Floating-Point Format Conversions": the mode is not defined
  p.half_overflow = StoreOverflow::either;   // the same: largest finite value or infinity
  p.unorm_store_ulp = p.srgb_store_ulp = 1;  // "Conversion From Floating-Point to Normalized Fixed-Point": a neighbour
  return p;
}

/// WGSL, section "Accuracy of Concrete Floating Point Expressions", the columns of f32; other places are named.
Profile webgpu() {
  Profile p = inexact("webgpu");
  p.basic = BasicRounding::either;                       // "Differences from IEEE-754": up or down
  p.contraction = true;                                  // "Reassociation and Fusion"
  p.flush = Flush::may;                                  // "Differences from IEEE-754": inputs and outputs may be flushed
  p.rearrangement = Rearrangement::distributed;          // "Reassociation and Fusion"; that factors are distributed too is a choice
  p.division = ulp(2.5);                                 // x / y, |y| in [2^-126, 2^126]
  p.inverse_sqrt = ulp(2);                               // inverseSqrt
  p.sqrt_is_inherited = true;                            // sqrt: from 1.0 / inverseSqrt(x)
  p.exp = p.exp2 = growing(3, 2);                        // exp, exp2: 3 + 2 |x|
  p.log = p.log2 = ulp(3);                               // log, log2 outside [0.5, 2.0]
  p.log_near_one = p.log2_near_one = absolute(0x1p-21);  // inside
  p.pow_is_inherited = true;                             // pow: from exp2(y log2(x))
  p.sin_cos = absolute(0x1p-11);                         // sin, cos in [-pi, pi]; nothing beyond
  p.sin_cos_domain = pi;
  p.atan2 = ulp(4096);                       // atan2
  p.subtexel_bits = 7;                       // a choice: WebGPU gives no number
  p.lod_bits = 4;                            // a choice
  p.coordinate_bits = 20;                    // a choice
  p.unorm_load = ulp(3);                     // unpack4x8unorm; for texture loads a choice
  p.atan2_domain = 0x1p126;                  // |x| in [2^-126, 2^126], and y finite and normal
  p.half_store = StoreRounding::either;      // "Floating Point Conversion": no rounding mode
  p.half_overflow = StoreOverflow::either;   // the same
  p.half_store_flush = true;                 // "Channel Formats", 16float: quantizeToF16, which may flush
  p.unorm_store_ulp = p.srgb_store_ulp = 1;  // a choice
  return p;
}

/// The Direct3D 11.3 functional specification, by its sections.
Profile d3d() {
  const double reciprocal = 1, product = 0.5;  // 3.1.3.1, x / y in two steps: ULP of each
  Profile p = inexact("d3d");
  p.basic = BasicRounding::nearest;              // 3.1.3.1: add, subtract, multiply 0.5 ULP to nearest even
  p.contraction = true;                          // 3.1.3.1: fused operations no worse than unfused ones
  p.flush = Flush::must;                         // 3.1.3.1: denorms are flushed
  p.rearrangement = Rearrangement::distributed;  // 22.3.2: b*c+b*d+b*e+b*f may become b*(c+d+e+f)
  p.division = ulp(2 * reciprocal + product);    // an ULP of 1/y is up to 2 of the quotient
  p.inverse_sqrt = relative(0x1p-21);            // 22.10.19, rsq
  p.sqrt = ulp(1);                               // 3.1.3.1
  p.exp2 = relative(0x1p-21);                    // 22.10.6, exp: 2^x
  p.exp = {0, 2, 0x1p-21, 0};                    // HLSL's exp: 2^(x log2 e), two roundings of the exponent
  p.log2 = relative(0x1p-21);                    // 22.10.8, log outside [0.5, 2]
  p.log2_near_one = absolute(0x1p-21);           // inside
  p.log = {2, 0, 0x1p-21, 0};                    // HLSL's log: log2(x) ln 2, two roundings
  p.log_near_one = {2, 0, 0, 0x1p-21 * ln2};     // the same
  p.pow_is_inherited = true;                     // HLSL's pow: exp2(y log2(x))
  p.sin_cos = absolute(0.0008);                  // 22.10.20, sincos in [-100 pi, 100 pi]; nothing beyond
  p.sin_cos_domain = 100 * pi;
  p.atan2 = ulp(4096);                         // a choice: there is no atan instruction
  p.subtexel_bits = 8;                         // 7.18.16: at least 8 bits of subtexel precision
  p.lod_bits = 8;                              // 7.18.10: at least 8.8
  p.coordinate_bits = 0;                       // 3.2.4.1: conversion to fixed point is within those bits
  p.unorm_load = ulp(0);                       // 3.2.3.2: exact to 0.5 ULP
  p.half_store = StoreRounding::rtz;           // 3.2.2: round to zero to another float format
  p.half_overflow = StoreOverflow::max;        // 3.2.2: the largest representable value, not infinity
  p.unorm_store_ulp = p.srgb_store_ulp = 0.6;  // 3.2.3.6 and 3.2.3.8: 0.6 ULP on the integer side
  return p;
}

/// The CUDA C++ Programming Guide, "Mathematical Functions", table of single-precision standard functions, whose errors count
/// from the correctly rounded result: half an ULP more from the exact one.
Profile cuda() {
  const auto from_rounded = [](double n) { return ulp(n + 0.5); };
  Profile p = inexact("cuda");
  p.basic = BasicRounding::nearest;  // x + y, x * y: round to nearest even
  p.contraction = true;              // nvcc: -fmad=true
  p.flush = Flush::never;            // nvcc: -ftz=false
  p.division = p.sqrt = Accuracy{};  // x / y, sqrtf with -prec-div=true, -prec-sqrt=true: 0
  p.inverse_sqrt = from_rounded(2);  // rsqrtf
  p.exp = p.exp2 = from_rounded(2);  // expf, exp2f
  p.log = p.log2 = from_rounded(1);  // logf, log2f
  p.log_near_one = p.log2_near_one = from_rounded(1);
  p.pow = from_rounded(4);                   // powf
  p.sin_cos = from_rounded(2);               // sinf, cosf, full range
  p.atan2 = from_rounded(3);                 // atan2f
  p.subtexel_bits = 8;                       // "Texture Fetching", linear filtering: 8 bits of fraction
  p.lod_bits = 8;                            // a choice
  p.coordinate_bits = 0;                     // a choice
  p.unorm_load = ulp(1);                     // a choice
  p.half_store = StoreRounding::rne;         // a choice: as __float2half
  p.half_overflow = StoreOverflow::inf;      // a choice
  p.unorm_store_ulp = p.srgb_store_ulp = 1;  // a choice: there is no such store
  return p;
}

/// The Metal Shading Language Specification 4.1, section 8.4, table 8.2 (fast math, the default).
Profile metal() {
  const double rsqrt = 2, quotient = 2.5, atan = 5;  // rsqrt(x), x / y, atan(x) [ULP]
  Profile p = inexact("metal");
  p.basic = BasicRounding::either;               // correctly rounded; that the direction is open is a choice
  p.contraction = true;                          // 1.6.5
  p.flush = Flush::may;                          // 8.1
  p.rearrangement = Rearrangement::distributed;  // a choice: MTLMathMode fast makes "aggressive" assumptions
  p.division = ulp(quotient);                    // y in [2^-126, 2^126]
  p.inverse_sqrt = ulp(rsqrt);
  p.sqrt = ulp(2 * rsqrt + 1);          // x rsqrt(x): an ULP of rsqrt is up to 2 of the product, which is rounded
  p.exp = p.exp2 = growing(3, 2);       // 3 + floor(|2 x|)
  p.log = ulp(3);                       // outside [0.5, 2]
  p.log_near_one = absolute(0x1p-21);   // inside
  p.log2 = ulp(2);                      // outside
  p.log2_near_one = absolute(0x1p-22);  // inside
  p.pow_is_inherited = true;            // exp2(y log2(x))
  p.sin_cos = absolute(0x1p-13);        // in [-pi, pi]; larger beyond
  p.sin_cos_domain = pi;
  p.atan2 = ulp(2 * (atan + quotient + 0.5));  // atan(y / x), and pi added: each up to doubled
  p.subtexel_bits = 7;                         // a choice
  p.lod_bits = 4;                              // a choice
  p.coordinate_bits = 20;                      // a choice
  p.unorm_load = ulp(1);                       // a choice
  p.half_store = StoreRounding::either;        // the compiler option -ftexture-write-rounding-mode
  p.half_overflow = StoreOverflow::either;     // a choice
  p.half_store_flush = true;                   // a choice
  p.unorm_store_ulp = p.srgb_store_ulp = 1;    // a choice
  return p;
}

/// What the tables "Range and Precision" of GLSL 4.60 and GLSL ES 3.20 and 4.5.1 of GLSL ES 3.00 have alike for highp floats, and what all
/// three leave open.
Profile glsl(const char* name) {
  Profile p = inexact(name);
  p.basic = BasicRounding::either;                       // correctly rounded; the rounding mode is undefined
  p.contraction = true;                                  // a * b + c: one operation or two
  p.flush = Flush::may;                                  // any subnormal value can be flushed to 0
  p.rearrangement = Rearrangement::distributed;          // GLSL ES 3.20 names it; elsewhere a choice
  p.division = ulp(2.5);                                 // b in [2^-126, 2^126]
  p.inverse_sqrt = ulp(2);                               // inversesqrt
  p.sqrt_is_inherited = true;                            // from 1.0 / inversesqrt()
  p.exp = p.exp2 = growing(3, 2);                        // (3 + 2 |x|) ULP
  p.log = p.log2 = ulp(3);                               // outside [0.5, 2.0]
  p.log_near_one = p.log2_near_one = absolute(0x1p-21);  // inside
  p.pow_is_inherited = true;                             // from exp2(y log2(x))
  p.sin_cos = absolute(0x1p-11);                         // a choice: as VK-GL-CTS verifies, like the next three
  p.sin_cos_domain = pi;
  p.sin_cos_beyond = 0x1p-12;
  p.atan2 = ulp(4096);
  p.subtexel_bits = 7;  // a choice: as VK-GL-CTS verifies, like the next
  p.coordinate_bits = 20;
  p.lod_bits = 4;                            // a choice
  p.unorm_load = ulp(3);                     // a choice
  p.half_store = StoreRounding::either;      // a choice
  p.half_overflow = StoreOverflow::either;   // a choice
  p.unorm_store_ulp = p.srgb_store_ulp = 1;  // 2.3.5.2 of OpenGL 4.6 and OpenGL ES 3.2: one of the two closest
  return p;
}
Profile opengl() { return glsl("opengl"); }
/// A store may drop a subnormal half: a choice, because no text has it.
Profile gles() {
  Profile p = glsl("gles");
  p.half_store_flush = true;
  return p;
}
Profile webgl() {
  Profile p = glsl("webgl");
  p.half_store_flush = true;
  return p;
}

/// OpenCL C, "Relative Error as ULPs", the table of single precision in the full profile, whose errors count from the exact result; other
/// places are named.
Profile opencl() {
  Profile p = inexact("opencl");
  p.basic = BasicRounding::nearest;  // x + y, x - y, x * y; "Rounding Modes": to nearest even
  p.contraction = true;              // FP_CONTRACT is ON
  p.flush = Flush::may;              // "INF, NaN and Denormalized Numbers"
  p.division = ulp(2.5);             // x / y
  p.inverse_sqrt = ulp(2);           // rsqrt
  p.sqrt = ulp(3);                   // sqrt
  p.exp = p.exp2 = ulp(3);           // exp, exp2
  p.log = p.log2 = ulp(3);           // log, log2
  p.log_near_one = p.log2_near_one = ulp(3);
  p.pow = ulp(16);      // pow, powr
  p.sin_cos = ulp(4);   // sin, cos, full range
  p.atan2 = ulp(6);     // atan2
  p.subtexel_bits = 7;  // a choice, like the next two: "Addressing and Filter Modes" defines none
  p.coordinate_bits = 20;
  p.lod_bits = 4;
  p.unorm_load = ulp(1.5);                     // "Conversion Rules for Normalized Integer Channel Data Types"
  p.half_store = StoreRounding::either;        // "Conversion Rules for Half-Precision ...": nearest even or toward zero
  p.half_overflow = StoreOverflow::either;     // a choice
  p.half_store_flush = true;                   // the same section: may be flushed
  p.unorm_store_ulp = p.srgb_store_ulp = 0.6;  // "Converting Floating-Point Values ...", "... sRGBA and sBGRA Images"
  return p;
}

/// Exact rules: the defaults.
Profile ieee() { return {}; }

/// Every number of a profile by its key in the data file.
std::map<std::string, double> figures(const Profile& p) {
  std::map<std::string, double> out{{"reference", p.reference},
                                    {"basic", static_cast<double>(p.basic)},
                                    {"contraction", p.contraction},
                                    {"flush", static_cast<double>(p.flush)},
                                    {"rearrangement", static_cast<double>(p.rearrangement)},
                                    {"sqrt_is_inherited", p.sqrt_is_inherited},
                                    {"pow_is_inherited", p.pow_is_inherited},
                                    {"sin_cos_domain", p.sin_cos_domain},
                                    {"sin_cos_beyond", p.sin_cos_beyond},
                                    {"atan2_domain", p.atan2_domain},
                                    {"subtexel_bits", p.subtexel_bits},
                                    {"coordinate_bits", p.coordinate_bits},
                                    {"lod_bits", p.lod_bits},
                                    {"half_store", static_cast<double>(p.half_store)},
                                    {"half_overflow", static_cast<double>(p.half_overflow)},
                                    {"half_store_flush", p.half_store_flush},
                                    {"unorm_store_ulp", p.unorm_store_ulp},
                                    {"srgb_store_ulp", p.srgb_store_ulp}};
  for (const auto& [key, a] : {std::pair{"division", p.division},
                               {"sqrt", p.sqrt},
                               {"inverse_sqrt", p.inverse_sqrt},
                               {"exp", p.exp},
                               {"exp2", p.exp2},
                               {"log", p.log},
                               {"log2", p.log2},
                               {"log_near_one", p.log_near_one},
                               {"log2_near_one", p.log2_near_one},
                               {"pow", p.pow},
                               {"sin_cos", p.sin_cos},
                               {"atan2", p.atan2},
                               {"unorm_load", p.unorm_load}}) {
    const std::string name = key;
    out[name + ".ulp"] = a.ulp;
    out[name + ".ulp_per_x"] = a.ulp_per_x;
    out[name + ".relative"] = a.relative;
    out[name + ".absolute"] = a.absolute;
  }
  return out;
}

const std::map<std::string, Profile (*)()> specifications{{"ieee", ieee},   {"vulkan", vulkan}, {"webgpu", webgpu}, {"d3d", d3d},
                                                          {"cuda", cuda},   {"metal", metal},   {"opengl", opengl}, {"gles", gles},
                                                          {"webgl", webgl}, {"opencl", opencl}};

TEST(ProfileTables, AreThoseThatAreOffered) {
  std::vector<std::string> names = profile_names(), expected;
  for (const auto& [name, unused] : specifications) expected.push_back(name);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, expected);
}

// Each API has one, and each but `ieee` is that of one API.
TEST(ProfileTables, AreThoseOfTheApisOfPorts) {
  std::set<std::string> of_apis{"ieee"};
  for (const port_dump::Api& api : port_dump::apis()) EXPECT_TRUE(api.profile.empty() || of_apis.emplace(api.profile).second) << api.name;
  const std::vector<std::string> names = profile_names();
  EXPECT_EQ(of_apis, std::set<std::string>(names.begin(), names.end()));
}

// The profiles typical and coarsest follow no specification.
TEST(ProfileTables, EachNumberIsTheSpecifications) {
  for (const auto& [name, specified] : specifications) {
    const std::map<std::string, double> built_in = figures(profile(name));
    for (const auto& [key, value] : figures(specified())) {
      // The files have nine digits of what is no short number, rounded up.
      EXPECT_GE(built_in.at(key), value) << name << ' ' << key;
      EXPECT_LE(built_in.at(key), value + value * 1e-7) << name << ' ' << key;
    }
  }
}
// What lies outside `coarsest` is to be explained by no rounding that anybody allows.
TEST(ProfileTables, NothingIsLooserThanTheCoarsest) {
  const Profile most = profile("coarsest");
  for (const std::string& name : profile_names()) {
    const Profile& p = profile(name);
    if (p.reference) continue;
    for (const Accuracy Profile::*a :
         {&Profile::division, &Profile::inverse_sqrt, &Profile::sqrt, &Profile::exp, &Profile::exp2, &Profile::log, &Profile::log2,
          &Profile::log_near_one, &Profile::log2_near_one, &Profile::sin_cos, &Profile::atan2, &Profile::unorm_load}) {
      if (a == &Profile::sqrt && p.sqrt_is_inherited) continue;
      for (const double Accuracy::*part : {&Accuracy::ulp, &Accuracy::ulp_per_x, &Accuracy::relative, &Accuracy::absolute})
        EXPECT_GE(most.*a.*part, p.*a.*part) << name;
    }
    // 1 / inverse_sqrt, where each of both errors may be doubled by a power of two.
    if (p.sqrt_is_inherited) {
      EXPECT_GE(most.sqrt.ulp, 2 * p.inverse_sqrt.ulp + 2 * p.division.ulp + 0.5) << name;
    }
    // pow is exp2(y log2(x)) there.
    ASSERT_TRUE(most.pow_is_inherited);
    EXPECT_GE(most.exp2.ulp, p.pow.ulp) << name;
    EXPECT_GE(most.sin_cos_beyond, p.sin_cos_beyond) << name;
    for (const int Profile::*bits : {&Profile::subtexel_bits, &Profile::lod_bits}) EXPECT_LE(most.*bits, p.*bits) << name;
    EXPECT_TRUE(p.coordinate_bits == 0 || most.coordinate_bits <= p.coordinate_bits) << name;
    EXPECT_GE(most.half_store_flush, p.half_store_flush) << name;
    EXPECT_GE(most.unorm_store_ulp, p.unorm_store_ulp) << name;
    EXPECT_GE(most.srgb_store_ulp, p.srgb_store_ulp) << name;
  }
}

/// The lines of a profile's data file.
std::vector<std::string> lines_of(std::string_view profile) {
  std::vector<std::string> out;
  std::istringstream text{std::string(profile)};
  for (std::string line; std::getline(text, line);) out.push_back(line);
  return out;
}

// No key of a data file escapes the tables above.
TEST(ProfileTables, EveryKeyIsCompared) {
  const std::map<std::string, double> compared = figures(Profile{});
  const std::set<std::string> words{"name", "rearrangement_remedy", "about", "known_outside"};
  const std::regex key("^(\\w+) = ");
  for (const auto& [name, text] : detail::embedded_profiles()) {
    int keys = 0;
    for (const std::string& line : lines_of(text)) {
      std::smatch found;
      if (!std::regex_search(line, found, key) || words.contains(found[1])) continue;
      ++keys;
      EXPECT_TRUE(compared.contains(found[1]) || compared.contains(found[1].str() + ".ulp")) << name << ": " << found[1];
    }
    EXPECT_GT(keys, 4) << name;
  }
}

// A source names one of the documents that the file's head declares with their version or date, and a section; or it is a choice, with its
// date and why.
TEST(ProfileTables, EachEntryNamesDocumentVersionAndSection) {
  const std::regex declared("# ([A-Z0-9]+) = .*([0-9]+\\.[0-9]+|version|20[0-9][0-9]|this version).*"),
      entry("\\w+ = \\{.*, source = \"(.*)\"\\}"), from("([A-Z0-9]+) ([0-9]+(\\.[0-9]+)*|'[^']+'): .{4,}"),
      choice("choice 20[0-9][0-9]-[01][0-9]-[0-3][0-9]: .{15,}"), unsettled("provisional|convention|not read|TODO");
  int choices = 0;
  for (const auto& [name, text] : detail::embedded_profiles()) {
    std::set<std::string> documents, used;
    int entries = 0;
    for (const std::string& line : lines_of(text)) {
      std::smatch found;
      if (std::regex_match(line, found, declared)) documents.insert(found[1]);
      EXPECT_TRUE(line.starts_with("#") || !std::regex_search(line, unsettled)) << name << ": " << line;
      if (line.find("source = ") == std::string::npos) continue;
      ++entries;
      ASSERT_TRUE(std::regex_match(line, found, entry)) << name << ": " << line;
      const std::string source = found[1];
      if (std::regex_match(source, choice)) {
        ++choices;
        continue;
      }
      ASSERT_TRUE(std::regex_match(source, found, from)) << name << ": " << line;
      EXPECT_TRUE(documents.contains(found[1])) << name << ": " << line;
      used.insert(found[1]);
    }
    EXPECT_GE(entries, 5) << name;
    for (const std::string& d : documents) EXPECT_TRUE(d == "CTS" || used.contains(d)) << name << ": nothing comes from " << d;
  }
  EXPECT_GT(choices, 20);
}

// Vulkan, "Floating-Point Format Conversions": one of the representable neighbours. WGSL, "Channel Formats": quantizeToF16, which may
// flush. Direct3D 11.3, 3.2.2: to the denorm representation. CUDA: IEEE 754. OpenCL: may be flushed. What devices do: none flushes.
TEST(ProfileTables, AStoreThatFlushesASubnormalHalf) {
  const std::map<std::string, bool> may{{"ieee", false}, {"vulkan", false}, {"webgpu", true},   {"d3d", false},
                                        {"cuda", false}, {"metal", true},   {"opengl", false},  {"gles", true},
                                        {"webgl", true}, {"opencl", true},  {"typical", false}, {"coarsest", true}};
  EXPECT_EQ(may.size(), detail::embedded_profiles().size());
  for (const auto& [name, allowed] : may) {
    const StoreRules rules = store_rules(profile(name));
    for (const float x : {0x1p-24f, 0x1.8p-20f, 0x1.ff8p-15f}) {  // the last is the largest subnormal half
      const Enclosure above(x, x), below(-x, -x);
      EXPECT_EQ(code_range(FormatInfo::float16, above, rules).contains(0), allowed) << name << ' ' << x;
      EXPECT_EQ(code_range(FormatInfo::float16, below, rules).contains(0), allowed) << name << ' ' << -x;
    }
    for (const float x : {0x1p-14f, 0x1.004p-14f}) EXPECT_FALSE(code_range(FormatInfo::float16, {x, x}, rules).contains(0)) << name;
    // Loads keep it, under every profile.
    const ProfileScope scope(profile(name));
    const Half least{1};
    EXPECT_TRUE(Enclosure::load(&least).is_point() && Enclosure::load(&least).lo == 0x1p-24f) << name;
  }
}

// Direct3D 11.3, 3.2.3.7, lets an sRGB load err by half a code. Nothing loads one: no buffer has such a format.
TEST(ProfileTables, NoBufferIsSrgb) {
  int buffers = 0;
  for (const effect::Effect* effect : registry::effects())
    for (const capture::BufferInfo& b : effect->info->buffers) {
      EXPECT_EQ(b.format.find("srgb"), std::string::npos) << effect->info->name << ' ' << b.name;
      ++buffers;
    }
  EXPECT_GT(buffers, 20);
}

}  // namespace
}  // namespace rainref::judge
