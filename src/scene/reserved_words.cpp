#include "scene/reserved_words.h"

#include <fmt/format.h>

namespace rainref::scene {
namespace {

// A space before and after each.
constexpr std::string_view words =
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

}  // namespace

bool is_reserved_word(std::string_view word) { return words.find(fmt::format(" {} ", word)) != std::string_view::npos; }

}  // namespace rainref::scene
