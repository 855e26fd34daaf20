// Counts the alternatives that an invocation takes in a shader (math/coverage.h); included by machine.h.
#pragma once

#include "spirv/machine.h"

namespace rainref::spirv {

/// True if an instruction decides. Decisions inside other instructions (a conversion that rounds by a comparison) are not the shader's.
inline bool decides(const Code& code) {
  switch (code.op) {
    case Op::BranchConditional:
    case Op::Select:
    case Op::ImageSampleExplicitLod:
    case Op::ImageFetch:
      return true;
    case Op::ExtInst:
      switch (static_cast<Glsl>(code.sub)) {
        case Glsl::FMin:
        case Glsl::NMin:
        case Glsl::FMax:
        case Glsl::NMax:
        case Glsl::FClamp:
        case Glsl::NClamp:
        case Glsl::Step:
        case Glsl::SmoothStep:
        case Glsl::Refract:
          return true;
        default:
          return false;
      }
    default:
      return false;
  }
}

/// Called before an instruction is executed. A selection counts by its condition: it selects between values of any type.
template <class N>
void Invocation<N>::count_decision(const Code& code) {
  if constexpr (std::is_same_v<N, perturbed::Perturbed>) {
    perturbed::Coverage* const coverage = perturbed::behaviour().coverage;
    if (coverage == nullptr) return;
    if (!decides(code)) return coverage->executes(nullptr);
    const perturbed::Site site{module_.lasting(module_.files[code.file]), "", static_cast<int>(code.line)};
    coverage->executes(&site);
    if (code.op != Op::BranchConditional && code.op != Op::Select) return;
    const std::uint32_t conditions = code.op == Op::Select && code.sub == 0 ? code.n : 1;
    for (std::uint32_t k = 0; k < conditions; ++k) coverage->met(site, perturbed::DecisionKind::choice, at(code.in[0])[k].word == 0);
  }
}

}  // namespace rainref::spirv
