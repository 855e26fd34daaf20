#include "scene/uniform_block.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "rainref/error.h"

namespace rainref::scene {
namespace {

constexpr std::size_t row = 16;

/// Keywords, reserved words and built-in types of C, C++, CUDA, GLSL 4.60, HLSL and WGSL in lower case, a space before and after each.
constexpr std::string_view reserved_words =
    " abstract active alias alignas alignof and and_eq array as asm asm_fragment async atomic atomic_uint "
    "attribute auto await become bitand bitor bool bool2 bool3 bool4 break buffer bvec2 bvec3 bvec4 case cast "
    "catch cbuffer centroid char class co_await co_return co_yield coherent column_major common compile "
    "compile_fragment compl concept const const_assert const_cast consteval constexpr constinit continue "
    "continuing crate debugger decltype default delete demote demote_to_helper diagnostic discard do double "
    "double2 double3 double4 dvec2 dvec3 dvec4 dword dynamic_cast else enable enum explicit export extends "
    "extern external f16 f32 fallthrough false filter final finally fixed flat float float2 float3 float4 fn for "
    "friend from fxgroup get globallycoherent goto groupshared half half2 half3 half4 highp i32 if image impl "
    "implements import in inline inout input instanceof int int2 int3 int4 interface invariant ivec2 ivec3 ivec4 "
    "layout let line lineadj linear long loop lowp macro macro_rules mat2 mat3 mat4 match matrix mediump meta "
    "mod module move mut mutable namespace new nil noexcept noinline nointerpolation non_coherent noncoherent "
    "noperspective not not_eq null nullptr of operator or or_eq out output override package packoffset partition "
    "pass patch pixelfragment point precise precision premerge priv private protected ptr pub public readonly "
    "ref regardless register reinterpret_cast require requires resource restrict return row_major sample sampler "
    "sampler_comparison self set shared short signed sizeof smooth snorm stateblock static static_assert "
    "static_cast std string struct subroutine super superp switch target tbuffer technique technique10 template "
    "texture this thread_local throw trait triangle triangleadj true try type typedef typeid typename typeof u32 "
    "uint uint2 uint3 uint4 uniform union unless unorm unsafe unsigned unsized use using uvec2 uvec3 uvec4 var "
    "varying vec2 vec2f vec2i vec2u vec3 vec3f vec3i vec3u vec4 vec4f vec4i vec4u vector vertexfragment virtual "
    "void volatile wchar_t wgsl where while with writeonly xor xor_eq yield ";
bool is_reserved_word(std::string_view word) { return reserved_words.find(fmt::format(" {} ", word)) != std::string_view::npos; }

[[noreturn]] void broken(const UniformBlock& block, const std::string& why) {
  throw Error(ExitCode::internal, fmt::format("layout {}: {}", block.name, why));
}

bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// WaveStepUniforms
bool is_type_name(std::string_view name) {
  return !name.empty() && is_upper(name[0]) &&
         std::all_of(name.begin(), name.end(), [](char c) { return is_lower(c) || is_upper(c) || is_digit(c); });
}

// wave_speed; two underscores in a row belong to GLSL.
bool is_member_name(std::string_view name) {
  return !name.empty() && is_lower(name[0]) && name.find("__") == std::string_view::npos &&
         std::all_of(name.begin(), name.end(), [](char c) { return is_lower(c) || is_digit(c) || c == '_'; });
}

bool is_one_line(std::string_view text) {
  return !text.empty() && std::none_of(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; });
}

void validate_words(const UniformBlock& block) {
  if (!is_type_name(block.name)) broken(block, "the name must be UpperCamel");
  if (block.members.empty()) broken(block, "no members");
  for (const Member& m : block.members) {
    if (!is_member_name(m.name)) broken(block, fmt::format("'{}' is no snake_case name", m.name));
    if (m.name.starts_with("padding")) broken(block, fmt::format("'{}': padding is not listed", m.name));
    if (is_reserved_word(m.name)) broken(block, fmt::format("'{}' is a reserved word of a shading language", m.name));
    if (!is_one_line(m.unit)) broken(block, fmt::format("'{}' has no unit", m.name));
    if (!is_one_line(m.sentence)) broken(block, fmt::format("'{}' has no sentence", m.name));
    const auto same = [&](const Member& other) { return other.name == m.name; };
    if (std::count_if(block.members.begin(), block.members.end(), same) > 1) {
      broken(block, fmt::format("'{}' is listed twice", m.name));
    }
  }
}

template <class T>
T loaded(const std::byte* at) {
  T t;
  std::memcpy(&t, at, sizeof t);
  return t;
}

// Returns the largest alignment.
std::size_t validate_offsets(const UniformBlock& block) {
  std::size_t end = 0, largest = 4;
  for (const Member& m : block.members) {
    if (m.components < 1 || m.components > 4) broken(block, fmt::format("'{}' has {} components", m.name, m.components));
    if (m.offset < end) {
      broken(block, fmt::format("'{}' at {} begins before the member before it ends, at {}", m.name, m.offset, end));
    }
    if (m.offset % m.alignment() != 0) {
      broken(block, fmt::format("'{}' at {} is not aligned to {}", m.name, m.offset, m.alignment()));
    }
    end = m.offset + m.size();
    largest = std::max(largest, m.alignment());
  }
  if (end > block.size) broken(block, fmt::format("members end at {}, beyond the size {}", end, block.size));
  return largest;
}

}  // namespace

