// Storage types of one channel. The types are distinct, so overloads of load and store select the conversion.
#pragma once

#include <cstdint>

namespace rainref {

/// How a float is rounded to a stored value: to nearest (ties to even), or toward zero as on many GPUs.
enum class Rounding : std::uint8_t { rne, rtz };
/// "rne" or "rtz".
constexpr const char* name(Rounding rounding) { return rounding == Rounding::rne ? "rne" : "rtz"; }

/// IEEE 754 binary16.
struct Half {
  std::uint16_t bits;
};
/// 8-bit unsigned normalized: code / 255.
struct Unorm8 {
  std::uint8_t code;
};

}  // namespace rainref
