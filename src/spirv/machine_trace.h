// Records the trace of an invocation (capture/traced_program.h); included by machine.h.
#pragma once

#include "spirv/machine.h"

namespace rainref::spirv {

/// An integer stores the node that it comes from as its number, and so does a number computed from it.
template <class N>
template <Kind out>
void Invocation<N>::carry(Slot<N>& to, const Slot<N>& a, const Slot<N>& b) {
  if constexpr (std::is_same_v<N, perturbed::Perturbed> && (out == Kind::integer || out == Kind::floating)) {
    if (!trace_) return;
    const N made = N::of(out == Kind::integer ? static_cast<float>(signed_word(to.word)) : to.number.v);
    if (a.number.node() >= 0 || b.number.node() >= 0)
      to.number = N::met(perturbed::Op::stored, made, a.number, b.number);
    else if (out == Kind::integer)
      to.number = N();
  }
}

template <class N>
void Invocation<N>::note_nodes(const Code& code) {
  if constexpr (std::is_same_v<N, perturbed::Perturbed>) {
    if (!trace_) return;
    if (trace_->values.nodes.size() > machine_.limits.followed)
      module_.refuse(code, fmt::format("an invocation of more than {} operations is not followed", machine_.limits.followed));
    for (std::uint32_t part = 0; trace_->steps.size() < trace_->values.nodes.size(); ++part)
      trace_->steps.push_back({static_cast<std::uint32_t>(&code - module_.code.data()), call_, part});
  }
}
/// Copies of values: in a trace each copy is a node of its own.
template <class N>
void Invocation<N>::copy(const Slot<N>* from, std::uint32_t n, Slot<N>* to) {
  std::copy(from, from + n, to);
  if constexpr (std::is_same_v<N, perturbed::Perturbed>)
    for (std::uint32_t k = 0; trace_ && k < n; ++k)
      if (to[k].number.node() >= 0) to[k].number = to[k].number.as_stored();
}

}  // namespace rainref::spirv
