// Products of sizes that files state: where std::size_t has 32 bits, 65536 x 65536 texels of four bytes are 0.
#pragma once

#include <concepts>
#include <limits>
#include <optional>

namespace rainref {

/// a * b, or nothing where T does not hold it.
template <std::unsigned_integral T>
constexpr std::optional<T> checked_product(T a, T b) {
  if (b != 0 && a > std::numeric_limits<T>::max() / b) return std::nullopt;
  return a * b;
}
/// a * b * c, or nothing. A factor of 0 makes 0 of everything before it that fits.
template <std::unsigned_integral T>
constexpr std::optional<T> checked_product(T a, T b, T c) {
  const std::optional<T> first = checked_product(a, b);
  return first ? checked_product(*first, c) : std::nullopt;
}

}  // namespace rainref
