// Operations on whole numbers and truth values of 32 bits, as SPIR-V has them. What it leaves undefined (a division by zero, a shift by
// 32 and more) has one result here, so that nothing depends on the machine.
#pragma once

#include <bit>
#include <cstdint>

#include "spirv/opcodes.h"

namespace rainref::spirv {

inline std::int32_t signed_word(std::uint32_t a) { return static_cast<std::int32_t>(a); }
inline std::uint32_t word_of(std::int64_t a) { return static_cast<std::uint32_t>(a); }

/// a / b toward zero, and what remains; by zero: 0 and a.
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

/// Whether this is an operation of integers or truth values that integer_operation() knows.
inline bool is_integer_operation(Op op) {
  const EachForm form = each_form(op);
  return form.operands > 0 && form.in != Kind::floating && form.out != Kind::floating;
}
/// One component; b means nothing where there is one operand. Truth values are 0 and 1.
inline std::uint32_t integer_operation(Op op, std::uint32_t a, std::uint32_t b) {
  const std::int64_t sa = signed_word(a), sb = signed_word(b);
  switch (op) {
    case Op::SNegate:
      return 0u - a;
    case Op::Not:
      return ~a;
    case Op::BitReverse:
      return reversed(a);
    case Op::BitCount:
      return static_cast<std::uint32_t>(std::popcount(a));
    case Op::LogicalNot:
      return a == 0;
    case Op::IAdd:
      return a + b;
    case Op::ISub:
      return a - b;
    case Op::IMul:
      return a * b;
    case Op::UDiv:
      return word_of(quotient(a, b));
    case Op::SDiv:
      return word_of(quotient(sa, sb));
    case Op::UMod:
      return word_of(remainder(a, b));
    case Op::SRem:
      return word_of(remainder(sa, sb));
    case Op::SMod:
      return word_of(modulo(sa, sb));
    case Op::ShiftRightLogical:
      return a >> (b & 31u);
    case Op::ShiftRightArithmetic:
      return word_of(sa >> (b & 31u));
    case Op::ShiftLeftLogical:
      return a << (b & 31u);
    case Op::BitwiseOr:
    case Op::LogicalOr:
      return a | b;
    case Op::BitwiseAnd:
    case Op::LogicalAnd:
      return a & b;
    case Op::BitwiseXor:
      return a ^ b;
    case Op::IEqual:
    case Op::LogicalEqual:
      return a == b;
    case Op::INotEqual:
    case Op::LogicalNotEqual:
      return a != b;
    case Op::UGreaterThan:
      return a > b;
    case Op::UGreaterThanEqual:
      return a >= b;
    case Op::ULessThan:
      return a < b;
    case Op::ULessThanEqual:
      return a <= b;
    case Op::SGreaterThan:
      return sa > sb;
    case Op::SGreaterThanEqual:
      return sa >= sb;
    case Op::SLessThan:
      return sa < sb;
    case Op::SLessThanEqual:
      return sa <= sb;
    default:
      return 0;
  }
}

/// `count` bits of `base` from `offset` on, of which none are beyond bit 31.
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
