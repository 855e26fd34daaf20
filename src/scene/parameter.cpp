#include "scene/parameter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rainref/error.h"
#include "scene/value_text.h"

namespace rainref::scene {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();
constexpr double two_to_63 = 9223372036854775808.0;

Parameter make(std::string key, Type type, std::string unit, double minimum, double maximum, Value value, std::string sentence) {
  return {std::move(key), type, std::move(unit), minimum, maximum, std::move(value), std::move(sentence), {}, {}, {}};
}

// Compared as integers: a double cannot represent every 64-bit integer, so a conversion could round the value into range.
bool in_range(const Parameter& p, std::int64_t v) {
  const bool low = p.minimum < -two_to_63 || (p.minimum < two_to_63 && v >= static_cast<std::int64_t>(std::ceil(p.minimum)));
  const bool high = p.maximum >= two_to_63 || (p.maximum >= -two_to_63 && v <= static_cast<std::int64_t>(std::floor(p.maximum)));
  return low && high;
}

bool in_range(const Parameter& p, double v) { return std::isfinite(v) && v >= p.minimum && v <= p.maximum; }

template <class T, std::size_t N>
bool in_range(const Parameter& p, const std::array<T, N>& v) {
  return std::all_of(v.begin(), v.end(), [&](T component) { return in_range(p, component); });
}

bool contains(std::span<const std::string> names, std::string_view wanted) {
  return std::find(names.begin(), names.end(), wanted) != names.end();
}

std::size_t alternative(Type type) {
  switch (type) {
    case Type::boolean:
      return 0;
    case Type::integer:
      return 1;
    case Type::integer2:
      return 2;
    case Type::real:
      return 3;
    case Type::real2:
      return 4;
    case Type::real3:
      return 5;
    case Type::choice:
    case Type::text:
      return 6;
  }
  return std::variant_npos;
}

std::string bound_text(const Parameter& p, double bound) {
  const bool is_integer = p.type == Type::integer || p.type == Type::integer2;
  if (is_integer && bound >= two_to_63) return fmt::format("{}", std::numeric_limits<std::int64_t>::max());
  if (is_integer && std::abs(bound) < two_to_63 && bound == std::floor(bound)) {
    return fmt::format("{}", static_cast<std::int64_t>(bound));
  }
  return fmt::format("{}", bound);
}

[[noreturn]] void broken(const Parameter& p, std::string_view why) {
  throw Error(ExitCode::internal, fmt::format("parameter '{}': {}", p.key, why));
}

// Lower-case words joined by dots: no quotes needed in TOML, and valid names in every GPU language.
bool well_formed_key(std::string_view key) {
  bool begins_word = true;
  for (const char c : key) {
    const bool is_letter = c >= 'a' && c <= 'z';
    const bool is_inner = c == '.' || c == '_' || (c >= '0' && c <= '9');
    if (!is_letter && (begins_word || !is_inner)) return false;
    begins_word = c == '.';
  }
  return !begins_word;
}

void validate(const Parameter& p, std::span<const std::string> variants) {
  if (!well_formed_key(p.key)) broken(p, "malformed key");
  if (p.sentence.empty()) broken(p, "no sentence");
  if (!(p.minimum <= p.maximum)) broken(p, "empty range");
  const bool may_have_choices = p.type == Type::choice || p.type == Type::integer;
  if (p.choices.empty() ? p.type == Type::choice : !may_have_choices)
    broken(p, "a choice has choices, an integer may have some, and nothing else has");
  for (const std::string& variant : p.variants) {
    if (!contains(variants, variant)) broken(p, fmt::format("no variant '{}'", variant));
  }
  if (p.is_required) return;
  if (!accepts(p, p.default_value)) {
    broken(p, fmt::format("default {}, expected {}", value_text(p.default_value), expectation(p)));
  }
  for (const auto& [variant, value] : p.variant_defaults) {
    if (!contains(variants, variant) || !p.used_by(variant)) broken(p, fmt::format("default for '{}'", variant));
    if (!accepts(p, value)) {
      broken(p, fmt::format("default {} in '{}', expected {}", value_text(value), variant, expectation(p)));
    }
  }
}

}  // namespace

Parameter Parameter::only(std::string variant) const {
  Parameter p = *this;
  p.variants.push_back(std::move(variant));
  return p;
}

Parameter Parameter::default_for(std::string variant, Value value) const {
  Parameter p = *this;
  // So that a table may write 1 for 1.0, as a scene may.
  if (const auto* whole = std::get_if<std::int64_t>(&value); whole && type == Type::real) value = double(*whole);
  p.variant_defaults.emplace_back(std::move(variant), std::move(value));
  return p;
}

Parameter Parameter::required() const {
  Parameter p = *this;
  p.is_required = true;
  return p;
}

bool Parameter::used_by(std::string_view variant) const { return variants.empty() || contains(variants, variant); }

