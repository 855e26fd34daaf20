// Parameter descriptors: what a scene may say is declared once, and read by the parser, the help and the hash.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "rainref/variant.h"

namespace rainref::scene {

inline constexpr const char *published = name(Variant::as_published), *correct = name(Variant::corrected);

/// `choice` is a text out of a list; the vectors are arrays in a scene file.
enum class Type : std::uint8_t { boolean, integer, integer2, real, real2, real3, choice, text };

using Integer2 = std::array<std::int64_t, 2>;
using Real2 = std::array<double, 2>;
using Real3 = std::array<double, 3>;
/// A value of any Type; choice and text share std::string.
using Value = std::variant<bool, std::int64_t, Integer2, double, Real2, Real3, std::string>;

/// One quantity that a scene may set.
struct Parameter {
  std::string key;  ///< dotted: "puddle.drop_count"
  Type type;
  std::string unit;  ///< "m/s", "1" for a pure number, "" where a unit has no meaning
  double minimum;    ///< inclusive, of each component; -infinity for none
  double maximum;    ///< inclusive, of each component; +infinity for none
  Value default_value;
  std::string sentence;
  std::vector<std::string> choices;   ///< of Type::choice; of an integer: what it may be where that is not all of its range
  std::vector<std::string> variants;  ///< the variants that use it; empty = every one
  std::vector<std::pair<std::string, Value>> variant_defaults;
  bool is_required = false;  ///< a scene must give it; default_value has no meaning then

  /// The same parameter, used by this variant only; may be chained to name several.
  Parameter only(std::string variant) const;
  /// The same parameter with another default in this variant.
  Parameter default_for(std::string variant, Value value) const;
  /// The same parameter, which a scene must give.
  Parameter required() const;

  bool used_by(std::string_view variant) const;
  const Value& default_in(std::string_view variant) const;
};

Parameter boolean(std::string key, bool default_value, std::string sentence);
Parameter integer(std::string key, std::string unit, double minimum, double maximum, std::int64_t default_value, std::string sentence);
Parameter integer2(std::string key, std::string unit, double minimum, double maximum, Integer2 default_value, std::string sentence);
Parameter real(std::string key, std::string unit, double minimum, double maximum, double default_value, std::string sentence);
Parameter real2(std::string key, std::string unit, double minimum, double maximum, Real2 default_value, std::string sentence);
Parameter real3(std::string key, std::string unit, double minimum, double maximum, Real3 default_value, std::string sentence);
Parameter choice(std::string key, std::vector<std::string> choices, std::string default_value, std::string sentence);
Parameter text(std::string key, std::string default_value, std::string sentence);

/// "boolean", "integer2", …
const char* name(Type type);
/// Numbers in a value of this type; 0 where there are none.
int components(Type type);
/// Whether the value has the parameter's type, is finite, in range and among the choices.
bool accepts(const Parameter& parameter, const Value& value);
/// What a scene may say, for messages: "a number from 0.95 to 0.999 [1]", "one of 'add', 'max'".
std::string expectation(const Parameter& parameter);
/// The range alone: "0.95 to 0.999", "at least 0", "" where there is none.
std::string range_text(const Parameter& parameter);

/// Throws Error(internal) when a table contradicts itself: a malformed or repeated key, a key that is also a table of
/// other keys, a default that is refused by its own parameter, a variant that is not among `variants`, no sentence.
void validate(std::span<const Parameter> parameters, std::span<const std::string> variants);

}  // namespace rainref::scene
