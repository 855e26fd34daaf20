#include "faults/operation_names.h"

namespace rainref::faults {

using perturbed::Op;

const char* function_of(Op op) {
  switch (op) {
    case Op::minimum:
      return "min";
    case Op::maximum:
      return "max";
    case Op::magnitude:
      return "abs";
    case Op::root:
      return "sqrt";
    case Op::square:
      return "square";
    case Op::floor:
      return "floor";
    case Op::fract:
      return "fract";
    case Op::exponential:
      return "exp";
    case Op::exponential2:
      return "exp2";
    case Op::logarithm:
      return "log";
    case Op::power:
      return "pow";
    case Op::sine:
      return "sin";
    case Op::cosine:
      return "cos";
    case Op::angle:
      return "atan2";
    case Op::mix:
      return "mix";
    case Op::smoothstep:
      return "smoothstep";
    case Op::choice:
      return "select";
    default:
      return "";
  }
}
const char* sign_of(Op op) {
  return op == Op::sum ? " + " : op == Op::difference ? " - " : op == Op::product ? " * " : op == Op::quotient ? " / " : "";
}

}  // namespace rainref::faults
