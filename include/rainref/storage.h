// How one channel is stored: strong types, so that an overload of load or store picks the conversion.
#pragma once

#include <cstdint>

namespace rainref {

/// How a float becomes a stored value: to nearest (ties to even) or toward zero, as many GPUs do.
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
