// Executes a module with one number type: one invocation at a time, calls as frames, branches as plain branches.
//
// A comparison of numbers returns a plain bool. A number type that can leave a comparison open (an enclosure) is executed once for each
// outcome, like our models (math/path_enumeration.h).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "capture/traced_program.h"
#include "math/perturbed.h"
#include "spirv/glsl_functions.h"
#include "spirv/module.h"
#include "spirv/numbers.h"
#include "spirv/resources.h"

namespace rainref::spirv {

using numbers::Slot;

/// Limits of an execution. An instruction on many numbers counts as several steps.
struct Limits {
  std::uint64_t steps = std::uint64_t{1} << 28;  ///< of an invocation
  std::size_t slots = std::size_t{1} << 24;      ///< memory of a workgroup's invocations
  std::size_t followed = std::size_t{1} << 18;   ///< traced operations of an invocation
};

/// A module with the resources of its descriptors. All three must outlive it.
template <class N>
struct Machine {
  /// Takes one resource for each descriptor. Throws Refusal if one is missing or of another kind.
  Machine(const Module& of, std::span<const Resource<N>> bound, const Limits& limit = {});

  const Module& module;
  std::span<const Resource<N>> resources;
  Limits limits;
  std::vector<Slot<N>> start, shared;  ///< initial memory of an invocation; shared memory of the workgroup
};

using Three = std::array<std::uint32_t, 3>;
/// Identifies an invocation.
struct Numbers {
  Three groups{1, 1, 1}, group{}, local{};
};

enum class Stop { finished, barrier, turn };

template <class N>
class Invocation {
 public:
  explicit Invocation(Machine<N>& machine)
      : machine_(machine),
        module_(machine.module),
        // An instruction reads absent operands as the first slots of its frame, which may be empty.
        stack_(machine.start.size() + machine.module.functions[machine.module.entry].stack + 16) {}
  /// Restarts as another invocation.
  void begin(const Numbers& numbers);
  /// Runs to the end, to a barrier, or with `one_block` to the end of the block. Throws Refusal for what cannot be executed.
  Stop run(bool one_block = false);
  /// From now on records the instruction and call that create each node of the trace. The trace must be active while it runs.
  void follow(capture::ProgramTrace& trace) requires std::is_same_v<N, perturbed::Perturbed> { trace_ = &trace; }
  /// The barrier at which it stopped.
  const Code& barrier() const { return module_.code[pc_ - 1]; }

 private:
  struct Frame {
    std::uint32_t function, base, pc, block;
    Place result;
  };
  Slot<N>* at(Place place) { return place >= 0 ? stack_.data() + base_ + place : stack_.data() + ~place; }
  void count(const Code& code) {
    steps_ += 1 + (code.n + code.pool_count) / 16;
    if (steps_ > machine_.limits.steps)
      module_.refuse(code, fmt::format("more than {} steps are not executed: is it a loop without end?", machine_.limits.steps));
  }
  void enter(std::uint32_t block);
  void enter_switch(const Code& code);
  void call(const Code& code);
  bool leave(const Code& code);
  void execute(const Code& code);
  void execute_other(const Code& code);
  void multiply(const Code& code);
  void widen(const Code& code);
  void rearrange(const Code& code);
  void chain(const Code& code);
  void load(const Code& code);
  void store(const Code& code);
  void exchange(const Code& code);
  void use_image(const Code& code);
  void note_nodes(const Code& code);
  void count_decision(const Code& code);
  template <Kind out>
  void carry(Slot<N>& to, const Slot<N>& a, const Slot<N>& b);
  void copy(const Slot<N>* from, std::uint32_t n, Slot<N>* to);
  std::byte* bytes(const Code& code, const Slot<N>* pointer, bool writes);
  Slot<N>* slots(const Code& code, const Slot<N>* pointer);
  const Resource<N>& resource(const Code& code, const Slot<N>& handle) const;
  /// Applies a function to each component of words or of numbers.
  template <Kind in, Kind out, class F>
  void each(const Code& code, int operands, const F& value) {
    Slot<N>* to = at(code.to);
    const Slot<N>*a = at(code.in[0]), *b = operands > 1 ? at(code.in[1]) : a;
    for (std::uint32_t k = 0; k < code.n; ++k) {
      const auto of = [&] {
        if constexpr (in == Kind::floating)
          return value(a[k].number, b[k].number);
        else
          return value(a[k].word, b[k].word);
      };
      if constexpr (out == Kind::floating)
        to[k].number = of();
      else
        to[k].word = of();
      if constexpr (in != Kind::floating || out != Kind::floating) carry<out>(to[k], a[k], b[k]);
    }
  }

