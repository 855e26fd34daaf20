// Checked products of sizes stated by files. With a 32-bit std::size_t, 65536 x 65536 texels of four bytes would be 0.
#pragma once

#include <concepts>
#include <limits>
#include <optional>

namespace rainref {

/// a * b, or nothing if T cannot hold it.
template <std::unsigned_integral T>
constexpr std::optional<T> checked_product(T a, T b) {
  if (b != 0 && a > std::numeric_limits<T>::max() / b) return std::nullopt;
  return a * b;
}
/// a * b * c, or nothing. A factor of 0 gives 0 if the product of the factors before it fits.
template <std::unsigned_integral T>
constexpr std::optional<T> checked_product(T a, T b, T c) {
  const std::optional<T> first = checked_product(a, b);
  return first ? checked_product(*first, c) : std::nullopt;
}

}  // namespace rainref