const Value& Parameter::default_in(std::string_view variant) const {
  for (const auto& [of, value] : variant_defaults) {
    if (of == variant) return value;
  }
  return default_value;
}

Parameter boolean(std::string key, bool value, std::string sentence) {
  return make(std::move(key), Type::boolean, "", -none, none, value, std::move(sentence));
}
Parameter integer(std::string key, std::string unit, double minimum, double maximum, std::int64_t value, std::string sentence) {
  return make(std::move(key), Type::integer, std::move(unit), minimum, maximum, value, std::move(sentence));
}
Parameter integer2(std::string key, std::string unit, double minimum, double maximum, Integer2 value, std::string sentence) {
  return make(std::move(key), Type::integer2, std::move(unit), minimum, maximum, value, std::move(sentence));
}
Parameter real(std::string key, std::string unit, double minimum, double maximum, double value, std::string sentence) {
  return make(std::move(key), Type::real, std::move(unit), minimum, maximum, value, std::move(sentence));
}
Parameter real2(std::string key, std::string unit, double minimum, double maximum, Real2 value, std::string sentence) {
  return make(std::move(key), Type::real2, std::move(unit), minimum, maximum, value, std::move(sentence));
}
Parameter real3(std::string key, std::string unit, double minimum, double maximum, Real3 value, std::string sentence) {
  return make(std::move(key), Type::real3, std::move(unit), minimum, maximum, value, std::move(sentence));
}
Parameter choice(std::string key, std::vector<std::string> choices, std::string value, std::string sentence) {
  Parameter p = make(std::move(key), Type::choice, "", -none, none, std::move(value), std::move(sentence));
  p.choices = std::move(choices);
  return p;
}
Parameter text(std::string key, std::string value, std::string sentence) {
  return make(std::move(key), Type::text, "", -none, none, std::move(value), std::move(sentence));
}

const char* name(Type type) {
  switch (type) {
    case Type::boolean:
      return "boolean";
    case Type::integer:
      return "integer";
    case Type::integer2:
      return "integer2";
    case Type::real:
      return "real";
    case Type::real2:
      return "real2";
    case Type::real3:
      return "real3";
    case Type::choice:
      return "choice";
    case Type::text:
      return "text";
  }
  return "?";
}

int components(Type type) {
  switch (type) {
    case Type::integer:
    case Type::real:
      return 1;
    case Type::integer2:
    case Type::real2:
      return 2;
    case Type::real3:
      return 3;
    default:
      return 0;
  }
}

bool accepts(const Parameter& p, const Value& value) {
  if (value.index() != alternative(p.type)) return false;
  if (p.type == Type::choice) return contains(p.choices, std::get<std::string>(value));
  if (!p.choices.empty() && !contains(p.choices, fmt::format("{}", std::get<std::int64_t>(value)))) return false;
  return std::visit(
      [&](const auto& v) {
        using T = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>)
          return true;
        else
          return in_range(p, v);
      },
      value);
}

std::string range_text(const Parameter& p) {
  if (components(p.type) == 0) return "";
  if (!p.choices.empty()) {
    const std::span<const std::string> others(p.choices.begin(), p.choices.end() - 1);
    return fmt::format("{}{}{}", fmt::join(others, ", "), others.empty() ? "" : " or ", p.choices.back());
  }
  const bool low = p.minimum > -none, high = p.maximum < none;
  if (low && high) return fmt::format("{} to {}", bound_text(p, p.minimum), bound_text(p, p.maximum));
  if (low) return fmt::format("at least {}", bound_text(p, p.minimum));
  if (high) return fmt::format("at most {}", bound_text(p, p.maximum));
  return "";
}

std::string expectation(const Parameter& p) {
  const int count = components(p.type);
  if (p.type == Type::boolean) return "true or false";
  if (p.type == Type::choice) return fmt::format("one of '{}'", fmt::join(p.choices, "', '"));
  if (p.type == Type::text) return "text";
  const bool is_integer = p.type == Type::integer || p.type == Type::integer2;
  std::string words = !p.choices.empty() ? range_text(p)
                      : count > 1        ? fmt::format("{} {}s", count, is_integer ? "integer" : "number")
                                         : std::string(is_integer ? "an integer" : "a number");
  const std::string range = p.choices.empty() ? range_text(p) : "";
  if (!range.empty()) words += (range.starts_with("at ") ? " of " : " from ") + range;
  if (!p.unit.empty()) words += fmt::format(" [{}]", p.unit);
  return words;
}

void validate(std::span<const Parameter> parameters, std::span<const std::string> variants) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    validate(parameters[i], variants);
    for (std::size_t j = 0; j < parameters.size(); ++j) {
      if (j < i && parameters[j].key == parameters[i].key) broken(parameters[i], "declared twice");
      if (parameters[j].key.starts_with(parameters[i].key + ".")) {
        broken(parameters[i], fmt::format("is also the table of '{}'", parameters[j].key));
      }
    }
  }
}

}  // namespace rainref::scene