const char* name(Scalar scalar) {
  switch (scalar) {
    case Scalar::float32:
      return "float";
    case Scalar::int32:
      return "int";
    case Scalar::uint32:
      return "uint";
  }
  return "?";
}

void validate(const UniformBlock& block) {
  validate_words(block);
  validate_offsets(block);
  for (const Member& m : block.members) {
    if (!m.range) broken(block, fmt::format("'{}' has no range", m.name));
    if (!(m.range->low <= m.range->high)) broken(block, fmt::format("'{}' has an empty range", m.name));
  }
  if (block.size % row != 0) broken(block, fmt::format("size {} is not a multiple of {}", block.size, row));
}

void validate_record(const UniformBlock& record) {
  validate_words(record);
  const std::size_t alignment = validate_offsets(record);
  if (record.size % alignment != 0) {
    broken(record, fmt::format("size {} is not a multiple of {}", record.size, alignment));
  }
}

bool same_layout(const UniformBlock& a, const UniformBlock& b) {
  return a.size == b.size &&
         std::equal(a.members.begin(), a.members.end(), b.members.begin(), b.members.end(), [](const Member& m, const Member& n) {
           return m.name == n.name && m.scalar == n.scalar && m.components == n.components && m.offset == n.offset;
         });
}

double component_of(const Member& m, const std::byte* bytes, int k) {
  const std::byte* at = bytes + m.offset + 4 * static_cast<std::size_t>(k);
  return m.scalar == Scalar::float32 ? static_cast<double>(loaded<float>(at))
         : m.scalar == Scalar::int32 ? static_cast<double>(loaded<std::int32_t>(at))
                                     : static_cast<double>(loaded<std::uint32_t>(at));
}
std::string value_fault(const UniformBlock& block, const std::byte* bytes) {
  for (const Member& m : block.members) {
    for (int k = 0; k < m.components; ++k) {
      const Range range = m.range.value_or(Range{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()});
      const auto as_stored = [&](double end) { return m.scalar == Scalar::float32 ? static_cast<float>(end) : end; };
      const double value = component_of(m, bytes, k), low = as_stored(range.low), high = as_stored(range.high);
      const bool is_fit = std::isfinite(value) && low <= value && value <= high && (!range.is_whole || value == std::floor(value));
      if (is_fit) continue;
      const std::string name = m.components == 1 ? m.name : fmt::format("{}.{}", m.name, "xyzw"[k]);
      if (!m.range) return fmt::format("{} is {}, expected a finite number", name, value);
      return fmt::format("{} is {}, expected {}{:g} to {:g}", name, value, range.is_whole ? "a whole number from " : "", range.low,
                         range.high);
    }
  }
  return "";
}

std::vector<Member> with_padding(const UniformBlock& block) {
  std::vector<Member> out;
  std::size_t at = 0;
  int paddings = 0;
  const auto fill = [&](std::size_t to) {
    for (; at < to; at += 4) out.push_back({fmt::format("padding_{}", paddings++), Scalar::float32, 1, at, "", ""});
  };
  for (const Member& m : block.members) {
    fill(m.offset);
    out.push_back(m);
    at = m.offset + m.size();
  }
  fill(block.size);
  return out;
}

namespace detail {

std::vector<Member> moved(std::vector<Member> members, std::size_t by, const std::string& prefix) {
  for (Member& m : members) {
    m.offset += by;
    m.name = fmt::format("{}_{}", prefix, m.name);
  }
  return members;
}

UniformBlock validated_block(UniformBlock block) {
  validate(block);
  return block;
}

UniformBlock validated_record(UniformBlock record) {
  validate_record(record);
  return record;
}

}  // namespace detail
}  // namespace rainref::scene
