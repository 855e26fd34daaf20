#include "spirv/opcodes.h"

#include <fmt/format.h>

#include "spirv/integers.h"

namespace rainref::spirv {

EachForm each_form(Op op) {
  switch (op) {
#define RAINREF_SPIRV_WORDS(name, number, operands, in, out, value) \
  case Op::name:                                                    \
    return {operands, Kind::in, Kind::out};
#define RAINREF_SPIRV_NUMBERS RAINREF_SPIRV_WORDS
#include "spirv/opcodes.inc"
    default:
      return {};
  }
}
bool has_result(Op op) {
  switch (op) {
#define RAINREF_SPIRV_OP(name, number, result, handler) \
  case Op::name:                                        \
    return result;
#include "spirv/opcodes.inc"
    default:
      return each_form(op).operands > 0;
  }
}
bool is_executed(Op op) {
  switch (op) {
#define RAINREF_SPIRV_OP(name, number, result, handler) case Op::name:
#include "spirv/opcodes.inc"
    return true;
    default:
      return each_form(op).operands > 0;
  }
}
std::optional<std::uint32_t> word_operation(Op op, std::uint32_t a, std::uint32_t b) {
  const std::int64_t sa = signed_word(a), sb = signed_word(b);
  switch (op) {
#define RAINREF_SPIRV_WORDS(name, number, operands, in, out, value) \
  case Op::name:                                                    \
    return value;
#include "spirv/opcodes.inc"
    default:
      return std::nullopt;
  }
}
EachForm glsl_form(Glsl function) {
  switch (function) {
#define RAINREF_GLSL_WORDS(name, number, operands, value) \
  case Glsl::name:                                        \
    return {operands, Kind::integer, Kind::integer};
#define RAINREF_GLSL_NUMBERS(name, number, operands, value) \
  case Glsl::name:                                          \
    return {operands, Kind::floating, Kind::floating};
#include "spirv/glsl.inc"
    default:
      return {};
  }
}

std::string op_name(Op op) {
  switch (op) {
#define RAINREF_SPIRV_NAME(name, number) \
  case Op::name:                         \
    return "Op" #name;
#define RAINREF_SPIRV_GLOBAL(name, number, handler) RAINREF_SPIRV_NAME(name, number)
#define RAINREF_SPIRV_OP(name, number, result, handler) RAINREF_SPIRV_NAME(name, number)
#define RAINREF_SPIRV_WORDS(name, number, operands, in, out, value) RAINREF_SPIRV_NAME(name, number)
#define RAINREF_SPIRV_NUMBERS(name, number, operands, in, out, value) RAINREF_SPIRV_NAME(name, number)
#include "spirv/opcodes.inc"
  }
  return fmt::format("instruction {}", static_cast<int>(op));
}

}  // namespace rainref::spirv
