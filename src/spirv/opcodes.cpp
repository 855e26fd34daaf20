#include "spirv/opcodes.h"

#include <fmt/format.h>

namespace rainref::spirv {

EachForm each_form(Op op) {
  switch (op) {
#define RAINREF_SPIRV_OP(name, number)
#define RAINREF_SPIRV_EACH(name, number, operands, in, out) \
  case Op::name:                                            \
    return {operands, Kind::in, Kind::out};
#include "spirv/opcodes.inc"
    default:
      return {};
  }
}

std::string op_name(Op op) {
  switch (op) {
#define RAINREF_SPIRV_OP(name, number) \
  case Op::name:                       \
    return "Op" #name;
#define RAINREF_SPIRV_EACH(name, number, operands, in, out) RAINREF_SPIRV_OP(name, number)
#include "spirv/opcodes.inc"
  }
  return fmt::format("instruction {}", static_cast<int>(op));
}

}  // namespace rainref::spirv
