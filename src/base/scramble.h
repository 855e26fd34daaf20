// Mixes words into random-looking words.
#pragma once

#include <cstdint>

namespace rainref {

/// The finaliser of splitmix64 (Steele, Lea, Flood 2014), a bijection. For a state that grows by `scramble_step` it gives the words of that
/// generator.
inline std::uint64_t scramble(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}
inline constexpr std::uint64_t scramble_step = 0x9e3779b97f4a7c15u;

}  // namespace rainref
