// Operations on 32-bit integers and truth values, as SPIR-V defines them. Results that SPIR-V leaves undefined (a division by zero, a shift
// by 32 or more) are fixed here, so that they do not depend on the machine.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>

#include "spirv/opcodes.h"

namespace rainref::spirv {

inline std::int32_t signed_word(std::uint32_t a) { return static_cast<std::int32_t>(a); }
inline std::uint32_t word_of(std::int64_t a) { return static_cast<std::uint32_t>(a); }

/// a / b rounded toward zero, and its remainder; 0 and a if b is 0.
inline std::int64_t quotient(std::int64_t a, std::int64_t b) { return b == 0 ? 0 : a / b; }
inline std::int64_t remainder(std::int64_t a, std::int64_t b) { return b == 0 ? a : a % b; }
/// The remainder with the sign of b.
inline std::int64_t modulo(std::int64_t a, std::int64_t b) {
  const std::int64_t rest = remainder(a, b);
  return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
}
inline std::uint32_t reversed(std::uint32_t a) {
  std::uint32_t out = 0;
  for (int i = 0; i < 32; ++i) out |= (a >> i & 1u) << (31 - i);
  return out;
}

inline std::uint32_t highest_bit(std::uint32_t a) { return static_cast<std::uint32_t>(31 - std::countl_zero(a)); }
template <class T>
T clamped(T a, T low, T high) {
  const T least = a < low ? low : a;
  return high < least ? high : least;
}

/// Computes one component of an instruction on words, from opcodes.inc; nothing for other instructions. b is used if there are two
/// operands.
std::optional<std::uint32_t> word_operation(Op op, std::uint32_t a, std::uint32_t b);

/// Bit fields of `count` bits of `base` from `offset` on, up to bit 31.
inline std::uint32_t low_bits(std::uint32_t count) { return count >= 32 ? 0xffffffffu : (1u << count) - 1u; }
inline std::uint32_t extracted_bits(std::uint32_t base, std::uint32_t offset, std::uint32_t count, bool is_signed) {
  if (count == 0 || offset > 31) return 0;
  const std::uint32_t bits = base >> offset & low_bits(count), sign = 1u << ((count - 1u) & 31u);
  return is_signed && (bits & sign) ? bits | ~low_bits(count) : bits;
}
inline std::uint32_t inserted_bits(std::uint32_t base, std::uint32_t insert, std::uint32_t offset, std::uint32_t count) {
  if (offset > 31) return base;
  const std::uint32_t mask = low_bits(count) << offset;
  return (base & ~mask) | (insert << offset & mask);
}

}  // namespace rainref::spirv
