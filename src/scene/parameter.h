// Parameter descriptors. Each scene key is declared once, for the parser, the help and the hash.
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

/// `choice` is a text from a list; the vectors are arrays in a scene file.
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
  std::string unit;  ///< "m/s", "1" for a pure number, "" if a unit has no meaning
  double minimum;    ///< inclusive, of each component; -infinity for none
  double maximum;    ///< inclusive, of each component; +infinity for none
  Value default_value;
  std::string sentence;
  std::vector<std::string> choices;   ///< for Type::choice; for an integer: the allowed values if they are not the whole range
  std::vector<std::string> variants;  ///< variants that use it; empty = all
  std::vector<std::pair<std::string, Value>> variant_defaults;
  bool is_required = false;  ///< a scene must give it, and default_value is unused

  /// The same parameter, used by this variant only; may be chained for several variants.
  Parameter only(std::string variant) const;
  /// The same parameter with another default in this variant.
  Parameter default_for(std::string variant, Value value) const;
  /// The same parameter, but required.
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
/// Number of components of a value of this type; 0 if it is not numeric.
int components(Type type);
/// True if the value has the parameter's type, is finite, in range and among the choices.
bool accepts(const Parameter& parameter, const Value& value);
/// The allowed values, for messages: "a number from 0.95 to 0.999 [1]", "one of 'add', 'max'".
std::string expectation(const Parameter& parameter);
/// The range alone: "0.95 to 0.999", "at least 0", "" if there is none.
std::string range_text(const Parameter& parameter);

/// Throws Error(internal) if a table contradicts itself: a malformed or repeated key, a key that is also a table of other keys, a default
/// that its parameter does not accept, a variant that is not among `variants`, a missing sentence.
void validate(std::span<const Parameter> parameters, std::span<const std::string> variants);

}  // namespace rainref::scene
