// GPU layouts: a C++ struct whose bytes every GPU language reads the same way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace rainref::scene {

enum class Scalar : std::uint8_t { float32, int32, uint32 };
/// "float", "int", "uint".
const char* name(Scalar scalar);

/// Range of each component of a member, both ends included.
struct Range {
  double low, high;
  bool is_whole = false;  ///< a float that holds an integer
};
inline constexpr Range whole(double low, double high) { return {low, high, true}; }

// Ranges that many members share.
inline constexpr Range share{0, 1}, component{-1, 1} /* of a unit vector */, flag{0, 1}, any_word{0, 4294967295.0};
inline constexpr Range mip_level{0, 15}, radiance{0, 1e9}, exposure_factor{0, 0x1p20} /* 20 EV */, frame_time{0, 1e6} /* [s] */;

/// One quantity in a block: a scalar, or a vector of 2 to 4.
struct Member {
  std::string name;
  Scalar scalar;
  int components;
  std::size_t offset;  ///< in bytes
  std::string unit;
  std::string sentence;
  std::optional<Range> range = std::nullopt;  ///< none: any finite number
  std::string guard = "";                     ///< why every scene gives a component only 0 or 1; "": some scene gives other values
  int guarded_component = 0;

  Member guarded(std::string why, int which = 0) && {
    guard = std::move(why);
    guarded_component = which;
    return std::move(*this);
  }
  std::size_t size() const { return 4 * static_cast<std::size_t>(components); }
  /// Alignment of the offset in std140, std430 and WGSL: 4, 8, 16, 16 for 1 to 4 components.
  std::size_t alignment() const { return components == 1 ? 4 : components == 2 ? 8 : 16; }
};

/// The layout of a uniform block, or of the element struct of a storage buffer. Bytes without a member are padding.
struct UniformBlock {
  std::string name;  ///< the type's name in every language: "WaveStepUniforms"
  std::size_t size;  ///< in bytes
  std::vector<Member> members;
};

/// Throws Error(internal) unless the block has the same bytes in every language: members in order and not overlapping, each aligned as
/// Member::alignment requires and within one 16-byte row, the size a multiple of 16; names, units, sentences and ranges present, and every
/// name valid in every language.
void validate(const UniformBlock& block);
/// The same for an element struct: its size is a multiple of its largest alignment instead, and a range may be missing.
void validate_record(const UniformBlock& record);

/// True if both give the same names to the same bytes.
bool same_layout(const UniformBlock& a, const UniformBlock& b);

/// A component of a member, from the bytes of a block.
double component_of(const Member& member, const std::byte* bytes, int component);
/// Returns why these bytes are not valid for the block, or "": "step is 200, expected 1 to 8". NaN and infinity are outside every range.
/// The ends are rounded to float, like the values. `bytes` has the block's size.
std::string value_fault(const UniformBlock& block, const std::byte* bytes);

/// The members with every gap made explicit by scalars named padding_0, padding_1, …, without unit and sentence.
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

/// Extracts a template argument from the function name that GCC and Clang write: "[... NAME = &scope::x; ...]" gives x.
consteval std::string_view last_name(std::string_view function, std::string_view argument) {
  const std::size_t from = function.find(argument) + argument.size();
  const std::string_view whole = function.substr(from, function.find_first_of(";]", from) - from);
  return whole.substr(whole.rfind(':') + 1);
}
template <auto P>
consteval std::string_view name_of() {
  return last_name(__PRETTY_FUNCTION__, "P = ");
}
template <class S>
consteval std::string_view name_of() {
  return last_name(__PRETTY_FUNCTION__, "S = ");
}
static_assert(name_of<&Range::is_whole>() == "is_whole" && name_of<Range>() == "Range");

template <class S, class M>
Member member(M S::*pointer, std::string_view name, std::string unit, std::optional<Range> range, std::string sentence) {
  static_assert(Shape<M>::components >= 1 && Shape<M>::components <= 4, "vectors have 2 to 4 components; no arrays");
  return {std::string(name),
          scalar_of<typename Shape<M>::Component>(),
          Shape<M>::components,
          offset_of(pointer),
          std::move(unit),
          std::move(sentence),
          range};
}

std::vector<Member> moved(std::vector<Member> members, std::size_t by, const std::string& prefix);

UniformBlock validated_block(UniformBlock block);
UniformBlock validated_record(UniformBlock record);

}  // namespace detail

/// The member that P points to: member<&WaveStepUniforms::damping>("1", share, "Share of …"). Name, type and offset are
/// taken from the struct, whose vectors are float[3], std::array<float, 3> or a glm vector, of float, int32 or uint32.
template <auto P>
Member member(std::string unit, Range range, std::string sentence) {
  return detail::member(P, detail::name_of<P>(), std::move(unit), range, std::move(sentence));
}
/// For a record, whose fields may be any finite numbers.
template <auto P>
Member member(std::string unit, std::string sentence) {
  return detail::member(P, detail::name_of<P>(), std::move(unit), std::nullopt, std::move(sentence));
}

/// The members of a struct that is itself the member P of another struct, as members of that one: offsets are moved, and names get
/// "prefix_". nested<&ShadeUniforms::camera>("camera", camera_members()) gives camera_position, …
template <auto P>
std::vector<Member> nested(const std::string& prefix, std::vector<Member> members) {
  return detail::moved(std::move(members), detail::offset_of(P), prefix);
}

/// The validated block of struct S, with its name. S has no alignment of its own, so the compiler adds no hidden padding: its padding is in
/// explicit members, which are not listed here.
template <class S>
UniformBlock uniform_block(std::vector<Member> members) {
  static_assert(alignof(S) == 4, "padding must be written out");
  return detail::validated_block({std::string(detail::name_of<S>()), sizeof(S), std::move(members)});
}

/// The same for the element struct of a storage buffer.
template <class S>
UniformBlock record(std::vector<Member> members) {
  static_assert(alignof(S) == 4, "padding must be written out");
  return detail::validated_record({std::string(detail::name_of<S>()), sizeof(S), std::move(members)});
}

}  // namespace rainref::scene