  Machine<N>& machine_;
  const Module& module_;
  std::vector<Slot<N>> stack_, phis_;
  std::vector<Frame> frames_;
  std::uint32_t function_ = 0, base_ = 0, pc_ = 0, block_ = 0;
  std::uint64_t steps_ = 0;
  capture::ProgramTrace* trace_ = nullptr;
  std::int32_t call_ = -1;
};

template <class N>
Machine<N>::Machine(const Module& of, std::span<const Resource<N>> bound, const Limits& limit)
    : module(of), resources(bound.first(std::min(bound.size(), of.descriptors.size()))), limits(limit) {
  for (const Cell& cell : of.globals) {
    Slot<N>& slot = start.emplace_back();
    slot.word = cell.word;
    if (cell.is_float) slot.number = N(std::bit_cast<float>(cell.word));
  }
  shared.resize(of.shared_slots);
  for (std::size_t i = 0; i < of.descriptors.size(); ++i) {
    const Descriptor& d = of.descriptors[i];
    const Resource<N> r = i < bound.size() ? bound[i] : Resource<N>{};
    const bool fits = d.bound == Bound::sampler || (d.bound == Bound::sampled_image   ? r.image != nullptr
                                                    : d.bound == Bound::storage_image ? r.storage != nullptr
                                                                                      : r.buffer != nullptr);
    if (!fits)
      of.refuse(0, 0, fmt::format("binding {} ('{}') is {}, and nothing of that kind is bound there", d.binding, d.name, name(d.bound)));
  }
}

template <class N>
void Invocation<N>::begin(const Numbers& numbers) {
  std::copy(machine_.start.begin(), machine_.start.end(), stack_.begin());
  steps_ = machine_.start.size() / 16;
  const Three &size = module_.group, &group = numbers.group, &local = numbers.local;
  // In the order of BuiltIn, from num_workgroups on.
  const Three values[] = {numbers.groups,
                          size,
                          group,
                          local,
                          {group[0] * size[0] + local[0], group[1] * size[1] + local[1], group[2] * size[2] + local[2]},
                          {(local[2] * size[1] + local[1]) * size[0] + local[0]}};
  for (const BuiltInPlace& b : module_.built_ins) {
    const Three& value = values[static_cast<std::uint32_t>(b.what) - static_cast<std::uint32_t>(BuiltIn::num_workgroups)];
    for (std::uint32_t k = 0; k < b.slots; ++k) {
      stack_[b.slot + k].word = value[k];
      if constexpr (std::is_same_v<N, perturbed::Perturbed>)
        if (trace_) stack_[b.slot + k].number = N::index(static_cast<int>(value[k]));
    }
  }
  frames_.clear();
  call_ = -1;
  function_ = module_.entry;
  base_ = static_cast<std::uint32_t>(machine_.start.size());
  block_ = module_.functions[function_].entry;
  pc_ = module_.blocks[block_].first;
}

template <class N>
Stop Invocation<N>::run(bool one_block) {
  for (;;) {
    const Code& code = module_.code[pc_++];
    count(code);
    count_decision(code);
    switch (code.op) {
      case Op::Branch:
        enter(static_cast<std::uint32_t>(code.in[0]));
        if (one_block) return Stop::turn;
        break;
      case Op::BranchConditional:
        enter(static_cast<std::uint32_t>(at(code.in[0])->word != 0 ? code.in[1] : code.in[2]));
        if (one_block) return Stop::turn;
        break;
      case Op::Switch:
        enter_switch(code);
        if (one_block) return Stop::turn;
        break;
      case Op::FunctionCall:
        call(code);
        break;
      case Op::Return:
      case Op::ReturnValue:
        if (leave(code)) return Stop::finished;
        break;
      case Op::Unreachable:
        module_.refuse(code, "it came to OpUnreachable");
      case Op::ControlBarrier:
        return Stop::barrier;
      default:
        execute(code);
        note_nodes(code);
    }
  }
}

template <class N>
void Invocation<N>::enter(std::uint32_t block) {
  const Block& next = module_.blocks[block];
  phis_.clear();
  // All phis read the values from before the branch.
  for (std::uint32_t i = 0; i < next.phis; ++i) {
    const Code& phi = module_.code[next.first + i];
    count(phi);
    const std::uint32_t* from = module_.pool.data() + phi.pool;
    std::uint32_t k = 0;
    while (k < phi.pool_count && from[k + 1] != block_) k += 2;
    if (k == phi.pool_count) module_.refuse(phi, "OpPhi has no value for the block that it was reached from");
    const Slot<N>* value = at(static_cast<Place>(from[k]));
    phis_.insert(phis_.end(), value, value + phi.n);
  }
  const Slot<N>* value = phis_.data();
  for (std::uint32_t i = 0; i < next.phis; ++i) {
    const Code& phi = module_.code[next.first + i];
    std::copy(value, value + phi.n, at(phi.to));
    value += phi.n;
  }
  block_ = block;
  pc_ = next.first + next.phis;
}
template <class N>
void Invocation<N>::enter_switch(const Code& code) {
  const std::uint32_t selector = at(code.in[0])->word;
  const std::uint32_t* cases = module_.pool.data() + code.pool;
  for (std::uint32_t k = 0; k < code.pool_count; k += 2)
    if (cases[k] == selector) return enter(cases[k + 1]);
  enter(static_cast<std::uint32_t>(code.in[1]));
}

// The module has checked that the stack is large enough: no function calls itself.
template <class N>
void Invocation<N>::call(const Code& code) {
  const auto callee = static_cast<std::uint32_t>(code.in[0]);
  const std::uint32_t base = base_ + module_.functions[function_].slots;
  const std::uint32_t* arguments = module_.pool.data() + code.pool;
  for (std::uint32_t k = 0; k < code.pool_count; k += 3) {
    const Slot<N>* from = at(static_cast<Place>(arguments[k]));
    std::copy(from, from + arguments[k + 2], stack_.data() + base + arguments[k + 1]);
    steps_ += arguments[k + 2] / 16;
  }
  if (trace_) {
    trace_->calls.push_back({static_cast<std::uint32_t>(&code - module_.code.data()), call_});
    call_ = static_cast<std::int32_t>(trace_->calls.size()) - 1;
  }
  frames_.push_back({function_, base_, pc_, block_, code.to});
  function_ = callee;
  base_ = base;
  block_ = module_.functions[callee].entry;
  pc_ = module_.blocks[block_].first;
}
/// True if the entry point returned.
template <class N>
bool Invocation<N>::leave(const Code& code) {
  if (frames_.empty()) return true;
  const Frame frame = frames_.back();
  frames_.pop_back();
  if (trace_) call_ = trace_->calls[static_cast<std::size_t>(call_)].caller;
  const Slot<N>* value = at(code.in[0]);
  base_ = frame.base;
  if (code.n > 0) std::copy(value, value + code.n, at(frame.result));
  function_ = frame.function;
  pc_ = frame.pc;
  block_ = frame.block;
  return false;
}

}  // namespace rainref::spirv

#include "spirv/machine_coverage.h"
#include "spirv/machine_memory.h"
#include "spirv/machine_trace.h"
#include "spirv/machine_values.h"
