#include "spirv/group.h"

#include <algorithm>

#include "base/floating_point.h"

namespace rainref::spirv {
namespace {

// Calls f(x, y, z) for all positions in a grid of this size.
template <class F>
void for_each_place(const Three& size, const F& f) {
  for (std::uint32_t z = 0; z < size[2]; ++z)
    for (std::uint32_t y = 0; y < size[1]; ++y)
      for (std::uint32_t x = 0; x < size[0]; ++x) f(Three{x, y, z});
}

// Runs until all invocations have finished.
void run_together(const Machine<Float>& machine, std::vector<Invocation<Float>>& invocations) {
  std::vector<Stop> stopped(invocations.size(), Stop::turn);
  for (;;) {
    bool any_turn = false;
    for (std::size_t i = 0; i < invocations.size(); ++i) {
      if (stopped[i] != Stop::turn) continue;
      stopped[i] = invocations[i].run(true);
      any_turn |= stopped[i] == Stop::turn;
    }
    if (any_turn) continue;
    const Code* barrier = nullptr;
    for (std::size_t i = 0; i < invocations.size(); ++i) {
      if (stopped[i] != Stop::barrier) continue;
      const Code& here = invocations[i].barrier();
      if (barrier != nullptr && barrier != &here)
        machine.module.refuse(here, "some invocations of a workgroup wait at this barrier while others wait at another one");
      barrier = &here;
      stopped[i] = Stop::turn;
    }
    if (barrier == nullptr) return;
  }
}

}  // namespace

void dispatch(Machine<Float>& machine, const Three& groups) {
  const FloatingPointGuard guard;
  const Three& size = machine.module.group;
  const std::size_t together = machine.module.is_cooperative ? std::size_t{size[0]} * size[1] * size[2] : 1;
  const std::size_t slots = machine.start.size() + machine.module.functions[machine.module.entry].stack;
  if (slots * together > machine.limits.slots) machine.module.refuse(0, 0, "the invocations of a workgroup take more memory than they may");
  std::vector<Invocation<Float>> invocations(together, Invocation<Float>(machine));
  for_each_place(groups, [&](const Three& group) {
    std::fill(machine.shared.begin(), machine.shared.end(), Slot<Float>{});
    std::size_t next = 0;
    for_each_place(size, [&](const Three& local) {
      Invocation<Float>& invocation = invocations[machine.module.is_cooperative ? next++ : 0];
      invocation.begin({groups, group, local});
      if (!machine.module.is_cooperative) invocation.run();
    });
    if (machine.module.is_cooperative) run_together(machine, invocations);
  });
}

}  // namespace rainref::spirv
