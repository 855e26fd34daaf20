// GPU layouts: a C++ struct whose bytes every GPU language reads the same way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace rainref::scene {

enum class Scalar : std::uint8_t { float32, int32, uint32 };
/// "float", "int", "uint".
const char* name(Scalar scalar);

/// One quantity in a block: a scalar, or a vector of 2 to 4.
struct Member {
  std::string name;
  Scalar scalar;
  int components;
  std::size_t offset;  ///< in bytes
  std::string unit;
  std::string sentence;

  std::size_t size() const { return 4 * static_cast<std::size_t>(components); }
  /// What std140, std430 and WGSL ask of the offset: 4, 8, 16, 16 for 1 to 4 components.
  std::size_t alignment() const { return components == 1 ? 4 : components == 2 ? 8 : 16; }
};

/// The layout of a uniform block, or of the element struct of a storage buffer. Bytes that no member covers are
/// padding.
struct UniformBlock {
  std::string name;  ///< the type's name in every language: "WaveStepUniforms"
  std::size_t size;  ///< in bytes
  std::vector<Member> members;
};

/// Throws Error(internal) unless every language gives this block the same bytes: members in order and apart, each
/// aligned as Member::alignment says and within one 16-byte row, the size a multiple of 16; names, units and sentences
/// present, and every name usable in every language.
void validate(const UniformBlock& block);
/// The same for an element struct: its size is a multiple of its largest alignment instead.
void validate_record(const UniformBlock& record);

/// The members with every gap made explicit: scalars named padding_0, padding_1, …, without unit and sentence.
std::vector<Member> with_padding(const UniformBlock& block);

namespace detail {

template <class M>
struct Shape {
  using Component = typename M::value_type;  // std::array and glm vectors both have it
  static constexpr int components = sizeof(M) / sizeof(Component);
};
template <class M, std::size_t N>
struct Shape<M[N]> {
  using Component = M;
  static constexpr int components = N;
};
template <class M>
requires std::is_arithmetic_v<M>
struct Shape<M> {
  using Component = M;
  static constexpr int components = 1;
};

template <class C>
constexpr Scalar scalar_of() {
  static_assert(std::is_same_v<C, float> || std::is_same_v<C, std::int32_t> || std::is_same_v<C, std::uint32_t>,
                "a uniform is made of float, int32 or uint32");
  if constexpr (std::is_same_v<C, float>)
    return Scalar::float32;
  else if constexpr (std::is_same_v<C, std::int32_t>)
    return Scalar::int32;
  else
    return Scalar::uint32;
}

template <class S, class M>
std::size_t offset_of(M S::*pointer) {
  static_assert(std::is_standard_layout_v<S>);
  const S object{};
  const auto* at = reinterpret_cast<const std::byte*>(&(object.*pointer));
  return static_cast<std::size_t>(at - reinterpret_cast<const std::byte*>(&object));
}

template <class S, class M>
Member member(M S::*pointer, std::string name, std::string unit, std::string sentence) {
  static_assert(Shape<M>::components >= 1 && Shape<M>::components <= 4, "vectors have 2 to 4 components; no arrays");
  return {std::move(name),      scalar_of<typename Shape<M>::Component>(),
          Shape<M>::components, offset_of(pointer),
          std::move(unit),      std::move(sentence)};
}

std::vector<Member> moved(std::vector<Member> members, std::size_t by, const std::string& prefix);

UniformBlock validated_block(UniformBlock block);
UniformBlock validated_record(UniformBlock record);

}  // namespace detail

/// The member that P points to: member<&WaveStepUniforms::damping>("damping", "1", "Share of …"). Type and offset are
/// taken from the struct, whose vectors are float[3], std::array<float, 3> or a glm vector, of float, int32 or uint32.
template <auto P>
Member member(std::string name, std::string unit, std::string sentence) {
  return detail::member(P, std::move(name), std::move(unit), std::move(sentence));
}

/// The members of a struct that is itself the member P of another, as members of that other: offsets moved, and names
/// behind "prefix_". nested<&ShadeUniforms::camera>("camera", camera_members()) gives camera_position, …
template <auto P>
std::vector<Member> nested(const std::string& prefix, std::vector<Member> members) {
  return detail::moved(std::move(members), detail::offset_of(P), prefix);
}

/// The block that struct S is, validated. S has no alignment of its own, so the compiler adds no padding unseen: what
/// padding it needs are members of it, which are not listed here.
template <class S>
UniformBlock uniform_block(std::string name, std::vector<Member> members) {
  static_assert(alignof(S) == 4, "padding must be written out");
  return detail::validated_block({std::move(name), sizeof(S), std::move(members)});
}

/// The same for the element struct of a storage buffer.
template <class S>
UniformBlock record(std::string name, std::vector<Member> members) {
  static_assert(alignof(S) == 4, "padding must be written out");
  return detail::validated_record({std::move(name), sizeof(S), std::move(members)});
}

}  // namespace rainref::scene
