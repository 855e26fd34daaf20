#include "math/formula.h"

#include <optional>
#include <vector>

namespace rainref::perturbed {
namespace {

/// The value at the end of a path.
std::optional<float> at_end(const std::array<std::int8_t, 6>& path, const std::array<Perturbed, 4>& of,
                            const std::array<std::int32_t, 4>& nodes, const Trace& trace) {
  if (path[0] < 0) return {};
  auto k = static_cast<std::size_t>(path[0]);
  float value = of[k].v;
  std::int32_t node = nodes[k];
  for (std::size_t step = 1; step < path.size() && path[step] >= 0; ++step) {
    if (node < 0) return {};
    const Trace::Node& n = trace.nodes[static_cast<std::size_t>(node)];
    k = static_cast<std::size_t>(path[step]);
    value = n.with[k];
    node = n.of[k];
  }
  return value;
}
std::optional<float> met(const FormulaStep& step, const Trace& trace, std::size_t before) {
  const float* const value = trace.value_met(step.shape, step.back, before);
  return value ? std::optional(*value) : std::nullopt;
}

}  // namespace

int operands_of(Op op) {
  switch (op) {
    case Op::sum:
    case Op::difference:
    case Op::product:
    case Op::quotient:
    case Op::minimum:
    case Op::maximum:
    case Op::power:
    case Op::angle:
    case Op::comparison:
      return 2;
    case Op::negation:
    case Op::magnitude:
    case Op::root:
    case Op::square:
    case Op::floor:
    case Op::fract:
    case Op::exponential:
    case Op::exponential2:
    case Op::logarithm:
    case Op::sine:
    case Op::cosine:
    case Op::coordinate:
    case Op::level:
    case Op::argument:
    case Op::stored:
      return 1;
    case Op::mix:
    case Op::smoothstep:
    case Op::choice:
      return 3;
    default:
      return 0;
  }
}

Perturbed by_formula(const Formula& formula, const Perturbed& r, const std::array<Perturbed, 4>& of,
                     const std::array<std::int32_t, 4>& nodes, const Trace& trace, std::size_t before) {
  const Unseen parts;
  std::vector<Perturbed> stack;
  for (const FormulaStep& s : formula) {
    if (s.kind == FormulaStep::Kind::operation) {
      const auto takes = static_cast<std::size_t>(operands_of(s.op));
      if (takes == 0 || stack.size() < takes) return r;
      std::array<Perturbed, 4> operands{};
      for (std::size_t k = 0; k < takes; ++k) operands[k] = stack[stack.size() - takes + k];
      stack.resize(stack.size() - takes);
      stack.push_back(again(s.op, r, operands));
      continue;
    }
    const std::optional<float> value = s.kind == FormulaStep::Kind::number   ? std::optional(s.number)
                                       : s.kind == FormulaStep::Kind::itself ? std::optional(r.v)
                                       : s.kind == FormulaStep::Kind::part   ? at_end(s.path, of, nodes, trace)
                                                                             : met(s, trace, before);
    if (!value) return r;
    stack.push_back(Perturbed::of(*value));
  }
  return stack.size() == 1 ? stack[0] : r;
}

}  // namespace rainref::perturbed
